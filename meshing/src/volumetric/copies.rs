//! Which copy of a region is which, seen from each place of the surface: [`Problem`].
//!
//! # What it computes
//! A region around which the surface winds `w` times has `w` copies, which are all alike at first. The surface tells them apart:
//! * a *class* of crossings leads into one copy of a region, the one that begins behind that piece of surface;
//! * a *patch* of crossings leads from an outer region of `w` copies to an inner one of `w + 1`: the copies outside go on
//!   inside, each as another one, and the copy left over is that of the patch's class;
//! * a patch without a class is a *seam*: both regions have equally many copies, all of which go on;
//! * a *link* says of a patch that the copy of one class outside goes on as the copy of another class inside: a sheet of the
//!   surface is on both sides of the patch; a copy that has come through another patch stands for a class as well;
//! * a *square* says that going on through two patches, one after the other, is the same as through two others: where two sheets cross
//!   it does not matter which is passed first.
//!
//! A solution names the copy of each class and, for each patch, as which copy inside each copy outside goes on.
//!
//! # What it promises
//! A solution whenever there is one (within a stated number of guesses), and whether there is a second, that is, whether
//! the surface alone does not decide (an immersion that is not simple in the sense of \[Li18\]).
//!
//! # Method
//! Finite domains, sets of copies as bits; constraints narrow them until nothing changes: a patch is a permutation, a link a value of
//! it. Copies that nothing has named yet are alike, so that naming one is no guess. Where nothing follows, the least
//! domain is tried value by value, and taken back on contradiction.
//! In place of the overlap lists, the counting of copies and their deduplication in \[Gagniere22\] 3.6 to 3.7.3: there copies are
//! counted too high and merged where hexahedra coincide, which fails for surfaces within others; here their number is known.

/// Most copies of one region.
pub(super) const MAX_COPIES: u32 = 128;

/// The patch is a seam.
pub(super) const SEAM: u32 = u32::MAX;

/// Guesses that may be taken back before the search is given up.
const MAX_GUESSES: usize = 10_000;

/// Crossings through which copies go on in one way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Patch {
    /// The region before the surface.
    pub(super) outer: u32,
    /// The region behind it, of one more copy; of as many if it is a seam.
    pub(super) inner: u32,
    /// The class of its crossings, or [`SEAM`].
    pub(super) class: u32,
}

/// A copy to be named.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Unknown {
    /// That of a class.
    Class(u32),
    /// That as which a copy before a patch goes on.
    Through(u32, u32),
}

/// Through a patch one copy goes on as another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Link {
    pub(super) patch: u32,
    /// Of the outer region.
    pub(super) outer: Unknown,
    /// Of the inner region.
    pub(super) inner: Unknown,
}

/// Going on through the first two patches is the same as through the other two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Square(pub(super) [u32; 4]);

/// Regions, classes, patches, links and squares.
#[derive(Clone, Debug, Default)]
pub(super) struct Problem {
    /// How many copies each region has, at most [`MAX_COPIES`].
    pub(super) copies: Vec<u32>,
    /// The region of each class.
    pub(super) classes: Vec<u32>,
    /// Classes that are what a copy of a region goes on as: the class, the region and the copy; sorted. They ask the same for each copy of a region.
    pub(super) origins: Vec<[u32; 3]>,
    pub(super) patches: Vec<Patch>,
    pub(super) links: Vec<Link>,
    pub(super) squares: Vec<Square>,
}

/// A way to tell copies apart.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Solution {
    /// The copy of each class.
    pub(super) of_class: Vec<u32>,
    /// Where each patch begins in `through`.
    starts: Vec<usize>,
    through: Vec<u32>,
    /// Whether there is another solution.
    pub(super) ambiguous: bool,
}

impl Solution {
    /// As which copy inside a copy outside goes on.
    pub(super) fn through(&self, patch: usize, copy: u32) -> u32 {
        self.through[self.starts[patch] + copy as usize]
    }
}

/// There is no solution, or none was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Contradiction {
    /// A region where two things cannot be true together.
    pub(super) region: u32,
    /// Whether the search was given up before all was tried.
    pub(super) given_up: bool,
}

