//! Answers and times of queries: [`Figures`].
//!
//! What it computes: answers, compared with the known ones where there are any; how many queries each group of stages
//! settled; times. The mean is taken over whole passes through a block of queries, so that no clock is read between two
//! of them; of several passes the quickest counts, because whatever else the machine does only adds. For the worst query
//! each is timed alone, again with the quickest of several runs; that contains one reading of the clock, some tens of
//! nanoseconds.

use super::method::{Decider, Decision, Settled};
use std::hint::black_box;
use std::time::{Duration, Instant};
use welter_tracking::queries::Query;

/// A query whose answer is not the known one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FalseAnswer {
    /// The number of the query in its file, from 0.
    pub(super) query: u64,
    /// The line of its first row.
    pub(super) line: u64,
    /// The answer found.
    pub(super) found: bool,
}

impl FalseAnswer {
    /// `file:line: query 3: contact found, known: none`.
    pub(super) fn to_text(self, file: &str) -> String {
        let what = if self.found { "contact found, known: none" } else { "no contact found, known: contact" };
        format!("{file}:{}: query {}: {what}", self.line, self.query)
    }
}

/// What is known of the queries of a file, or of many.
#[derive(Clone, Debug, Default)]
pub(super) struct Figures {
    pub(super) queries: u64,
    pub(super) collisions: u64,
    /// Queries whose answer is known beforehand.
    pub(super) with_truth: u64,
    pub(super) false_positives: u64,
    pub(super) false_negatives: u64,
    /// Queries by the stage that settled them, in the order of [`Settled::ALL`].
    pub(super) settled: [u64; Settled::ALL.len()],
    /// The quickest pass through every block.
    pub(super) time: Duration,
    pub(super) worst: Duration,
    /// Coordinates rounded on reading.
    pub(super) rounded: u64,
}

impl Figures {
    /// Decides a block of queries; gives the answers and those that are false.
    pub(super) fn add_block(
        &mut self,
        block: &[Query],
        decide: Decider,
        repeat: u32,
    ) -> (Vec<bool>, Vec<FalseAnswer>) {
        let mut answers = Vec::with_capacity(block.len());
        let mut wrong = Vec::new();
        for (query, number) in block.iter().zip(self.queries..) {
            let Decision { collides, settled } = decide(query);
            answers.push(collides);
            self.collisions += u64::from(collides);
            if let Some(settled) = settled {
                self.settled[settled as usize] += 1;
            }
            self.with_truth += u64::from(query.truth.is_some());
            if query.truth.is_some_and(|truth| truth != collides) {
                self.false_positives += u64::from(collides);
                self.false_negatives += u64::from(!collides);
                wrong.push(FalseAnswer { query: number, line: query.line, found: collides });
            }
        }
        self.queries += block.len() as u64;
        if repeat > 0 {
            self.time += quickest(repeat, || {
                for query in block {
                    black_box(decide(black_box(query)));
                }
            });
            for query in block {
                let alone = quickest(repeat, || {
                    black_box(decide(black_box(query)));
                });
                self.worst = self.worst.max(alone);
            }
        }
        (answers, wrong)
    }

    /// Adds those of other queries.
    pub(super) fn add(&mut self, other: &Self) {
        self.queries += other.queries;
        self.collisions += other.collisions;
        self.with_truth += other.with_truth;
        self.false_positives += other.false_positives;
        self.false_negatives += other.false_negatives;
        for (sum, more) in self.settled.iter_mut().zip(other.settled) {
            *sum += more;
        }
        self.time += other.time;
        self.worst = self.worst.max(other.worst);
        self.rounded += other.rounded;
    }

    /// Nanoseconds a query, where queries were timed.
    pub(super) fn mean_ns(&self) -> Option<f64> {
        (self.time > Duration::ZERO).then(|| self.time.as_secs_f64() * 1e9 / self.queries as f64)
    }

    /// Nanoseconds of the worst query, where queries were timed.
    pub(super) fn max_ns(&self) -> Option<u64> {
        (self.worst > Duration::ZERO).then(|| u64::try_from(self.worst.as_nanos()).unwrap_or(u64::MAX))
    }

    /// The stages, unless the method does not tell them.
    pub(super) fn stages(&self) -> Option<[u64; Settled::ALL.len()]> {
        (self.queries == self.settled.iter().sum::<u64>()).then_some(self.settled)
    }
}

fn quickest(repeat: u32, mut work: impl FnMut()) -> Duration {
    let mut best = Duration::MAX;
    for _ in 0..repeat {
        let start = Instant::now();
        work();
        best = best.min(start.elapsed());
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Contact where the first coordinate is positive.
    fn positive(query: &Query) -> Decision {
        Decision { collides: query.t0[0][0] > 0.0, settled: None }
    }

    fn query(x: f64, truth: Option<bool>, line: u64) -> Query {
        Query { t0: [[x; 3]; 4], t1: [[0.0; 3]; 4], truth, line }
    }

    #[test]
    fn false_answers_are_counted_and_named() {
        let mut figures = Figures::default();
        let block = [
            query(1.0, Some(true), 1),
            query(1.0, Some(false), 9),
            query(-1.0, Some(true), 17),
            query(-1.0, None, 25),
        ];
        let (answers, wrong) = figures.add_block(&block, positive, 0);
        assert_eq!(answers, [true, true, false, false]);
        let text: Vec<String> = wrong.iter().map(|w| w.to_text("a.csv")).collect();
        assert_eq!(
            text,
            [
                "a.csv:9: query 1: contact found, known: none",
                "a.csv:17: query 2: no contact found, known: contact"
            ]
        );
        let (_, wrong) = figures.add_block(&block[1..2], positive, 0);
        assert_eq!(wrong[0].query, 4, "numbers go on from block to block");
        assert_eq!((figures.queries, figures.with_truth, figures.collisions), (5, 4, 3));
        assert_eq!((figures.false_positives, figures.false_negatives), (2, 1));
        assert_eq!(figures.stages(), None, "the method does not tell its stages");
        assert_eq!((figures.mean_ns(), figures.max_ns()), (None, None), "nothing was timed");
    }

    #[test]
    fn figures_add_up() {
        let mut figures = Figures::default();
        figures.add_block(&[query(1.0, Some(false), 1)], positive, 2);
        let mut sum = figures.clone();
        sum.add(&figures);
        assert_eq!((sum.queries, sum.false_positives, sum.with_truth, sum.collisions), (2, 2, 2, 2));
        assert_eq!((sum.time, sum.worst), (2 * figures.time, figures.worst));
    }
}
