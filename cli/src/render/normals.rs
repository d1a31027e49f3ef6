//! Corner normals for smooth shading: facet normals averaged with weights that grow with the angle at the vertex, after
//! \[Thuermer98\], over those neighbours that turn by less than the crease angle, so that sharp edges stay sharp.

use super::model::Model;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Unit normal of a triangle, zero where it has no area.
pub(super) fn facet([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// The corner normals of the triangles `first..first + count`, for positions like the model's.
pub(super) fn corner_normals(
    model: &Model,
    positions: &[DVec3],
    first: usize,
    count: usize,
    crease_degrees: f64,
) -> Vec<[Vec3; 3]> {
    let triangles = &model.triangles[first..first + count];
    let least_cosine = libm::cos(crease_degrees.clamp(0.0, 180.0).to_radians()) as f32;
    let facets: Vec<Vec3> =
        triangles.par_iter().map(|t| facet(t.map(|v| positions[v as usize])).as_vec3()).collect();
    let around = Around::of(triangles, positions.len());
    (0..count)
        .into_par_iter()
        .map(|t| {
            let own = facets[t];
            triangles[t].map(|v| {
                let mut sum = Vec3::ZERO;
                for &other in around.of_vertex(v) {
                    let other = other as usize;
                    if other == t || facets[other].dot(own) > least_cosine {
                        sum += facets[other] * angle(triangles[other], v, positions);
                    }
                }
                let normal = sum.normalize_or_zero();
                if normal == Vec3::ZERO { own } else { normal }
            })
        })
        .collect()
}

/// A number that grows with the angle of a triangle at its corner `v`: 1 - cos, in [0, 2].
fn angle(triangle: [u32; 3], v: u32, positions: &[DVec3]) -> f32 {
    let [a, b, c] = triangle;
    let (p, q, r) = if v == a {
        (a, b, c)
    } else if v == b {
        (b, c, a)
    } else {
        (c, a, b)
    };
    let at = |i: u32| positions[i as usize];
    let (e, f) = ((at(q) - at(p)).normalize_or_zero(), (at(r) - at(p)).normalize_or_zero());
    (1.0 - e.dot(f)) as f32
}

/// The triangles around each vertex, ascending.
struct Around {
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Around {
    fn of(triangles: &[[u32; 3]], vertices: usize) -> Self {
        let mut starts = vec![0u32; vertices + 1];
        for &v in triangles.as_flattened() {
            starts[v as usize + 1] += 1;
        }
        for v in 0..vertices {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut found = vec![0; 3 * triangles.len()];
        for (t, corners) in triangles.iter().enumerate() {
            for &v in corners {
                found[next[v as usize] as usize] = t as u32;
                next[v as usize] += 1;
            }
        }
        Self { starts, triangles: found }
    }

    fn of_vertex(&self, v: u32) -> &[u32] {
        &self.triangles[self.starts[v as usize] as usize..self.starts[v as usize + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::scene::{Layer, Paint, Scene, Style};
    use welter_meshing::surface::VertexId;

    #[test]
    fn a_fold_stays_sharp_below_the_crease_angle_and_is_smoothed_above() {
        let positions = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::Z];
        // Two facets folded by 90 degrees along the y axis.
        let triangles = [[0, 2, 1], [0, 1, 3]].map(|t| t.map(VertexId));
        let layer = Layer {
            positions: &positions,
            triangles: &triangles,
            paint: Paint::Plain,
            highlighted: &[],
            style: Style::default(),
        };
        let model = Model::of(&Scene { layers: vec![layer], ..Scene::default() }).unwrap();
        let sharp = corner_normals(&model, &model.positions, 0, 2, 60.0);
        assert_eq!(sharp[0], [Vec3::Z; 3]);
        assert_eq!(sharp[1], [Vec3::X; 3]);
        let smooth = corner_normals(&model, &model.positions, 0, 2, 120.0);
        assert_eq!(smooth[0][0], smooth[1][0]);
        assert_eq!(smooth[0][1], Vec3::Z);
    }
}