#[derive(Clone, Copy)]
enum Constraint {
    Patch(usize),
    Link(usize),
    Square(usize),
}

/// Constraints to look at again, each once.
struct Queue {
    list: Vec<Constraint>,
    waits: [Vec<bool>; 3],
}

impl Queue {
    fn new(problem: &Problem) -> Self {
        let counts = [problem.patches.len(), problem.links.len(), problem.squares.len()];
        Self { list: Vec::new(), waits: counts.map(|count| vec![false; count]) }
    }

    fn waits(&mut self, constraint: Constraint) -> &mut bool {
        match constraint {
            Constraint::Patch(number) => &mut self.waits[0][number],
            Constraint::Link(number) => &mut self.waits[1][number],
            Constraint::Square(number) => &mut self.waits[2][number],
        }
    }

    fn extend(&mut self, constraints: impl IntoIterator<Item = Constraint>) {
        for constraint in constraints {
            if !std::mem::replace(self.waits(constraint), true) {
                self.list.push(constraint);
            }
        }
    }

    fn pop(&mut self) -> Option<Constraint> {
        let constraint = self.list.pop()?;
        *self.waits(constraint) = false;
        Some(constraint)
    }

    fn clear(&mut self) {
        while self.pop().is_some() {}
    }
}

/// A guess, and what to go back to.
struct Guess {
    variable: usize,
    tried: u128,
    trail: usize,
}

/// What was changed: a domain, or the named copies of a region.
enum Change {
    Domain(usize, u128),
    Named(usize, u128),
}

struct Search<'a> {
    problem: &'a Problem,
    /// Where the variables of each patch begin: those of classes come first.
    starts: Vec<usize>,
    /// The patch of each variable behind those of classes.
    patch_of: Vec<u32>,
    domains: Vec<u128>,
    named: Vec<u128>,
    watchers: Vec<Vec<Constraint>>,
    trail: Vec<Change>,
    queue: Queue,
    guesses: Vec<Guess>,
    /// Guesses taken back so far.
    failures: usize,
}

impl Problem {
    /// Tells the copies apart.
    pub(super) fn solve(&self) -> Result<Solution, Contradiction> {
        let mut search = Search::new(self);
        search.queue.extend((0..self.patches.len()).map(Constraint::Patch));
        search.queue.extend((0..self.links.len()).map(Constraint::Link));
        search.queue.extend((0..self.squares.len()).map(Constraint::Square));
        search.run()?;
        let mut solution = search.solution();
        while !search.guesses.is_empty() && !solution.ambiguous {
            match search.take_back(0).and_then(|()| search.run()) {
                Ok(()) => {
                    solution.ambiguous = search.solution().through != solution.through
                        || search.solution().of_class != solution.of_class
                }
                Err(_) => break,
            }
        }
        Ok(solution)
    }
}

impl<'a> Search<'a> {
    fn new(problem: &'a Problem) -> Self {
        let mut domains: Vec<u128> =
            problem.classes.iter().map(|&region| all(problem.copies[region as usize])).collect();
        let mut watchers: Vec<Vec<Constraint>> = vec![Vec::new(); domains.len()];
        let (mut starts, mut patch_of) = (Vec::with_capacity(problem.patches.len()), Vec::new());
        for (number, patch) in problem.patches.iter().enumerate() {
            starts.push(domains.len());
            if patch.class != SEAM {
                watchers[patch.class as usize].push(Constraint::Patch(number));
            }
            for _ in 0..problem.copies[patch.outer as usize] {
                domains.push(all(problem.copies[patch.inner as usize]));
                watchers.push(vec![Constraint::Patch(number)]);
                patch_of.push(number as u32);
            }
        }
        for (number, link) in problem.links.iter().enumerate() {
            let patch = link.patch as usize;
            let copies = problem.copies[problem.patches[patch].outer as usize] as usize;
            let through = starts[patch]..starts[patch] + copies;
            let ends = [link.outer, link.inner].map(|unknown| variable(unknown, &starts));
            for variable in through.chain(ends) {
                watchers[variable].push(Constraint::Link(number));
            }
        }
        for (number, &Square(patches)) in problem.squares.iter().enumerate() {
            for patch in patches.map(|patch| patch as usize) {
                let copies = problem.copies[problem.patches[patch].outer as usize] as usize;
                for watcher in &mut watchers[starts[patch]..starts[patch] + copies] {
                    watcher.push(Constraint::Square(number));
                }
            }
        }
        let named = vec![0; problem.copies.len()];
        let mut search = Self {
            problem,
            starts,
            patch_of,
            domains,
            named,
            watchers,
            trail: Vec::new(),
            queue: Queue::new(problem),
            guesses: Vec::new(),
            failures: 0,
        };
        (0..search.domains.len()).for_each(|variable| search.name(variable));
        search
    }

