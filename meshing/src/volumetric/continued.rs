//! How sheets go on within one cell beyond the parts into which they are seen to lead: [`Continued`].
//!
//! # What it computes
//! A sheet that a crossing shows to lead into a part of a cell lies behind every further surface that is entered from there as well: it is the same
//! hexahedron, and a hexahedron has one copy of a part. So where three or more pieces of surface meet in a cell, each has a copy in parts that
//! no edge leads into through it. All ways through the cell to such a part must lead to one copy. The same is true of each copy that is in the cell from the outset.
//!
//! Between two parts there may be surface that no edge of the cell meets. If every piece of surface has two sides in the cell, which side of each
//! a part lies on tells where: parts that differ in one side only have that one between them, and it is a patch like others.
//!
//! Of two sheets that cross, the edges tell all there is to know; twice the same surface makes four, and thin parts between that no edge
//! connects.
//!
//! # What it promises
//! Nothing is said that a right mesh can contradict: where two ways lead to different copies, one hexahedron would have both, which
//! [`CellHexahedra`](super::cells::CellHexahedra) refuses.
//!
//! Complexity: O(s p) for s sheets and p patches of a cell, both few.

/// A way from a part of the cell into another on which copies go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// Through the surface at a crossing of a patch.
    Crossing(u32),
    /// Over a seam.
    Seam(u32),
    /// Through surface that no edge of the cell meets there, by number.
    Hidden(u32),
}

/// A copy of the region of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Copy {
    /// The one behind a crossing.
    Behind(u32),
    /// That as which a copy goes on.
    Onward(Step, u32),
    /// One that is asked for, by number.
    Asked(u32),
}

/// On a step a copy goes on as another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Continues {
    pub(super) step: Step,
    pub(super) outer: Copy,
    pub(super) inner: Copy,
}

/// A step of a cell, from one part to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellStep {
    pub(super) step: Step,
    pub(super) parts: [u32; 2],
    /// The hexahedron of the extension whose surface is passed.
    pub(super) hexahedron: Option<u32>,
}

/// Surface that no edge of the cell meets between two parts, as a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Hidden {
    pub(super) parts: [u32; 2],
    /// The copy behind it.
    pub(super) class: Copy,
}

