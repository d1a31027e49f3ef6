//! How long edges are to be, by place: [`Sizing`].
//!
//! Without adaption every edge is aimed at the reference length. With it \[Brochu12, section 4.5.6\], the scale at a vertex is
//! the radius of curvature there times `edge_over_radius`, within bounds. The curvature is the largest bend of the edges
//! at the vertex: the angle between the normals of the two triangles, over the distance of their centroids across the
//! edge; that of a fold is about the angle over the length of its edges, so creases become finer, down to the bound.
//!
//! Grading: scales are lowered where they grow faster from vertex to vertex than `grading` allows, from the smallest upward, as
//! shortest paths are found \[Persson06\]. The result depends on the surface alone.

use super::CurvatureAdaption;
use super::shape::unit_normal;
use super::split::ordered;
use crate::surface::MovingSurface;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use welter_meshing::surface::VertexId;

/// Scales of the reference length by vertex slot; empty if it holds everywhere.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sizing(Vec<f64>);

impl Sizing {
    pub(crate) fn new(surface: &MovingSurface, length: f64, adaption: Option<&CurvatureAdaption>) -> Self {
        let Some(adaption) = adaption else { return Self::default() };
        let slots = 0..surface.connectivity().vertex_slots();
        let scale = |v: usize| {
            let curvature = largest_bend(surface, VertexId::from_index(v));
            let [low, high] = adaption.scale;
            if curvature > 0.0 {
                (adaption.edge_over_radius / (curvature * length)).clamp(low, high)
            } else {
                high
            }
        };
        let mut scales: Vec<f64> = slots.into_par_iter().map(scale).collect();
        grade(surface, length, adaption.grading, &mut scales);
        Self(scales)
    }

    /// The scale of an edge: the mean of its ends'.
    #[inline]
    pub(crate) fn of(&self, ends: [VertexId; 2]) -> f64 {
        if self.0.is_empty() {
            return 1.0;
        }
        let [a, b] = ends.map(|v| self.0.get(v.index()).copied().unwrap_or(1.0));
        0.5 * a + 0.5 * b
    }

    /// A new vertex on an edge.
    pub(crate) fn born(&mut self, vertex: VertexId, ends: [VertexId; 2]) {
        if self.0.is_empty() {
            return;
        }
        let scale = self.of(ends);
        if self.0.len() <= vertex.index() {
            self.0.resize(vertex.index() + 1, 1.0);
        }
        self.0[vertex.index()] = scale;
    }

    /// A copy of a vertex.
    pub(crate) fn copied(&mut self, vertex: VertexId, from: VertexId) {
        self.born(vertex, [from, from]);
    }
}

/// The largest angle over length at the edges of a vertex; of a vertex that is not in use, zero.
fn largest_bend(surface: &MovingSurface, v: VertexId) -> f64 {
    let mesh = surface.connectivity();
    let places = |t| mesh.corners(t).map(|v| surface.position(v));
    let mut largest = 0.0_f64;
    for h in mesh.star(v) {
        let mut around = mesh.around_edge(mesh.edge(h));
        let (Some(s), Some(t), None) = (around.next(), around.next(), around.next()) else { continue };
        let [s, t] = [s, t].map(|side| places(side.triangle()));
        let normals = [s, t].map(unit_normal);
        let centroids = [s, t].map(|[a, b, c]| a / 3.0 + b / 3.0 + c / 3.0);
        let distance = centroids[0].distance(centroids[1]);
        let angle = libm::atan2(normals[0].cross(normals[1]).length(), normals[0].dot(normals[1]));
        if distance > 0.0 {
            largest = largest.max(angle / distance);
        }
    }
    largest
}

fn grade(surface: &MovingSurface, length: f64, grading: f64, scales: &mut [f64]) {
    let mesh = surface.connectivity();
    let entry = |v: VertexId, scale: f64| Reverse((ordered(scale), v.0));
    let mut heap: BinaryHeap<_> = mesh.vertices().map(|v| entry(v, scales[v.index()])).collect();
    while let Some(Reverse((scale, v))) = heap.pop() {
        let v = VertexId(v);
        if ordered(scales[v.index()]) != scale {
            continue;
        }
        for h in mesh.star(v) {
            for w in [mesh.head(h), mesh.apex(h)] {
                let distance = surface.position(v).distance(surface.position(w)) / length;
                let most = scales[v.index()] + grading * distance;
                if scales[w.index()] > most {
                    scales[w.index()] = most;
                    heap.push(entry(w, most));
                }
            }
        }
    }
}