    /// The region whose copies are a variable's values.
    fn region(&self, variable: usize) -> usize {
        let region = match variable.checked_sub(self.problem.classes.len()) {
            None => self.problem.classes[variable],
            Some(behind) => self.problem.patches[self.patch_of[behind] as usize].inner,
        };
        region as usize
    }

    /// The region and the copy outside of which a variable says as which it goes on.
    fn source(&self, variable: usize) -> Option<(usize, usize)> {
        let patch = self.patch_of[variable.checked_sub(self.problem.classes.len())?] as usize;
        Some((self.problem.patches[patch].outer as usize, variable - self.starts[patch]))
    }

    /// Notes the copies that a variable with one value names.
    fn name(&mut self, variable: usize) {
        let domain = self.domains[variable];
        if !domain.is_power_of_two() {
            return;
        }
        self.note(self.region(variable), domain);
        if let Some((outer, copy)) = self.source(variable) {
            self.note(outer, 1 << copy);
        } else if let Ok(place) =
            self.problem.origins.binary_search_by_key(&variable, |&[class, ..]| class as usize)
        {
            let [_, region, copy] = self.problem.origins[place];
            self.note(region as usize, 1 << copy);
        }
    }

    fn note(&mut self, region: usize, bits: u128) {
        if self.named[region] & bits != bits {
            self.trail.push(Change::Named(region, self.named[region]));
            self.named[region] |= bits;
        }
    }

    /// Narrows a domain.
    fn narrow(&mut self, variable: usize, to: u128) -> Result<(), Contradiction> {
        let (old, new) = (self.domains[variable], self.domains[variable] & to);
        if new == old {
            return Ok(());
        }
        if new == 0 {
            return Err(Contradiction { region: self.region(variable) as u32, given_up: false });
        }
        self.trail.push(Change::Domain(variable, old));
        self.domains[variable] = new;
        self.name(variable);
        self.queue.extend(self.watchers[variable].iter().copied());
        Ok(())
    }

    /// Narrows until nothing changes.
    fn propagate(&mut self) -> Result<(), Contradiction> {
        while let Some(constraint) = self.queue.pop() {
            let done = match constraint {
                Constraint::Patch(number) => self.permute(number),
                Constraint::Link(number) => self.link(number),
                Constraint::Square(number) => self.square(number),
            };
            if let Err(contradiction) = done {
                self.queue.clear();
                return Err(contradiction);
            }
        }
        Ok(())
    }

    /// The class of a patch and the copies that go on through it are all copies inside, each once.
    fn permute(&mut self, number: usize) -> Result<(), Contradiction> {
        let patch = self.problem.patches[number];
        let copies = self.problem.copies[patch.outer as usize] as usize;
        let start = self.starts[number];
        let count = copies + usize::from(patch.class != SEAM);
        let variable = |n: usize| if n == copies { patch.class as usize } else { start + n };
        for n in 0..count {
            let domain = self.domains[variable(n)];
            if domain.is_power_of_two() {
                for other in (0..count).filter(|&other| other != n) {
                    self.narrow(variable(other), !domain)?;
                }
            }
        }
        let (mut once, mut more) = (0, 0);
        for n in 0..count {
            let domain = self.domains[variable(n)];
            more |= once & domain;
            once |= domain;
        }
        if once != all(count as u32) {
            return Err(Contradiction { region: patch.inner, given_up: false });
        }
        let single = once & !more;
        for n in 0..count {
            let domain = self.domains[variable(n)] & single;
            if domain != 0 && !self.domains[variable(n)].is_power_of_two() {
                self.narrow(variable(n), domain & domain.wrapping_neg())?;
                // Two values that are nobody else's cannot both be had.
                if !domain.is_power_of_two() {
                    return Err(Contradiction { region: patch.inner, given_up: false });
                }
            }
        }
        Ok(())
    }

