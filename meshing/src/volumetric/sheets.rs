//! Which copy of which region lies behind each crossing: [`Sheets`].
//!
//! # Method
//! Crossings of one hexahedron of the extension that lead into one part of a cell lead into one copy: they are a class. Those that
//! also come from one part are a patch. A hexahedron with crossings into both parts beside a patch of another hexahedron is a sheet that
//! goes on through it: a link. What these facts say of the copies is worked out by [`Problem`]. Where at most one sheet
//! lies, there is nothing to tell apart.
//!
//! Complexity: near linear in the crossings, and what the search takes.

use rayon::prelude::*;

use super::continued::{self, CellStep, Continued, Continues, Copy, Hidden, Step};
use super::copies::{Contradiction, Link, MAX_COPIES, Patch, Problem, SEAM, Solution, Square, Unknown};
use super::error::Trouble;
use super::frame::{CellCrossing, Cut, Frame, in_all_cells};
use super::pieces::Regions;
use crate::Monitor;
use crate::surface::topology::union_find::UnionFind;

const NONE: u32 = u32::MAX;

/// For each crossing the copy behind it, and how copies before it go on.
pub(super) struct Sheets {
    /// The class of each crossing into more than one copy.
    class_of: Vec<u32>,
    /// The patch of each such crossing.
    patch_of: Vec<u32>,
    solution: Solution,
}

/// What one cell says.
#[derive(Default)]
struct Facts {
    /// Crossings of one class.
    same_class: Vec<[u32; 2]>,
    /// Crossings of one patch.
    same_patch: Vec<[u32; 2]>,
    /// How sheets go on.
    links: Vec<Continues>,
    /// The region of each copy that is asked for.
    asked: Vec<u32>,
    /// Surfaces that no edge meets; their parts are regions here.
    hidden: Vec<Hidden>,
    /// Of the copies that are asked for those which are what a copy of a region goes on as: its number, the region and the copy.
    origins: Vec<[u32; 3]>,
    /// Crossings of the patches of a square.
    squares: Vec<[u32; 4]>,
    /// A crossing of a patch, the seam behind it, the seam before it, and a crossing beyond.
    seam_squares: Vec<[u32; 4]>,
    /// Regions before and behind crossings into more than one copy.
    crossings: Vec<[u32; 3]>,
}

