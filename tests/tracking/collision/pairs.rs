//! One test body for the three pairs of primitives: [`Pair`], and what they are drawn from: [`Family`].

use welter_kit::entropy::{Entropy, stream};
use welter_kit::exact::moving::{EDGE_EDGE, Moving, VERTEX_FACE, VERTEX_SEGMENT};
use welter_kit::generate::Kind;
use welter_predicates::ccd;
use welter_tracking::collision::{
    ClosestPoints, CollisionError, MinimumSeparationParameters, TimeOfImpactParameters, closest_points,
    minimum_separation, time_of_impact,
};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pair {
    VertexFace,
    EdgeEdge,
    /// In the plane of the first two coordinates, of the first three vertices.
    VertexSegment,
}

pub(super) const PAIRS: [Pair; 3] = [Pair::VertexFace, Pair::EdgeEdge, Pair::VertexSegment];

/// Places of four vertices at times 0 and 1.
pub(super) type Query = [[[f64; 3]; 4]; 2];

/// An impact of any pair.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Impact {
    pub(super) time: [f64; 2],
    pub(super) weights: Vec<f64>,
    pub(super) normal: Vec<f64>,
    pub(super) decisions: u32,
}

/// An approach of any pair.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Approach {
    pub(super) time: f64,
    pub(super) distance: [f64; 2],
    pub(super) weights: Vec<f64>,
    pub(super) normal: Vec<f64>,
    pub(super) steps: u32,
}

macro_rules! any_impact {
    ($impact:expr) => {
        $impact.map(|i| {
            i.map(|i| Impact {
                time: i.time,
                weights: i.weights.to_vec(),
                normal: i.normal.to_vec(),
                decisions: i.decisions,
            })
        })
    };
}

macro_rules! any_approach {
    ($approach:expr) => {
        $approach.map(|a| {
            a.map(|a| Approach {
                time: a.time,
                distance: a.distance,
                weights: a.weights.to_vec(),
                normal: a.normal.to_vec(),
                steps: a.steps,
            })
        })
    };
}

/// The vertices of a query of the plane.
fn plane(q: &Query) -> [[[f64; 2]; 3]; 2] {
    q.map(|t| [0, 1, 2].map(|i| [t[i][0], t[i][1]]))
}

impl Pair {
    pub(super) fn impact(self, q: &Query, width: f64) -> Result<Option<Impact>, CollisionError> {
        let (p, [a, b]) = (TimeOfImpactParameters { width }, plane(q));
        match self {
            Self::VertexFace => any_impact!(time_of_impact::vertex_face(q[0], q[1], &p)),
            Self::EdgeEdge => any_impact!(time_of_impact::edge_edge(q[0], q[1], &p)),
            Self::VertexSegment => any_impact!(time_of_impact::vertex_segment_2d(a, b, &p)),
        }
    }

    pub(super) fn approach(self, q: &Query, distance: f64) -> Result<Option<Approach>, CollisionError> {
        let p = MinimumSeparationParameters { distance, ..Default::default() };
        let [a, b] = plane(q);
        match self {
            Self::VertexFace => any_approach!(minimum_separation::vertex_face(q[0], q[1], &p)),
            Self::EdgeEdge => any_approach!(minimum_separation::edge_edge(q[0], q[1], &p)),
            Self::VertexSegment => any_approach!(minimum_separation::vertex_segment_2d(a, b, &p)),
        }
    }

    pub(super) fn closest(self, points: [[f64; 3]; 4]) -> (Vec<f64>, [f64; 2]) {
        fn parts<const P: usize>(c: ClosestPoints<P>) -> (Vec<f64>, [f64; 2]) {
            (c.weights.to_vec(), c.distance)
        }
        match self {
            Self::VertexFace => parts(closest_points::vertex_face(points).unwrap()),
            Self::EdgeEdge => parts(closest_points::edge_edge(points).unwrap()),
            Self::VertexSegment => parts(closest_points::vertex_segment_2d(plane(&[points; 2])[0]).unwrap()),
        }
    }

    /// Whether there is contact at all, exactly.
    pub(super) fn touches(self, q: &Query) -> bool {
        let [a, b] = plane(q);
        match self {
            Self::VertexFace => ccd::vertex_face(q[0], q[1]),
            Self::EdgeEdge => ccd::edge_edge(q[0], q[1]),
            Self::VertexSegment => ccd::vertex_segment_2d(a, b),
        }
    }

