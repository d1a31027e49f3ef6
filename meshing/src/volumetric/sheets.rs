//! Which copy of which region lies behind each crossing: [`Sheets`].
//!
//! # Method
//! Crossings of one hexahedron of the extension that lead into one part of a cell lead into one copy: they are a class. Those that
//! also come from one part are a patch. A hexahedron with crossings into both parts beside a patch of another hexahedron is a sheet that
//! goes on through it: a link. What these facts say of the copies is worked out by [`Problem`]. Where at most one sheet
//! lies, there is nothing to tell apart.
//!
//! Complexity: near linear in the crossings, and what the search takes.

use super::copies::{Contradiction, Link, MAX_COPIES, Patch, Problem, SEAM, Solution, Square};
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
    /// A crossing of the patch, of the class outside and of the class inside.
    links: Vec<[u32; 3]>,
    /// A seam, and a crossing of the class on either side.
    seam_links: Vec<[u32; 3]>,
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
        let add = |facts: &mut Facts, frame: &Frame, _: [u32; 3], _: usize| facts.add(frame, regions);
        let facts = in_all_cells(cut, &regions.pieces, "copies of regions", monitor, |row| deep[row], add)?;
        let count = cut.crossings.axes.iter().map(|rows| rows.items().len()).sum();
        let (mut classes, mut patches) = (UnionFind::new(count), UnionFind::new(count));
        for facts in &facts {
            facts.same_class.iter().for_each(|&[a, b]| classes.unite(a, b));
            facts.same_patch.iter().for_each(|&[a, b]| patches.unite(a, b));
        }
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
        between.sort_unstable();
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
        let mut alone = vec![NONE; problem.copies.len()];
        for &[id, outer, inner] in facts.iter().flat_map(|facts| &facts.links) {
            let patch = sheets.patch_of[id as usize];
            let before = problem.patches[patch as usize].outer as usize;
            let outer = if problem.copies[before] > 1 {
                sheets.class_of[outer as usize]
            } else {
                if alone[before] == NONE {
                    alone[before] = problem.classes.len() as u32;
                    problem.classes.push(before as u32);
                }
                alone[before]
            };
            problem.links.push(Link { patch, outer, inner: sheets.class_of[inner as usize] });
        }
        for &[seam, outer, inner] in facts.iter().flat_map(|facts| &facts.seam_links) {
            let [outer, inner] = [outer, inner].map(|crossing| sheets.class_of[crossing as usize]);
            problem.links.push(Link { patch: seam, outer, inner });
        }
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
    fn add(&mut self, frame: &Frame, regions: &Regions<'_>) {
        let winding = |part: u32| regions.pieces.winding(frame.piece(part));
        let list = frame.crossings();
        let mut patches: Vec<CellCrossing> = Vec::new();
        for (n, a) in list.iter().enumerate() {
            if winding(a.inner) < 2 {
                continue;
            }
            let [outer, inner] = [a.outer, a.inner].map(|part| regions.of(frame.piece(part)));
            self.crossings.push([a.id, outer, inner]);
            let same = |b: &&CellCrossing| b.hexahedron == a.hexahedron && b.inner == a.inner;
            if let Some(b) = list[..n].iter().find(same) {
                self.same_class.push([b.id, a.id]);
            }
            if let Some(b) = list[..n].iter().find(|b| same(b) && b.outer == a.outer) {
                self.same_patch.push([b.id, a.id]);
                continue;
            }
            self.link(list, a);
            patches.push(*a);
        }
        // Where one sheet lies before both there is one way only.
        patches.retain(|a| winding(a.outer) > 1);
        self.squares(&patches);
        self.seam_squares(&patches, frame);
        for seam in frame.seams() {
            for a in list.iter().filter(|a| a.inner == seam.parts[0]) {
                let same = |b: &&CellCrossing| b.inner == seam.parts[1] && b.hexahedron == a.hexahedron;
                if let Some(b) = list.iter().find(same) {
                    self.seam_links.push([seam.id, a.id, b.id]);
                }
            }
        }
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
                self.links.push([patch.id, outer.id, inner.id]);
            }
        }
    }
}
