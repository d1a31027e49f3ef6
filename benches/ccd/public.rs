//! The public sets: reading them, and the report by set and by method.

use crate::{DEGENERATE_SETS, Kind, Rounds, Step, per_item};
use std::fs::File;
use std::hint::black_box;
use std::io::BufReader;
use std::path::Path;
use std::time::Instant;
use welter_predicates::ccd::Stage;
use welter_tracking::queries::{Parameters, Queries};

/// The queries of a file.
pub(crate) struct Set {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    pub(crate) steps: Vec<Step>,
    truths: Vec<Option<bool>>,
}

impl Set {
    fn is_degenerate(&self) -> bool {
        DEGENERATE_SETS.iter().any(|part| self.name.contains(part))
    }
}

/// All sets of a directory, by name.
pub(crate) fn read(directory: &Path) -> Result<Vec<Set>, String> {
    let told = |path: &Path, error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let mut names: Vec<_> = std::fs::read_dir(directory)
        .map_err(|error| told(directory, &error))?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()))
        .filter(|path| path.is_dir())
        .collect();
    names.sort();
    let mut sets = Vec::new();
    for folder in names {
        for kind in Kind::ALL {
            let path = folder.join(kind.name()).join("data_0_0.csv");
            let Ok(file) = File::open(&path) else { continue };
            let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let mut set = Set { name, kind, steps: Vec::new(), truths: Vec::new() };
            for query in Queries::new(BufReader::new(file), Parameters::default()) {
                let query = query.map_err(|error| told(&path, &error))?;
                set.steps.push([query.t0, query.t1]);
                set.truths.push(query.truth);
            }
            sets.push(set);
        }
    }
    if sets.is_empty() { Err(format!("no sets in {}", directory.display())) } else { Ok(sets) }
}

/// Sums over sets.
#[derive(Clone, Copy, Default)]
struct Total {
    queries: usize,
    time: f64,
    worst: f64,
}

pub(crate) fn report(sets: &[Set], rounds: Rounds, unit: f64) {
    let stages: Vec<String> = Stage::ALL.iter().map(|stage| format!("{stage:?}")).collect();
    println!(
        "{:28} {:11} {:>7} {:>8} {:>7} {:>9} {:>7} {:>6}   queries by stage: {}",
        "exact",
        "",
        "queries",
        "mean ns",
        "ratio",
        "worst ns",
        "ratio",
        "wrong",
        stages.join(" ")
    );
    for kind in Kind::ALL {
        let (mut all, mut usual) = (Total::default(), Total::default());
        for set in sets.iter().filter(|set| set.kind == kind) {
            let line = measure(set, rounds);
            println!(
                "{:28} {:11} {:7} {:8.1} {:7.1} {:9.0} {:7.0} {:6}   {:?}",
                set.name,
                kind.name(),
                set.steps.len(),
                line.mean,
                line.mean / unit,
                line.worst,
                line.worst / unit,
                line.wrong,
                line.stages
            );
            for total in if set.is_degenerate() { vec![&mut all] } else { vec![&mut all, &mut usual] } {
                total.queries += set.steps.len();
                total.time += line.mean * set.steps.len() as f64;
                total.worst = total.worst.max(line.worst);
            }
        }
        for (name, total) in [("all sets", all), ("without cliff-edges, unit-tests", usual)] {
            let mean = total.time / total.queries.max(1) as f64;
            println!(
                "{:40} {:7} {:8.1} {:7.1} {:9.0} {:7.0}",
                format!("{}, {name}", kind.name()),
                total.queries,
                mean,
                mean / unit,
                total.worst,
                total.worst / unit
            );
        }
        println!();
    }
    methods(sets, rounds, unit);
}

/// What a set shows.
struct Line {
    mean: f64,
    worst: f64,
    wrong: usize,
    stages: [usize; Stage::ALL.len()],
}

fn measure(set: &Set, rounds: Rounds) -> Line {
    let mean = per_item(rounds.passes, set.steps.len(), || {
        let contacts = set.steps.iter().filter(|step| set.kind.exact(step).0).count();
        black_box(contacts);
    });
    let (mut worst, mut wrong, mut stages) = (0.0f64, 0, [0; Stage::ALL.len()]);
    for (step, truth) in set.steps.iter().zip(&set.truths) {
        let mut shortest = f64::INFINITY;
        for _ in 0..rounds.singles {
            let start = Instant::now();
            black_box(set.kind.exact(black_box(step)));
            shortest = shortest.min(start.elapsed().as_nanos() as f64);
        }
        worst = worst.max(shortest);
        let (contact, stage) = set.kind.exact(step);
        wrong += usize::from(truth.is_some_and(|truth| truth != contact));
        stages[stage as usize] += 1;
    }
    Line { mean, worst, wrong, stages }
}

/// Decides a query.
type Decide = fn(Kind, &Step) -> bool;

/// The three methods on all sets.
fn methods(sets: &[Set], rounds: Rounds, unit: f64) {
    println!(
        "{:10} {:11} {:>8} {:>7} {:>9} {:>9}   against the known answers, all sets; times without cliff-edges, unit-tests",
        "method", "", "mean ns", "ratio", "false +", "false -"
    );
    let all: [(&str, Decide); 3] = [
        ("exact", |kind, step| kind.exact(step).0),
        ("parity", |kind, step| kind.parity(step)),
        ("spacetime", |kind, step| kind.spacetime(step)),
    ];
    for (name, decide) in all {
        for kind in Kind::ALL {
            let (mut time, mut queries, mut positives, mut negatives) = (0.0, 0, 0, 0);
            for set in sets.iter().filter(|set| set.kind == kind) {
                for (step, truth) in set.steps.iter().zip(&set.truths) {
                    let contact = decide(kind, step);
                    positives += usize::from(contact && *truth == Some(false));
                    negatives += usize::from(!contact && *truth == Some(true));
                }
                if !set.is_degenerate() {
                    let mean = per_item(rounds.passes / 4 + 1, set.steps.len(), || {
                        black_box(set.steps.iter().filter(|step| decide(kind, step)).count());
                    });
                    time += mean * set.steps.len() as f64;
                    queries += set.steps.len();
                }
            }
            let mean = time / queries.max(1) as f64;
            println!(
                "{name:10} {:11} {mean:8.1} {:7.1} {positives:9} {negatives:9}",
                kind.name(),
                mean / unit
            );
        }
    }
    println!();
}