    /// At how many times.
    pub(super) fn times(self, q: &Query) -> ccd::ContactTimes {
        let [a, b] = plane(q);
        match self {
            Self::VertexFace => ccd::vertex_face_times(q[0], q[1]),
            Self::EdgeEdge => ccd::edge_edge_times(q[0], q[1]),
            Self::VertexSegment => ccd::vertex_segment_2d_times(a, b),
        }
    }

    pub(super) fn touches_during(self, q: &Query, part: [f64; 2]) -> bool {
        let [a, b] = plane(q);
        match self {
            Self::VertexFace => ccd::vertex_face_during(q[0], q[1], part),
            Self::EdgeEdge => ccd::edge_edge_during(q[0], q[1], part),
            Self::VertexSegment => ccd::vertex_segment_2d_during(a, b, part),
        }
    }

    /// The exact motion.
    pub(super) fn moving(self, q: &Query) -> Moving {
        let [a, b] = plane(q);
        match self {
            Self::VertexFace => Moving::new(&q[0], &q[1], VERTEX_FACE),
            Self::EdgeEdge => Moving::new(&q[0], &q[1], EDGE_EDGE),
            Self::VertexSegment => Moving::new(&a, &b, VERTEX_SEGMENT),
        }
    }

    /// How many vertices the first primitive has.
    pub(super) fn first(self) -> usize {
        if self == Self::EdgeEdge { 2 } else { 1 }
    }
}

/// Where queries come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Family {
    /// Uniform in a cube.
    Random,
    /// Integers up to 1, 2 or 4 in magnitude, a third of them flattened to a plane or a line.
    Grid,
    /// Any kind of the kit, for both ends of the step together: all exponents, subnormal, flat up to a few
    /// ulp, ...
    Any,
    /// Small primitives that fly at each other fast.
    Fast,
    /// Thin triangles and nearly parallel edges.
    Thin,
}

pub(super) const FAMILIES: [Family; 5] =
    [Family::Random, Family::Grid, Family::Any, Family::Fast, Family::Thin];

impl Family {
    pub(super) fn query(self, seed: u64) -> Query {
        let bytes = stream(seed.wrapping_mul(977).wrapping_add(self as u64), 700);
        let mut entropy = Entropy::new(&bytes);
        let uniform = |e: &mut Entropy<'_>| (e.word() >> 11) as f64 * 2f64.powi(-52) - 1.0;
        let mut random =
            || -> Query { [(); 2].map(|()| [(); 4].map(|()| [(); 3].map(|()| uniform(&mut entropy)))) };
        match self {
            Self::Random => random(),
            Self::Grid => grid(&mut entropy),
            Self::Any => {
                let (_, points) = Kind::draw_any::<3, 8>(&mut entropy);
                [[0, 1, 2, 3], [4, 5, 6, 7]].map(|half| half.map(|i| points[i]))
            }
            Self::Fast => {
                let mut query = random();
                let [shape, way] = [random()[0], random()[0]];
                for (t, points) in query.iter_mut().enumerate() {
                    for (i, p) in points.iter_mut().enumerate() {
                        for (k, x) in p.iter_mut().enumerate() {
                            let path = if i == 0 { 8.0 * t as f64 - 4.0 } else { 0.0 };
                            *x = 0.125 * *x + shape[i][k] + path * way[0][k];
                        }
                    }
                }
                query
            }
            Self::Thin => {
                let mut query = random();
                let thin = 2f64.powi(-(i32::try_from(seed % 60).unwrap()));
                for points in &mut query {
                    let [_, b, c, d] = *points;
                    for k in 0..3 {
                        // The last vertex near the line of the second and third; edges nearly parallel.
                        points[3][k] = b[k] + 0.6 * (c[k] - b[k]) + thin * d[k];
                    }
                    if seed.is_multiple_of(2) {
                        for k in 0..3 {
                            points[1][k] = points[0][k] + (points[3][k] - c[k]) + thin * b[k];
                        }
                    }
                }
                query
            }
        }
    }
}

fn grid(entropy: &mut Entropy<'_>) -> Query {
    let size = entropy.pick(&[1, 2, 4]);
    let flat = entropy.below(6);
    let mut query: Query =
        [(); 2].map(|()| [(); 4].map(|()| [(); 3].map(|()| f64::from(entropy.between(-size, size)))));
    for p in query.as_flattened_mut() {
        match flat {
            0 => p[2] = p[0] - p[1],
            1 => (p[1], p[2]) = (p[0], 0.0),
            _ => {}
        }
    }
    query
}
