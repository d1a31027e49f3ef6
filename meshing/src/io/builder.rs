//! Collects a [`TriangleSoup`] as data arrives, within the [`Limits`].
//!
//! Invariant: memory is proportional to what was read, whatever a header declares; groups are ascending and disjoint.

use super::error::{Place, ReadError};
use super::polygon::Triangulator;
use super::{Ignored, Limits, ReadReport};
use crate::surface::{Group, TriangleSoup};
use glam::DVec3;

/// Elements reserved at most on the word of a header.
const TRUSTED: u64 = 1 << 16;

/// A soup under construction.
pub(super) struct Builder {
    pub(super) soup: TriangleSoup,
    limits: Limits,
    triangulator: Triangulator,
    open: Option<(String, u32)>,
    ignored: Vec<Ignored>,
}

impl Builder {
    pub(super) fn new(limits: &Limits) -> Self {
        Self {
            soup: TriangleSoup::default(),
            limits: *limits,
            triangulator: Triangulator::default(),
            open: None,
            ignored: Vec::new(),
        }
    }

    /// Prepares for what a header declares; refuses it at once where it passes the limits.
    pub(super) fn declare(&mut self, vertices: u64, triangles: u64, at: Place) -> Result<(), ReadError> {
        self.check_vertices(vertices, at)?;
        self.check_triangles(triangles, at)?;
        self.soup.positions.reserve(vertices.min(TRUSTED) as usize);
        self.soup.triangles.reserve(triangles.min(TRUSTED) as usize);
        Ok(())
    }

    fn check_vertices(&self, count: u64, at: Place) -> Result<(), ReadError> {
        let limit = u64::from(self.limits.max_vertices);
        if count > limit { Err(ReadError::OverLimit { at, what: "vertices", limit }) } else { Ok(()) }
    }

    fn check_triangles(&self, count: u64, at: Place) -> Result<(), ReadError> {
        let limit = u64::from(self.limits.max_triangles);
        if count > limit { Err(ReadError::OverLimit { at, what: "triangles", limit }) } else { Ok(()) }
    }

    pub(super) fn vertices(&self) -> u64 {
        self.soup.positions.len() as u64
    }

    /// Adds a vertex. A NaN loses its sign and payload, which text cannot hold.
    #[inline]
    pub(super) fn vertex(&mut self, position: DVec3, at: Place) -> Result<(), ReadError> {
        self.check_vertices(self.vertices() + 1, at)?;
        self.soup.positions.push(if position.is_nan() {
            DVec3::select(position.is_nan_mask(), DVec3::NAN, position)
        } else {
            position
        });
        Ok(())
    }

    #[inline]
    pub(super) fn triangle(&mut self, corners: [u32; 3], at: Place) -> Result<(), ReadError> {
        self.check_triangles(self.soup.triangles.len() as u64 + 1, at)?;
        self.soup.triangles.push(corners);
        Ok(())
    }

    /// Adds a polygon of at least three corners as triangles that keep its orientation.
    #[inline]
    pub(super) fn polygon(&mut self, corners: &[u32], at: Place) -> Result<(), ReadError> {
        if let &[a, b, c] = corners {
            return self.triangle([a, b, c], at);
        }
        self.check_triangles((self.soup.triangles.len() + corners.len()) as u64 - 2, at)?;
        self.triangulator.triangulate(&self.soup.positions, corners, &mut self.soup.triangles);
        Ok(())
    }

    /// Gives a colour to the triangles that have none yet.
    pub(super) fn color(&mut self, color: [u8; 3]) {
        self.soup.triangle_colors.resize(self.soup.triangles.len(), color);
    }

    /// Begins a group; an empty name only ends the one before.
    pub(super) fn begin_group(&mut self, name: String) {
        self.end_group();
        if !name.is_empty() {
            self.open = Some((name, self.soup.triangles.len() as u32));
        }
    }

    pub(super) fn end_group(&mut self) {
        if let Some((name, start)) = self.open.take() {
            self.soup.groups.push(Group { name, triangles: start..self.soup.triangles.len() as u32 });
        }
    }

    /// Notes content that a soup cannot hold.
    pub(super) fn ignore(&mut self, what: impl AsRef<str> + Into<String>, at: Place) {
        match self.ignored.iter_mut().find(|i| i.what == what.as_ref()) {
            Some(ignored) => ignored.count += 1,
            None => self.ignored.push(Ignored { what: what.into(), count: 1, first: at }),
        }
    }

    pub(super) fn finish(mut self) -> (TriangleSoup, ReadReport) {
        self.end_group();
        (self.soup, ReadReport { ignored: self.ignored })
    }
}
