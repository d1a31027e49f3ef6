//! Segments as edges, by flips \[Sloan93\].

use std::collections::{BTreeSet, VecDeque};

use welter_predicates::Sign;

use super::Triangulation;

impl Triangulation<'_> {
    /// Makes every segment an edge; all of them, the smaller point first.
    pub(super) fn constrain(&mut self, segments: &[[u32; 2]]) -> Option<BTreeSet<[u32; 2]>> {
        let mut fixed = BTreeSet::new();
        for &[p, q] in segments {
            if p == q {
                return None;
            }
            self.force([p, q], &fixed)?;
            fixed.insert([p.min(q), p.max(q)]);
        }
        Some(fixed)
    }

    fn force(&mut self, [p, q]: [u32; 2], fixed: &BTreeSet<[u32; 2]>) -> Option<()> {
        let mut crossing = self.crossing([p, q], fixed)?;
        // In each round of the queue some edge can be flipped; n edges have never been seen to take n rounds.
        let mut left = 8 + 2 * crossing.len() * crossing.len();
        while let Some(edge) = crossing.pop_front() {
            left = left.checked_sub(1)?;
            match self.flip(edge) {
                None => crossing.push_back(edge),
                Some([c, d]) => {
                    if self.crosses([p, q], [c, d]) {
                        crossing.push_back([c, d]);
                    }
                }
            }
        }
        let there = self.left.contains_key(&[p, q]) || self.left.contains_key(&[q, p]);
        there.then_some(())
    }

    /// Whether the ends of an edge lie strictly on both sides of the line of a segment, of which neither is an end.
    fn crosses(&self, [p, q]: [u32; 2], [a, b]: [u32; 2]) -> bool {
        let shared = [a, b].iter().any(|end| *end == p || *end == q);
        !shared && self.side(p, q, a) * self.side(p, q, b) == Sign::Negative
    }

    /// The edges between two points, each with the first point on its left; none if a point lies on the way, or a fixed edge.
    fn crossing(&self, [p, q]: [u32; 2], fixed: &BTreeSet<[u32; 2]>) -> Option<VecDeque<[u32; 2]>> {
        let mut found = VecDeque::new();
        if self.left.contains_key(&[p, q]) || self.left.contains_key(&[q, p]) {
            return Some(found);
        }
        // The edge opposite of the first point through which the way leaves.
        let opposite = |&[a, b, c]: &[u32; 3]| match p {
            _ if p == a => Some([b, c]),
            _ if p == b => Some([c, a]),
            _ if p == c => Some([a, b]),
            _ => None,
        };
        let leaves =
            |&[a, b]: &[u32; 2]| self.side(p, q, a) == Sign::Negative && self.side(p, q, b) == Sign::Positive;
        let [mut a, mut b] = self.triangles.iter().filter_map(opposite).find(leaves)?;
        loop {
            if fixed.contains(&[a.min(b), a.max(b)]) {
                return None;
            }
            found.push_back([a, b]);
            let apex = self.apex([b, a])?;
            if apex == q {
                return Some(found);
            }
            match self.side(p, q, apex) {
                Sign::Positive => b = apex,
                Sign::Negative => a = apex,
                Sign::Zero => return None,
            }
        }
    }
}
