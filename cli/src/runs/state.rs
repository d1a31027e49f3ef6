//! The state of a solver as bytes, and back: [`Writer`], [`Reader`].
//!
//! Promises: numbers keep their bits; little-endian on every machine. No bytes panic or make a reader take memory beyond their number.

use glam::DVec3;
use welter_meshing::surface::{TriMesh, TriangleSoup};

/// Appends numbers.
#[derive(Debug, Default)]
pub(crate) struct Writer(pub(crate) Vec<u8>);

/// The bytes are not those of such a state.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub(crate) struct NoState(pub(crate) String);

impl Writer {
    pub(crate) fn whole(&mut self, number: u64) {
        self.0.extend_from_slice(&number.to_le_bytes());
    }

    pub(crate) fn number(&mut self, number: f64) {
        self.whole(number.to_bits());
    }

    pub(crate) fn numbers(&mut self, numbers: &[f64]) {
        self.whole(numbers.len() as u64);
        numbers.iter().for_each(|&number| self.number(number));
    }

    pub(crate) fn points(&mut self, points: &[DVec3]) {
        self.whole(points.len() as u64);
        points.iter().flat_map(DVec3::to_array).for_each(|number| self.number(number));
    }

    pub(crate) fn triangles(&mut self, triangles: impl ExactSizeIterator<Item = [u32; 3]>) {
        self.whole(triangles.len() as u64);
        for corner in triangles.flatten() {
            self.0.extend_from_slice(&corner.to_le_bytes());
        }
    }

    pub(crate) fn mesh(&mut self, mesh: &TriMesh) {
        self.points(mesh.positions());
        self.triangles(mesh.triangles().iter().map(|corners| corners.map(|v| v.0)));
    }
}

/// Takes numbers from the front.
#[derive(Debug)]
pub(crate) struct Reader<'b>(pub(crate) &'b [u8]);

impl<'b> Reader<'b> {
    fn bytes(&mut self, count: usize) -> Result<&'b [u8], NoState> {
        let (bytes, rest) =
            self.0.split_at_checked(count).ok_or_else(|| NoState("the state ends too early".to_owned()))?;
        self.0 = rest;
        Ok(bytes)
    }

    pub(crate) fn whole(&mut self) -> Result<u64, NoState> {
        let bytes = self.bytes(8)?;
        Ok(u64::from_le_bytes(bytes.try_into().expect("8 bytes were taken")))
    }

    pub(crate) fn number(&mut self) -> Result<f64, NoState> {
        self.whole().map(f64::from_bits)
    }

    /// A number of elements of as many bytes each, all of which are there.
    fn count(&mut self, size: usize) -> Result<usize, NoState> {
        let count = self.whole()?;
        let fits =
            usize::try_from(count).ok().filter(|n| n.checked_mul(size).is_some_and(|n| n <= self.0.len()));
        fits.ok_or_else(|| NoState(format!("{count} elements are announced and are not there")))
    }

    pub(crate) fn numbers(&mut self) -> Result<Vec<f64>, NoState> {
        (0..self.count(8)?).map(|_| self.number()).collect()
    }

    pub(crate) fn points(&mut self) -> Result<Vec<DVec3>, NoState> {
        (0..self.count(24)?).map(|_| Ok(DVec3::new(self.number()?, self.number()?, self.number()?))).collect()
    }

    pub(crate) fn triangles(&mut self) -> Result<Vec<[u32; 3]>, NoState> {
        let count = self.count(12)?;
        let bytes = self.bytes(12 * count)?;
        let corner = |bytes: &[u8]| u32::from_le_bytes(bytes.try_into().expect("4 bytes"));
        Ok(bytes.chunks_exact(12).map(|t| [corner(&t[..4]), corner(&t[4..8]), corner(&t[8..])]).collect())
    }

    pub(crate) fn mesh(&mut self) -> Result<TriMesh, NoState> {
        let (positions, triangles) = (self.points()?, self.triangles()?);
        let soup = TriangleSoup { positions, triangles, ..TriangleSoup::default() };
        TriMesh::new(soup).map_err(|error| NoState(error.to_string()))
    }

    /// Nothing is left.
    pub(crate) fn end(&self) -> Result<(), NoState> {
        if self.0.is_empty() { Ok(()) } else { Err(NoState(format!("{} bytes are left over", self.0.len()))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_nothing_else() {
        let nan = f64::from_bits(0x7ff8_0000_dead_beef);
        let mut writer = Writer::default();
        writer.whole(7);
        [0.1, -0.0, nan].into_iter().for_each(|number| writer.number(number));
        writer.points(&[DVec3::new(1.0, 2.0, 3.0)]);
        writer.triangles([[0, 1, 2], [u32::MAX, 0, 5]].into_iter());
        let bytes = writer.0;
        let read = |bytes: &[u8]| {
            let mut reader = Reader(bytes);
            let seven = reader.whole()?;
            let bits = [(); 3].map(|()| reader.number().map_or(0, f64::to_bits));
            let all = (seven, bits, reader.points()?, reader.triangles()?);
            reader.end().map(|()| all)
        };
        let (seven, bits, points, triangles) = read(&bytes).unwrap();
        assert_eq!((seven, points), (7, vec![DVec3::new(1.0, 2.0, 3.0)]));
        assert_eq!(bits, [0.1_f64.to_bits(), (-0.0_f64).to_bits(), nan.to_bits()]);
        assert_eq!(triangles, [[0, 1, 2], [u32::MAX, 0, 5]]);
        (0..bytes.len()).for_each(|end| assert!(read(&bytes[..end]).is_err(), "{end}"));
        let mut longer = bytes.clone();
        longer.push(0);
        assert!(read(&longer).is_err());
        // A count beyond all memory.
        longer[32..40].fill(0xff);
        assert!(read(&longer).is_err());
    }
}