impl Sheets {
    /// Gathers the facts of all cells and works out the copies.
    pub(super) fn new(cut: &Cut<'_>, regions: &Regions<'_>, monitor: &Monitor<'_>) -> Result<Self, Trouble> {
        if let Some((region, &w)) = (0..).zip(regions.windings()).find(|&(_, &w)| w > MAX_COPIES as i32) {
            return Err(Trouble::TooManyCopies { region, copies: w as u32 });
        }
        // Where at most one sheet lies there is nothing to tell apart.
        let deep = regions.pieces.deep_cells(cut.grid);
        let add = |facts: &mut Facts, frame: &Frame, _: [u32; 3], number: usize| {
            facts.add(frame, cut.extension.hexahedra(number), regions);
        };
        let facts = in_all_cells(cut, &regions.pieces, "copies of regions", monitor, |row| deep[row], add)?;
        let count = cut.crossings.axes.iter().map(|rows| rows.items().len()).sum();
        let (mut classes, mut patches) = (UnionFind::new(count), UnionFind::new(count));
        rayon::join(
            || facts.iter().flat_map(|facts| &facts.same_class).for_each(|&[a, b]| classes.unite(a, b)),
            || facts.iter().flat_map(|facts| &facts.same_patch).for_each(|&[a, b]| patches.unite(a, b)),
        );
        let mut sheets =
            Self { class_of: vec![NONE; count], patch_of: vec![NONE; count], solution: Solution::default() };
        let mut problem = Problem {
            copies: regions.windings().iter().map(|&w| w.max(0) as u32).collect(),
            ..Problem::default()
        };
        problem.patches.extend(regions.pieces.seams().iter().map(|runs| {
            let [outer, inner] = runs.map(|run| regions.of(run));
            Patch { outer, inner, class: SEAM }
        }));
        // Every crossing is seen from four cells; what it leads from and to is the same in all.
        let mut between: Vec<[u32; 3]> =
            facts.iter().flat_map(|facts| facts.crossings.iter().copied()).collect();
        between.par_sort_unstable();
        between.dedup();
        for &[id, outer, inner] in &between {
            let class = classes.root(id) as usize;
            if sheets.class_of[class] == NONE {
                sheets.class_of[class] = problem.classes.len() as u32;
                problem.classes.push(inner);
            }
            sheets.class_of[id as usize] = sheets.class_of[class];
            let patch = patches.root(id) as usize;
            if sheets.patch_of[patch] == NONE {
                sheets.patch_of[patch] = problem.patches.len() as u32;
                problem.patches.push(Patch { outer, inner, class: sheets.class_of[class] });
            }
            sheets.patch_of[id as usize] = sheets.patch_of[patch];
        }
        sheets.add_links(&mut problem, &facts);
        for squares in facts.iter().map(|facts| &facts.squares) {
            problem
                .squares
                .extend(squares.iter().map(|ids| Square(ids.map(|id| sheets.patch_of[id as usize]))));
        }
        for &[a, behind, before, b] in facts.iter().flat_map(|facts| &facts.seam_squares) {
            let [a, b] = [a, b].map(|id| sheets.patch_of[id as usize]);
            problem.squares.push(Square([a, behind, before, b]));
        }
        problem.squares.extend(regions.pieces.seam_squares(cut.grid).into_iter().map(Square));
        problem.squares.sort_unstable();
        problem.squares.dedup();
        problem.links.sort_unstable();
        problem.links.dedup();
        sheets.solution = problem
            .solve()
            .map_err(|Contradiction { region, given_up }| Trouble::Contradiction { region, given_up })?;
        Ok(sheets)
    }

    /// Adds how sheets go on, with a class for each copy that is asked for and one for each region of one copy.
    fn add_links(&self, problem: &mut Problem, facts: &[Facts]) {
        let mut alone = vec![NONE; problem.copies.len()];
        for facts in facts {
            let first = problem.classes.len() as u32;
            problem.classes.extend(&facts.asked);
            problem
                .origins
                .extend(facts.origins.iter().map(|&[asked, region, copy]| [first + asked, region, copy]));
            let first_hidden = problem.patches.len() as u32;
            // Their classes are those of the same cells, and these have several copies.
            problem.patches.extend(facts.hidden.iter().map(|&Hidden { parts: [outer, inner], class }| {
                let class = match class {
                    Copy::Asked(n) => first + n,
                    Copy::Behind(id) => self.class_of[id as usize],
                    Copy::Onward(..) => unreachable!("a sheet begins behind surface"),
                };
                Patch { outer, inner, class }
            }));
            for &Continues { step, outer, inner } in &facts.links {
                let patch_of = |step| match step {
                    Step::Crossing(id) => self.patch_of[id as usize],
                    Step::Seam(seam) => seam,
                    Step::Hidden(n) => first_hidden + n,
                };
                let patch = patch_of(step);
                let Patch { outer: before, inner: behind, .. } = problem.patches[patch as usize];
                let mut unknown = |copy, region: u32| match copy {
                    Copy::Asked(n) => Unknown::Class(first + n),
                    Copy::Onward(step, copy) => Unknown::Through(patch_of(step), copy),
                    Copy::Behind(id) if problem.copies[region as usize] > 1 => {
                        Unknown::Class(self.class_of[id as usize])
                    }
                    Copy::Behind(_) => {
                        let class = &mut alone[region as usize];
                        if *class == NONE {
                            *class = problem.classes.len() as u32;
                            problem.classes.push(region);
                        }
                        Unknown::Class(*class)
                    }
                };
                let (outer, inner) = (unknown(outer, before), unknown(inner, behind));
                problem.links.push(Link { patch, outer, inner });
            }
        }
    }