    /// The copy of a class outside goes on as that of a class inside.
    fn link(&mut self, number: usize) -> Result<(), Contradiction> {
        let Link { patch, outer, inner } = self.problem.links[number];
        let [outer, inner] = [outer, inner].map(|unknown| variable(unknown, &self.starts));
        let copies = self.problem.copies[self.problem.patches[patch as usize].outer as usize] as usize;
        let start = self.starts[patch as usize];
        let (mut from, mut onto) = (0, 0);
        for copy in bits(self.domains[outer]) {
            if self.domains[start + copy] & self.domains[inner] != 0 {
                from |= 1 << copy;
                onto |= self.domains[start + copy];
            }
        }
        self.narrow(outer, from)?;
        self.narrow(inner, onto)?;
        if self.domains[outer].is_power_of_two() {
            self.narrow(start + self.domains[outer].trailing_zeros() as usize, self.domains[inner])?;
        }
        if self.domains[inner].is_power_of_two() {
            let value = self.domains[inner];
            let others = all(copies as u32) & !self.domains[outer];
            for copy in bits(others) {
                self.narrow(start + copy, !value)?;
            }
        }
        Ok(())
    }

    /// Both ways around a square lead to the same copy.
    fn square(&mut self, number: usize) -> Result<(), Contradiction> {
        let Square(patches) = self.problem.squares[number];
        let copies = self.problem.copies[self.problem.patches[patches[0] as usize].outer as usize] as usize;
        let [a, b, c, d] = patches.map(|patch| self.starts[patch as usize]);
        for copy in 0..copies {
            let reached = |first: u128, second: usize| {
                bits(first).fold(0, |set, between| set | self.domains[second + between])
            };
            let both = reached(self.domains[a + copy], b) & reached(self.domains[c + copy], d);
            for (first, second) in [(a + copy, b), (c + copy, d)] {
                let domain = self.domains[first];
                let able = bits(domain).filter(|between| self.domains[second + between] & both != 0);
                let able = able.fold(0, |set, between| set | 1 << between);
                self.narrow(first, able)?;
                if able.is_power_of_two() {
                    self.narrow(second + able.trailing_zeros() as usize, both)?;
                }
            }
        }
        Ok(())
    }

    /// Finds a value for every variable.
    fn run(&mut self) -> Result<(), Contradiction> {
        let mut outcome = self.propagate();
        loop {
            outcome = match outcome {
                Err(contradiction) if self.guesses.is_empty() => return Err(contradiction),
                Err(contradiction) => {
                    self.failures += 1;
                    if self.failures > MAX_GUESSES {
                        return Err(Contradiction { given_up: true, ..contradiction });
                    }
                    self.take_back(contradiction.region)
                }
                Ok(()) => match self.choose() {
                    None => return Ok(()),
                    Some(outcome) => outcome,
                },
            };
        }
    }

    /// Gives a value to one more variable: first those where it is no guess. None if all have one.
    fn choose(&mut self) -> Option<Result<(), Contradiction>> {
        let mut least: Option<usize> = None;
        let mut changed = false;
        for variable in 0..self.domains.len() {
            let domain = self.domains[variable];
            if domain.is_power_of_two() {
                continue;
            }
            if self.is_free(variable) {
                changed = true;
                let outcome =
                    self.narrow(variable, domain & domain.wrapping_neg()).and_then(|()| self.propagate());
                if outcome.is_err() {
                    return Some(outcome);
                }
            } else if least.is_none_or(|least| domain.count_ones() < self.domains[least].count_ones()) {
                least = Some(variable);
            }
        }
        if changed {
            return Some(Ok(()));
        }
        let variable = least?;
        let domain = self.domains[variable];
        let value = domain & domain.wrapping_neg();
        // Copies without a name are alike: if one fails, all do.
        let nameless = !self.named[self.region(variable)];
        let tried = if value & nameless != 0 { domain & nameless } else { value };
        self.guesses.push(Guess { variable, tried, trail: self.trail.len() });
        Some(self.narrow(variable, value).and_then(|()| self.propagate()))
    }

