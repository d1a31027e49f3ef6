//! [`PlainSurface`]: operations by their definition, on the set of triangles.

use std::collections::{BTreeMap, BTreeSet};

type Triangle = [u32; 3];

/// A set of oriented triangles, each with its smallest corner first; ascending.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlainSurface {
    triangles: Vec<Triangle>,
}

impl PlainSurface {
    /// The surface of some triangles, in any order and with any corner first.
    #[must_use]
    pub fn new(triangles: impl IntoIterator<Item = Triangle>) -> Self {
        let rotated = |mut t: Triangle| {
            let least = (0..3).min_by_key(|&k| t[k]).expect("three corners");
            t.rotate_left(least);
            t
        };
        let mut triangles: Vec<Triangle> = triangles.into_iter().map(rotated).collect();
        triangles.sort_unstable();
        Self { triangles }
    }

    /// The triangles.
    #[must_use]
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// How many triangles run along each directed edge.
    fn directed(&self) -> BTreeMap<[u32; 2], usize> {
        let mut counts = BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for side in [[a, b], [b, c], [c, a]] {
                *counts.entry(side).or_insert(0) += 1;
            }
        }
        counts
    }

    /// Whether each edge is balanced or a boundary, and no two triangles have the same corners.
    #[must_use]
    pub fn is_admissible(&self) -> bool {
        let counts = self.directed();
        let balanced = counts.iter().all(|(&[a, b], &forward)| {
            let backward = counts.get(&[b, a]).copied().unwrap_or(0);
            forward == backward || forward + backward == 1
        });
        let sets: BTreeSet<Triangle> = self
            .triangles
            .iter()
            .map(|&t| {
                let mut t = t;
                t.sort_unstable();
                t
            })
            .collect();
        let differ = self.triangles.iter().all(|&[a, b, c]| a != b && b != c && c != a);
        balanced && differ && sets.len() == self.triangles.len()
    }

    /// Vertices - edges + triangles.
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        let vertices: BTreeSet<u32> = self.triangles.iter().flatten().copied().collect();
        vertices.len() as i64 - self.edges().len() as i64 + self.triangles.len() as i64
    }

    /// Every edge, the smaller end first, and how many triangles it has.
    #[must_use]
    pub fn edges(&self) -> BTreeMap<[u32; 2], usize> {
        let mut edges = BTreeMap::new();
        for ([a, b], count) in self.directed() {
            *edges.entry([a.min(b), a.max(b)]).or_insert(0) += count;
        }
        edges
    }

    /// The vertices with more than one fan, and how many they have.
    #[must_use]
    pub fn singular(&self) -> BTreeMap<u32, usize> {
        let vertices: BTreeSet<u32> = self.triangles.iter().flatten().copied().collect();
        vertices.into_iter().map(|v| (v, self.fans(v).len())).filter(|&(_, fans)| fans > 1).collect()
    }

    /// A vertex in the middle of an edge.
    #[must_use]
    pub fn split(&self, [a, b]: [u32; 2], middle: u32) -> Self {
        let put = |t: &Triangle, old: u32| t.map(|v| if v == old { middle } else { v });
        Self::new(self.triangles.iter().flat_map(|t| {
            if t.contains(&a) && t.contains(&b) { vec![put(t, a), put(t, b)] } else { vec![*t] }
        }))
    }

    /// An edge turned between the triangles `a b c` and `b a d`.
    #[must_use]
    pub fn flip(&self, [a, b, c, d]: [u32; 4]) -> Self {
        self.replace(&[[a, b, c], [b, a, d]], &[[c, a, d], [d, b, c]])
    }

    /// One vertex in the place of another.
    #[must_use]
    pub fn collapse(&self, kept: u32, removed: u32) -> Self {
        let stay = self.triangles.iter().filter(|t| !(t.contains(&kept) && t.contains(&removed)));
        Self::new(stay.map(|t| t.map(|v| if v == removed { kept } else { v }))).cancelled()
    }

    /// Triangles in the place of others.
    #[must_use]
    pub fn replace(&self, remove: &[Triangle], add: &[Triangle]) -> Self {
        let remove = Self::new(remove.iter().copied());
        let stay = self.triangles.iter().filter(|t| !remove.triangles.contains(t));
        Self::new(stay.chain(add).copied()).cancelled()
    }

    /// Opposite triangles with the same corners go in pairs.
    fn cancelled(self) -> Self {
        let mut left = self.triangles.clone();
        for [a, b, c] in self.triangles {
            if let (Some(i), Some(j)) =
                (left.iter().position(|&t| t == [a, b, c]), left.iter().position(|&t| t == [a, c, b]))
            {
                left.remove(i.max(j));
                left.remove(i.min(j));
            }
        }
        Self::new(left)
    }

    /// The triangles of a vertex by fans: flooded over common edges at the vertex.
    #[must_use]
    pub fn fans(&self, vertex: u32) -> Vec<BTreeSet<Triangle>> {
        let mut rest: BTreeSet<Triangle> =
            self.triangles.iter().filter(|t| t.contains(&vertex)).copied().collect();
        let mut fans = Vec::new();
        while let Some(first) = rest.pop_first() {
            let mut fan = BTreeSet::from([first]);
            loop {
                let touches =
                    |t: &Triangle| fan.iter().any(|f| t.iter().filter(|v| f.contains(v)).count() > 1);
                let Some(next) = rest.iter().copied().find(touches) else { break };
                rest.remove(&next);
                fan.insert(next);
            }
            fans.push(fan);
        }
        fans
    }
}