    /// The copy behind a crossing.
    pub(super) fn copy_inside(&self, crossing: u32) -> u32 {
        match self.class_of[crossing as usize] {
            NONE => 0,
            class => self.solution.of_class[class as usize],
        }
    }

    /// As which copy behind a crossing a copy before it goes on.
    pub(super) fn through(&self, crossing: u32, copy: u32) -> u32 {
        self.solution.through(self.patch_of[crossing as usize] as usize, copy)
    }

    /// As which copy behind a seam a copy before it goes on.
    pub(super) fn over(&self, seam: u32, copy: u32) -> u32 {
        self.solution.through(seam as usize, copy)
    }

    /// Whether the surface allows for other copies as well.
    pub(super) fn ambiguous(&self) -> bool {
        self.solution.ambiguous
    }
}

impl Facts {
    /// Adds what one cell says.
    fn add(&mut self, frame: &Frame, extension: std::ops::Range<u32>, regions: &Regions<'_>) {
        let winding = |part: u32| regions.pieces.winding(frame.piece(part));
        let region = |part: u32| regions.of(frame.piece(part));
        let list = frame.crossings();
        let mut patches: Vec<CellCrossing> = Vec::new();
        for (n, a) in list.iter().enumerate() {
            if winding(a.inner) < 2 {
                continue;
            }
            self.crossings.push([a.id, region(a.outer), region(a.inner)]);
            let same = |b: &&CellCrossing| b.hexahedron == a.hexahedron && b.inner == a.inner;
            if let Some(b) = list[..n].iter().find(same) {
                self.same_class.push([b.id, a.id]);
            }
            if let Some(b) = list[..n].iter().find(|b| same(b) && b.outer == a.outer) {
                self.same_patch.push([b.id, a.id]);
                continue;
            }
            patches.push(*a);
        }
        let hexahedra = distinct(patches.iter().map(|patch| patch.hexahedron));
        if hexahedra.len() > 2 || !frame.seams().is_empty() {
            self.follow_all(frame, &patches, extension, winding, region);
        } else {
            patches.iter().for_each(|patch| self.link(list, patch));
        }
        // Where one sheet lies before both there is one way only.
        patches.retain(|a| winding(a.outer) > 1);
        self.squares(&patches);
        self.seam_squares(&patches, frame);
    }

