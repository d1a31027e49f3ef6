//! Closed curves from lines that meet at their ends: [`ClosedPolylines::joined`].

use thiserror::Error;

use super::{ClosedPolylines, PolylineDefects};
use crate::DVec3;

/// Why lines are no closed curves in a plane.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum JoinError {
    /// The curves are not in a plane of constant z.
    #[error(
        "position {vertex} has z = {z}, and position {first} has z = {first_z}: the curves lie in no plane across z"
    )]
    NotFlat {
        /// The position.
        vertex: u32,
        /// Its z coordinate.
        z: f64,
        /// The first position of the curves.
        first: u32,
        /// Its z coordinate.
        first_z: f64,
    },
    /// A curve is open, or lines run against each other.
    #[error("at position {vertex} {arriving} lines end and {leaving} begin: {}", if (arriving + leaving) % 2 == 1 {
        "a curve is open there"
    } else {
        "some of them run the wrong way, or curves are open there"
    })]
    Open {
        /// The position, the first of such.
        vertex: u32,
        /// Lines that end there.
        arriving: usize,
        /// Lines that begin there.
        leaving: usize,
    },
    /// What is wrong with the curves once they are joined, or with the indices of lines, whose corners are counted one line after the other.
    #[error(transparent)]
    Defects(#[from] PolylineDefects),
}

impl ClosedPolylines {
    /// The curves that lines make up, as the `l` statements of an OBJ file name them: a line is a curve of its own if its last index is the
    /// first; the others go on where one ends and the next begins, and where there is a choice, with the first that is left. Positions keep
    /// their numbers, also those in no line, whose z coordinate does not matter. Lines of one index are points, and are left out.
    ///
    /// Complexity: O(n log n).
    ///
    /// # Errors
    /// [`JoinError`]: an index out of range, a position that is not finite, positions that do not share their z coordinate, a curve that is
    /// open, and what
    /// [`new`](Self::new) refuses; the first of these.
    ///
    /// ```
    /// use welter_meshing::{DVec3, volumetric::plane::{ClosedPolylines, JoinError}};
    /// let positions = [[0.0, 0.0, 5.0], [1.0, 0.0, 5.0], [0.0, 1.0, 5.0]].map(DVec3::from_array);
    /// let curves = ClosedPolylines::joined(&positions, &[vec![0, 1], vec![2, 0], vec![1, 2]])?;
    /// assert_eq!(curves.loops(), [[0, 1, 2]]);
    /// let error = ClosedPolylines::joined(&positions, &[vec![0, 1, 2]]).unwrap_err();
    /// assert_eq!(error, JoinError::Open { vertex: 0, arriving: 0, leaving: 1 });
    /// # Ok::<(), JoinError>(())
    /// ```
    pub fn joined(positions: &[DVec3], lines: &[Vec<u32>]) -> Result<Self, JoinError> {
        let corners = || lines.iter().flatten().copied();
        let beyond = corners().enumerate().filter(|&(_, corner)| corner as usize >= positions.len());
        let out_of_range: Vec<usize> = beyond.map(|(place, _)| place).collect();
        if !out_of_range.is_empty() {
            return Err(PolylineDefects { out_of_range, ..PolylineDefects::default() }.into());
        }
        let is_finite = |corner: &u32| positions[*corner as usize].is_finite();
        let mut not_finite: Vec<u32> = corners().filter(|corner| !is_finite(corner)).collect();
        if !not_finite.is_empty() {
            not_finite.sort_unstable();
            not_finite.dedup();
            return Err(PolylineDefects { not_finite, ..PolylineDefects::default() }.into());
        }
        let lines: Vec<&[u32]> = lines.iter().map(|line| &line[..]).filter(|line| line.len() > 1).collect();
        flat(positions, &lines)?;
        let loops = loops(&lines)?;
        Ok(Self::new(positions.iter().map(|position| position.truncate()).collect(), loops)?)
    }
}

/// An error unless all corners, which are finite, have the same z coordinate.
fn flat(positions: &[DVec3], lines: &[&[u32]]) -> Result<(), JoinError> {
    let height = |vertex: u32| positions[vertex as usize].z;
    let mut corners = lines.iter().copied().flatten().copied();
    let Some(first) = corners.next() else { return Ok(()) };
    let first_z = height(first);
    match corners.find(|&vertex| height(vertex) != first_z) {
        Some(vertex) => Err(JoinError::NotFlat { vertex, z: height(vertex), first, first_z }),
        None => Ok(()),
    }
}