    /// Whether any value of a variable is as good as any other.
    fn is_free(&self, variable: usize) -> bool {
        let domain = self.domains[variable];
        if domain & self.named[self.region(variable)] == 0 {
            return true;
        }
        let Some((outer, copy)) = self.source(variable) else { return false };
        let nameless = all(self.problem.copies[outer]) & !self.named[outer];
        let start = variable - copy;
        let alike = bits(nameless).filter(|other| self.domains[start + other] == domain).count();
        nameless >> copy & 1 == 1 && alike == domain.count_ones() as usize
    }

    /// Takes back the last guess and rules out what was tried.
    fn take_back(&mut self, region: u32) -> Result<(), Contradiction> {
        let Some(guess) = self.guesses.pop() else { return Err(Contradiction { region, given_up: false }) };
        self.queue.clear();
        for change in self.trail.drain(guess.trail..).rev() {
            match change {
                Change::Domain(variable, old) => self.domains[variable] = old,
                Change::Named(region, old) => self.named[region] = old,
            }
        }
        self.narrow(guess.variable, !guess.tried)?;
        self.propagate()
    }

    fn solution(&self) -> Solution {
        let values: Vec<u32> = self.domains.iter().map(|domain| domain.trailing_zeros()).collect();
        let classes = self.problem.classes.len();
        Solution {
            of_class: values[..classes].to_vec(),
            starts: self.starts.iter().map(|start| start - classes).collect(),
            through: values[classes..].to_vec(),
            ambiguous: false,
        }
    }
}

/// The number of the variable for an unknown copy.
fn variable(unknown: Unknown, starts: &[usize]) -> usize {
    match unknown {
        Unknown::Class(class) => class as usize,
        Unknown::Through(patch, copy) => starts[patch as usize] + copy as usize,
    }
}

/// The first `count` copies.
fn all(count: u32) -> u128 {
    if count >= 128 { u128::MAX } else { (1 << count) - 1 }
}