/// The steps on ways that meet: into a part with several steps into it, and before. Along others copies go on in one way only.
pub(super) fn meeting(mut steps: Vec<CellStep>, places: usize) -> Vec<CellStep> {
    let both_ways = |step: &CellStep| matches!(step.step, Step::Seam(_));
    let mut into = vec![0u32; places];
    for step in &steps {
        into[step.parts[1] as usize] += 1;
        into[step.parts[0] as usize] += u32::from(both_ways(step));
    }
    let mut leads: Vec<bool> = into.iter().map(|&count| count > 1).collect();
    loop {
        let mut changed = false;
        for step in &steps {
            let [from, to] = step.parts.map(|part| part as usize);
            if leads[to] && !leads[from] || both_ways(step) && leads[from] && !leads[to] {
                (leads[from], leads[to]) = (true, true);
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
    steps.retain(|step| leads[step.parts[1] as usize]);
    steps
}

/// What is found of some cells; its memory is used again.
#[derive(Default)]
pub(super) struct Continued {
    /// How sheets go on.
    pub(super) found: Vec<Continues>,
    /// The part of each copy that is asked for.
    pub(super) asked: Vec<u32>,
    /// The hidden surfaces of the cell, by number; their classes are found with the sheets.
    pub(super) hidden: Vec<Hidden>,
    known: Vec<Option<Copy>>,
}

impl Continued {
    /// Follows a sheet that is `known` in some parts below `places`, along the steps that are not through its own surface.
    pub(super) fn follow(
        &mut self,
        steps: &[CellStep],
        own: Option<u32>,
        places: usize,
        known: impl IntoIterator<Item = (u32, Copy)>,
    ) {
        self.known.clear();
        self.known.resize(places, None);
        for (part, copy) in known {
            self.known[part as usize].get_or_insert(copy);
        }
        for step in steps.iter().filter(|step| own.is_some() && step.hexahedron == own) {
            if let Step::Hidden(number) = step.step {
                let inner = step.parts[1];
                let class = *self.known[inner as usize].get_or_insert_with(|| {
                    self.asked.push(inner);
                    Copy::Asked(self.asked.len() as u32 - 1)
                });
                self.hidden[number as usize].class = class;
            }
        }
        let passable = |step: &&CellStep| own.is_none() || step.hexahedron != own;
        loop {
            let before = self.asked.len();
            for step in steps.iter().filter(passable) {
                let [from, to] = step.parts.map(|part| part as usize);
                let (from, to) = match (self.known[from], self.known[to], step.step) {
                    (Some(_), None, _) => (from, to),
                    // Over a seam every copy has come from somewhere.
                    (None, Some(_), Step::Seam(_)) => (to, from),
                    _ => continue,
                };
                debug_assert!(self.known[from].is_some());
                self.known[to] = Some(Copy::Asked(self.asked.len() as u32));
                self.asked.push(to as u32);
            }
            if self.asked.len() == before {
                break;
            }
        }
        for step in steps.iter().filter(passable) {
            let [outer, inner] = step.parts.map(|part| self.known[part as usize]);
            if let (Some(outer), Some(inner)) = (outer, inner) {
                self.found.push(Continues { step: step.step, outer, inner });
            }
        }
    }

    /// Adds the steps through surface that no edge meets: between parts that differ in the side of one hexahedron of the extension.
    /// Only where each has two sides in the cell: then it is known of each sheet in which parts it is.
    pub(super) fn add_hidden<'a>(
        &mut self,
        steps: &mut Vec<CellStep>,
        parts: &[u32],
        first_hexahedron: u32,
        sides: impl Fn(u32) -> Option<&'a [i16]>,
    ) {
        let Some(all) = parts.iter().map(|&part| sides(part)).collect::<Option<Vec<_>>>() else { return };
        let count = all.first().map_or(0, |sides| sides.len());
        let two_sided = (0..count).all(|h| {
            let of = || all.iter().map(|sides| sides[h]);
            of().max() <= of().min().map(|least| least + 1)
        });
        if !two_sided {
            return;
        }
        let seen = steps.len();
        for (&outer, before) in parts.iter().zip(&all) {
            for (&inner, behind) in parts.iter().zip(&all) {
                let mut differ = (0..count).filter(|&h| before[h] != behind[h]);
                let (Some(h), None) = (differ.next(), differ.next()) else { continue };
                let parts = [outer, inner];
                if behind[h] < before[h] || steps[..seen].iter().any(|step| step.parts == parts) {
                    continue;
                }
                let step = Step::Hidden(self.hidden.len() as u32);
                let hexahedron = Some(first_hexahedron + h as u32);
                steps.push(CellStep { step, parts, hexahedron });
                self.hidden.push(Hidden { parts, class: Copy::Asked(u32::MAX) });
            }
        }
    }

    /// Forgets hidden surfaces that no step leads through any more, and numbers the others anew.
    pub(super) fn keep_hidden_of(&mut self, steps: &mut [CellStep]) {
        let all = std::mem::take(&mut self.hidden);
        for step in steps {
            if let Step::Hidden(number) = &mut step.step {
                self.hidden.push(all[*number as usize]);
                *number = self.hidden.len() as u32 - 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_surfaces_on_ways_that_do_not_meet_are_left_out() {
        // Sides of two hexahedra: 3 is beyond both ways from 0; 4 and 5 have a hidden surface between and nothing else.
        let sides = |part: u32| -> Option<&'static [i16]> {
            const SIDES: [[i16; 3]; 6] = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1]];
            Some(&SIDES[part as usize])
        };
        let crossing = |id, from, to, hexahedron| CellStep {
            step: Step::Crossing(id),
            parts: [from, to],
            hexahedron: Some(hexahedron),
        };
        let seen = vec![crossing(0, 0, 1, 10), crossing(1, 0, 2, 11), crossing(2, 1, 3, 11)];
        let mut cell = Continued::default();
        let mut steps = seen.clone();
        cell.add_hidden(&mut steps, &[0, 1, 2, 3, 4, 5], 10, sides);
        let hidden: Vec<[u32; 2]> = cell.hidden.iter().map(|hidden| hidden.parts).collect();
        assert_eq!(hidden, [[0, 4], [1, 5], [2, 3], [4, 5]]);
        // Without 0 to 4 and 1 to 5 the last is on no way that meets another.
        steps.retain(|step| !matches!(step.step, Step::Hidden(0 | 1)));
        let mut steps = meeting(steps, 6);
        cell.keep_hidden_of(&mut steps);
        assert_eq!(cell.hidden.iter().map(|hidden| hidden.parts).collect::<Vec<_>>(), [[2, 3]]);
        cell.follow(&steps, Some(10), 6, [(1, Copy::Behind(0))]);
        // The sheet of 10 leads into 3 through 11, and its own surface hidden between 2 and 3 is a patch of that class.
        assert_eq!(cell.asked, [3]);
        assert_eq!(cell.hidden[0].class, Copy::Asked(0));
        let way = Continues { step: Step::Crossing(2), outer: Copy::Behind(0), inner: Copy::Asked(0) };
        assert_eq!(cell.found, [way]);
    }
}