/// The closed curves of lines, by index, each without its last corner, which is the first.
fn loops(lines: &[&[u32]]) -> Result<Vec<Vec<u32>>, JoinError> {
    let (mut loops, mut open) = (Vec::new(), Vec::new());
    for line in lines {
        match line {
            [first, .., last] if first == last => loops.push(line[..line.len() - 1].to_vec()),
            _ => open.push(*line),
        }
    }
    let ends = |line: &[u32]| [line[0], line[line.len() - 1]];
    // By the position where they begin; of equal ones the first in front.
    let mut begins: Vec<(u32, usize)> = open.iter().enumerate().map(|(k, line)| (ends(line)[0], k)).collect();
    begins.sort_unstable();
    let mut arrivals: Vec<u32> = open.iter().map(|line| ends(line)[1]).collect();
    arrivals.sort_unstable();
    balanced(&begins, &arrivals)?;
    let mut next_of = begins.clone();
    next_of.dedup_by_key(|pair| pair.0);
    // The place of the first line not yet taken, for each position where lines begin.
    let mut free: Vec<usize> =
        next_of.iter().map(|pair| begins.partition_point(|other| other.0 < pair.0)).collect();
    let mut taken = vec![false; open.len()];
    for start in 0..open.len() {
        if taken[start] {
            continue;
        }
        let (mut line, mut corners) = (start, Vec::new());
        loop {
            taken[line] = true;
            let [_, last] = ends(open[line]);
            corners.extend_from_slice(&open[line][..open[line].len() - 1]);
            if last == corners[0] {
                break;
            }
            let position = next_of.partition_point(|pair| pair.0 < last);
            // As many lines begin at a position as end there, so one is left.
            while taken[begins[free[position]].1] {
                free[position] += 1;
            }
            line = begins[free[position]].1;
        }
        loops.push(corners);
    }
    Ok(loops)
}

/// An error unless as many lines begin at each position as end there; both are sorted by position.
fn balanced(begins: &[(u32, usize)], arrivals: &[u32]) -> Result<(), JoinError> {
    let mut vertices: Vec<u32> = begins.iter().map(|pair| pair.0).chain(arrivals.iter().copied()).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let counts = vertices.into_iter().map(|vertex| {
        let leaving =
            begins.partition_point(|pair| pair.0 <= vertex) - begins.partition_point(|pair| pair.0 < vertex);
        let arriving = arrivals.partition_point(|&v| v <= vertex) - arrivals.partition_point(|&v| v < vertex);
        (vertex, arriving, leaving)
    });
    match counts.into_iter().find(|(_, arriving, leaving)| arriving != leaving) {
        Some((vertex, arriving, leaving)) => Err(JoinError::Open { vertex, arriving, leaving }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(count: u32) -> Vec<DVec3> {
        (0..count).map(|k| DVec3::new(f64::from(k), f64::from(k * k), 1.0)).collect()
    }

    fn joined(lines: &[&[u32]]) -> Result<Vec<Vec<u32>>, JoinError> {
        let lines: Vec<Vec<u32>> = lines.iter().map(|line| line.to_vec()).collect();
        ClosedPolylines::joined(&grid(8), &lines).map(|curves| curves.loops().to_vec())
    }

    #[test]
    fn lines_are_joined_in_their_order() {
        assert_eq!(joined(&[&[0, 1, 2, 0]]).unwrap(), [[0, 1, 2]]);
        assert_eq!(joined(&[&[3, 4], &[0, 1, 2, 0], &[5, 3], &[4, 5]]).unwrap(), [[0, 1, 2], [3, 4, 5]]);
        // Two curves that share position 0 are told apart where they come back to it.
        assert_eq!(joined(&[&[0, 1, 2], &[0, 3, 4], &[2, 0], &[4, 0]]).unwrap(), [[0, 1, 2], [0, 3, 4]]);
        // And one that passes through a position twice stays one.
        assert_eq!(joined(&[&[1, 0], &[0, 2], &[2, 3, 0], &[0, 4, 1]]).unwrap(), [[1, 0, 2, 3, 0, 4]]);
        assert_eq!(joined(&[&[7], &[]]).unwrap(), Vec::<Vec<u32>>::new());
    }

    #[test]
    fn what_is_no_closed_curve_is_named() {
        let error = |lines: &[&[u32]]| joined(lines).unwrap_err().to_string();
        let open = "at position 3 0 lines end and 1 begin: a curve is open there";
        assert_eq!(error(&[&[0, 1, 2, 0], &[3, 4], &[4, 5]]), open);
        let against =
            "at position 0 0 lines end and 2 begin: some of them run the wrong way, or curves are open there";
        assert_eq!(error(&[&[0, 1], &[1, 2], &[0, 2]]), against);
        assert_eq!(error(&[&[0, 1, 8], &[9, 0]]), "2 corners have indices out of range: 2, 3");
        assert_eq!(error(&[&[0, 1, 0]]), "1 loop has less than three corners: 0");
        let mut positions = grid(4);
        positions[3].z = 9.0; // in no line
        let lines = [vec![0, 1, 2, 0]];
        assert!(ClosedPolylines::joined(&positions, &lines).is_ok());
        positions[1].z = 2.0;
        let error = ClosedPolylines::joined(&positions, &lines).unwrap_err();
        assert_eq!(error, JoinError::NotFlat { vertex: 1, z: 2.0, first: 0, first_z: 1.0 });
        positions[1] = DVec3::new(f64::NAN, 0.0, 1.0);
        assert!(matches!(ClosedPolylines::joined(&positions, &lines), Err(JoinError::Defects(_))));
    }
}