/// The copies of a set.
fn bits(mut set: u128) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (set != 0).then(|| set.trailing_zeros() as usize)?;
        set &= set - 1;
        Some(bit)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two bodies A and B that overlap: regions A only, B only, both; classes in them: A's and B's surface.
    fn overlap(links: Vec<Link>) -> Problem {
        Problem {
            copies: vec![1, 1, 2],
            // 0: A's surface into A only, 1: B's into B only, 2: A's surface into both, 3: B's surface into both.
            classes: vec![0, 1, 2, 2],
            patches: vec![Patch { outer: 0, inner: 2, class: 3 }, Patch { outer: 1, inner: 2, class: 2 }],
            links,
            ..Problem::default()
        }
    }

    #[test]
    fn overlapping_bodies_stay_apart() {
        let problem = overlap(vec![Link { patch: 0, outer: Unknown::Class(0), inner: Unknown::Class(2) }]);
        let solution = problem.solve().unwrap();
        assert_ne!(solution.of_class[2], solution.of_class[3]);
        assert_eq!(solution.through(0, 0), solution.of_class[2]);
        assert_eq!(solution.through(1, 0), solution.of_class[3]);
        assert!(!solution.ambiguous);
    }

    #[test]
    fn a_copy_that_went_through_one_patch_is_followed_through_the_next() {
        // Three bodies; from A into A and B, on into all, and from there along a second way round.
        let problem = |links| Problem {
            copies: vec![1, 2, 2, 3],
            classes: vec![1, 2, 3, 3, 3],
            patches: vec![
                Patch { outer: 0, inner: 1, class: 0 },
                Patch { outer: 0, inner: 2, class: 1 },
                Patch { outer: 1, inner: 3, class: 2 },
                Patch { outer: 2, inner: 3, class: 3 },
            ],
            links,
            origins: vec![[4, 0, 0]],
            ..Problem::default()
        };
        // A's only copy is class 4 in the end, whichever way.
        let way = |first, second| Link {
            patch: second,
            outer: Unknown::Through(first, 0),
            inner: Unknown::Class(4),
        };
        let solution = problem(vec![way(0, 2), way(1, 3)]).solve().unwrap();
        let along = |first, second| solution.through(second as usize, solution.through(first as usize, 0));
        assert_eq!(along(0, 2), solution.of_class[4]);
        assert_eq!(along(1, 3), solution.of_class[4]);
        assert!(problem(vec![]).solve().unwrap().ambiguous);
    }

    #[test]
    fn without_links_two_solutions_are_seen() {
        assert!(overlap(vec![]).solve().unwrap().ambiguous);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        // A's surface goes on as B's, which begins at the patch itself.
        let contradiction =
            overlap(vec![Link { patch: 0, outer: Unknown::Class(0), inner: Unknown::Class(3) }])
                .solve()
                .unwrap_err();
        assert_eq!(contradiction, Contradiction { region: 2, given_up: false });
    }

    #[test]
    fn bodies_within_bodies_are_no_guess() {
        // Four balls, each within the one before.
        let problem = Problem {
            copies: vec![1, 2, 3, 4],
            classes: vec![0, 1, 2, 3],
            patches: (0..3).map(|n| Patch { outer: n, inner: n + 1, class: n + 1 }).collect(),
            links: vec![],
            squares: vec![],
            origins: vec![],
        };
        let solution = problem.solve().unwrap();
        assert!(!solution.ambiguous);
        for patch in 0..3 {
            let mut copies: Vec<u32> = (0..=patch as u32).map(|copy| solution.through(patch, copy)).collect();
            copies.push(solution.of_class[patch + 1]);
            copies.sort_unstable();
            assert_eq!(copies, (0..=patch as u32 + 1).collect::<Vec<_>>());
        }
    }

    /// All solutions by enumeration, to compare with.
    fn has_solution(problem: &Problem) -> bool {
        let sizes: Vec<u32> = Search::new(problem).domains.iter().map(|domain| domain.count_ones()).collect();
        let total: u64 = sizes.iter().map(|&n| u64::from(n)).product();
        (0..total).any(|mut number| {
            let values: Vec<u32> = sizes
                .iter()
                .map(|&n| {
                    let value = number % u64::from(n);
                    number /= u64::from(n);
                    value as u32
                })
                .collect();
            let mut search = Search::new(problem);
            let narrowed = values.iter().enumerate().try_for_each(|(v, &value)| search.narrow(v, 1 << value));
            let (patches, links) = (problem.patches.len(), problem.links.len());
            search.queue.extend((0..patches).map(Constraint::Patch).chain((0..links).map(Constraint::Link)));
            narrowed.is_ok() && search.propagate().is_ok()
        })
    }

    #[test]
    fn agrees_with_enumeration() {
        let mut state = 1u64;
        let mut random = |n: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32 % n
        };
        let mut solved = 0;
        for _ in 0..300 {
            let copies = vec![1, 1, 2, 2, 3];
            let classes = vec![0, 1, 2, 2, 3, 4, 4];
            let patches: Vec<Patch> = (0..1 + random(3))
                .map(|_| {
                    let (outer, inner, class) =
                        [(0, 2, 2), (1, 2, 3), (0, 3, 4), (2, 4, 5), (3, 4, 6), (2, 4, 6)]
                            [random(6) as usize];
                    Patch { outer, inner, class }
                })
                .collect();
            let links = (0..random(4))
                .map(|_| {
                    let patch = random(patches.len() as u32);
                    let of = |region: u32| {
                        classes
                            .iter()
                            .enumerate()
                            .filter(move |(_, r)| **r == region)
                            .map(|(c, _)| c as u32)
                            .collect::<Vec<_>>()
                    };
                    let (outer, inner) =
                        (of(patches[patch as usize].outer), of(patches[patch as usize].inner));
                    Link {
                        patch,
                        outer: Unknown::Class(outer[random(outer.len() as u32) as usize]),
                        inner: Unknown::Class(inner[random(inner.len() as u32) as usize]),
                    }
                })
                .collect();
            let problem = Problem { copies, classes, patches, links, squares: vec![], origins: vec![] };
            let found = problem.solve();
            assert_eq!(found.is_ok(), has_solution(&problem), "{problem:?}");
            solved += usize::from(found.is_ok());
        }
        assert!((50..280).contains(&solved), "{solved} of 300 have a solution");
    }
}