    /// Where more than two sheets meet: follows each as far as it goes.
    fn follow_all(
        &mut self,
        frame: &Frame,
        patches: &[CellCrossing],
        extension: std::ops::Range<u32>,
        winding: impl Fn(u32) -> i32,
        region: impl Fn(u32) -> u32,
    ) {
        let through = patches.iter().map(|patch| CellStep {
            step: Step::Crossing(patch.id),
            parts: [patch.outer, patch.inner],
            hexahedron: Some(patch.hexahedron),
        });
        let over = frame.seams().iter().map(|seam| CellStep {
            step: Step::Seam(seam.id),
            parts: seam.parts,
            hexahedron: None,
        });
        let mut steps: Vec<CellStep> = through.chain(over).collect();
        let mut cell = Continued::default();
        if frame.seams().is_empty() {
            let deep = distinct(steps.iter().flat_map(|step| step.parts));
            let count = extension.len();
            cell.add_hidden(&mut steps, &deep, extension.start, |part| frame.sides(part, count));
        }
        let mut steps = continued::meeting(steps, frame.places());
        if steps.is_empty() {
            return;
        }
        cell.keep_hidden_of(&mut steps);
        let list = frame.crossings();
        for hexahedron in distinct(list.iter().map(|crossing| crossing.hexahedron)) {
            let own = list.iter().filter(|crossing| crossing.hexahedron == hexahedron);
            let behind = own.map(|crossing| (crossing.inner, Copy::Behind(crossing.id)));
            cell.follow(&steps, Some(hexahedron), frame.places(), behind);
        }
        // Copies that are in the cell from the outset.
        let first = self.asked.len() as u32;
        for part in distinct(steps.iter().map(|step| step.parts[0])) {
            let hidden = |step: &CellStep| step.parts[1] == part && matches!(step.step, Step::Hidden(_));
            if list.iter().any(|crossing| crossing.inner == part) || steps.iter().any(hidden) {
                continue;
            }
            for copy in 0..winding(part).max(0) as u32 {
                let before = cell.asked.len() as u32;
                let from = steps.iter().filter(|step| step.parts[0] == part);
                let onward = from.map(|step| (step.parts[1], Copy::Onward(step.step, copy)));
                cell.follow(&steps, None, frame.places(), onward);
                let asked = before..cell.asked.len() as u32;
                self.origins.extend(asked.map(|asked| [first + asked, region(part), copy]));
            }
        }
        let hidden = self.hidden.len() as u32;
        let step_of = |step| match step {
            Step::Hidden(n) => Step::Hidden(hidden + n),
            other => other,
        };
        let shifted = |copy| match copy {
            Copy::Asked(n) => Copy::Asked(first + n),
            Copy::Onward(step, copy) => Copy::Onward(step_of(step), copy),
            other => other,
        };
        self.asked.extend(cell.asked.iter().map(|&part| region(part)));
        self.links.extend(cell.found.iter().map(|&Continues { step, outer, inner }| Continues {
            step: step_of(step),
            outer: shifted(outer),
            inner: shifted(inner),
        }));
        self.hidden.extend(
            cell.hidden
                .iter()
                .map(|&Hidden { parts, class }| Hidden { parts: parts.map(&region), class: shifted(class) }),
        );
    }

    /// Where two sheets cross either may be passed first.
    fn squares(&mut self, patches: &[CellCrossing]) {
        for a in patches {
            for b in patches.iter().filter(|b| b.outer == a.inner && b.hexahedron > a.hexahedron) {
                for c in patches.iter().filter(|c| c.outer == a.outer && c.hexahedron == b.hexahedron) {
                    let closes = |d: &&CellCrossing| {
                        d.outer == c.inner && d.inner == b.inner && d.hexahedron == a.hexahedron
                    };
                    self.squares.extend(patches.iter().filter(closes).map(|d| [a.id, b.id, c.id, d.id]));
                }
            }
        }
    }

    /// A sheet may be passed before a seam or behind it.
    fn seam_squares(&mut self, patches: &[CellCrossing], frame: &Frame) {
        for before in frame.seams() {
            for a in patches.iter().filter(|a| a.outer == before.parts[0]) {
                for behind in frame.seams().iter().filter(|behind| behind.parts[0] == a.inner) {
                    let beyond = |b: &&CellCrossing| {
                        b.outer == before.parts[1]
                            && b.inner == behind.parts[1]
                            && b.hexahedron == a.hexahedron
                    };
                    let squares = patches.iter().filter(beyond).map(|b| [a.id, behind.id, before.id, b.id]);
                    self.seam_squares.extend(squares);
                }
            }
        }
    }

    /// The sheets that go on through a patch.
    fn link(&mut self, list: &[CellCrossing], patch: &CellCrossing) {
        for outer in list.iter().filter(|c| c.inner == patch.outer && c.hexahedron != patch.hexahedron) {
            let behind = |c: &&CellCrossing| c.inner == patch.inner && c.hexahedron == outer.hexahedron;
            if let Some(inner) = list.iter().find(behind) {
                let [outer, inner] = [outer, inner].map(|crossing| Copy::Behind(crossing.id));
                self.links.push(Continues { step: Step::Crossing(patch.id), outer, inner });
            }
        }
    }
}

/// Each of some numbers once, sorted.
fn distinct(numbers: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut all: Vec<u32> = numbers.collect();
    all.sort_unstable();
    all.dedup();
    all
}
