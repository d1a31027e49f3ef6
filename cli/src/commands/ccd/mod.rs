//! `welter ccd`: answers files of collision queries, and compares with the answers known beforehand.
//!
//! The report is the product, so false answers are reported with exit code 0; `--require correct` makes a gate of it.
//! Files are read in blocks, so memory does not grow with their size. What is found before the work (a file that is not
//! there, a kind that is not clear, an output that cannot be written) stops the command; what is found in a file while
//! it is read fails that file alone, and then no answers are written, because their order would have a gap.

#![allow(clippy::vec_box, reason = "failures travel boxed, so that results stay small")]

mod files;
mod kind;
mod measure;
mod method;
mod report;

use crate::codes::Code;
use crate::failure::{Failure, shell_word, shown};
use crate::numbers::grouped;
use crate::output::{Output, WriteProblem};
use crate::run::{Outcome, Run};
use crate::surface_file::refuse_standard_output;
use clap::{ValueEnum, value_parser};
use files::Source;
use kind::{Kind, KindOption};
use measure::{FalseAnswer, Figures};
use method::Method;
use report::Table;
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use welter_tracking::queries::Parameters;

/// Answer files of continuous collision queries, and compare with known answers
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A query is eight rows: the four vertices at the beginning of a time step, then at its end. A vertex against a
face: the vertex, then the corners of the face; two edges: the ends of one, then of the other. A row is seven
integers: numerator and denominator of x, of y, of z, then the known answer, 1 for contact, else 0, which may be
missing from the whole file. Coordinates are taken exactly.

Times: mean ns is that of the quickest of --repeat passes through blocks of 1,024 queries; max ns is the slowest
query, each timed alone, the quickest of --repeat runs, with one reading of the clock. One thread is used.
Culled: a direction keeps the primitives apart; filtered: rounded arithmetic with proven bounds; exact: the rest.

Exit codes: 0 when every query was answered, even if falsely; 4 when a file cannot be read; 9 when a file lacks
what --require asks for. With several files, the code of the first that failed. When a file cannot be read,
--answers is not written.

Examples:
  welter ccd benchmark/                             every *.csv in the folder and below it
  welter ccd edge-edge/0.csv --answers answers.txt
  welter ccd --kind vertex-face queries.csv -v      lists false answers
  welter ccd --quiet --require correct benchmark/ && echo all right")]
pub(crate) struct Args {
    /// Files of queries, or folders with *.csv at any depth; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    inputs: Vec<PathBuf>,
    /// How queries are decided
    #[arg(long, value_enum, default_value_t = Method::Exact, value_name = "METHOD")]
    method: Method,
    /// What the files hold; auto: `edge-edge`, `vertex-face`, `ee` or `vf` in the name of the file or its folders
    #[arg(long, value_enum, default_value_t = KindOption::Auto, value_name = "KIND")]
    kind: KindOption,
    /// Write the answers, 0 or 1 a line, in the order of the queries; not overwritten without --force
    #[arg(long, value_name = "OUT")]
    answers: Option<PathBuf>,
    /// Fail with exit code 9 unless every answer is the known one
    #[arg(long, value_enum, value_name = "PROPERTY")]
    require: Option<Requirement>,
    /// Take the nearest number where a coordinate is no f64, and count these; else such a file is refused
    #[arg(long)]
    rounded: bool,
    /// Runs of which the quickest counts; 0: no times
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = value_parser!(u32).range(0..=1000))]
    repeat: u32,
}

/// What can be required.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Requirement {
    /// Every answer is known beforehand, and found
    Correct,
}

/// Queries decided between two looks at the file: many enough that the clock does not count, few enough to stay in
/// the second-level cache (220 kB).
const BLOCK: usize = 1024;
/// False answers of a file that an error names; `-v` lists all.
const PLACES: usize = 5;

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    let console = &run.console;
    let sources = files::find(&args.inputs, args.kind)?;
    let output = prepare_answers(args, run, &sources)?;
    let mut survey = Survey::new(args, run, &sources);
    let written = match output {
        Some(output) => output.write(|file| survey.all(&sources, file)),
        None => {
            // Nothing fails here but reading, which the survey keeps.
            let _ = survey.all(&sources, &mut io::sink());
            Ok(())
        }
    };
    console.progress.clear();
    match (written, &args.answers) {
        (Err(failure), _) if survey.unreadable.is_none() => return Err(failure),
        (Err(_), Some(name)) => console
            .note(&format!("{}: not written, because a file of queries could not be read", name.display())),
        _ => {}
    }
    survey.tell()
}

/// The file for the answers, if one is asked for, checked and opened.
fn prepare_answers(args: &Args, run: &Run, sources: &[Source]) -> Result<Option<Output>, Box<Failure>> {
    let Some(name) = &args.answers else {
        return Ok(None);
    };
    refuse_standard_output(name)?;
    let inputs: Vec<&Path> = sources.iter().map(|source| source.name.as_path()).collect();
    Output::prepare(name, run.force, &inputs).map(Some)
}

/// The work on all files, and what is known so far.
struct Survey<'a> {
    args: &'a Args,
    run: &'a Run,
    /// Bytes read of the files that are done.
    bytes_done: u64,
    /// Bytes of all files; 0 where the size of one is not known.
    bytes_total: u64,
    files: Vec<Value>,
    table: Table,
    /// In the order of [`Kind::ALL`].
    sums: [Figures; Kind::ALL.len()],
    /// The first failure, which gives the exit code.
    first: Option<Box<Failure>>,
    /// The first file that could not be read.
    unreadable: Option<Box<Failure>>,
}

impl<'a> Survey<'a> {
    fn new(args: &'a Args, run: &'a Run, sources: &[Source]) -> Self {
        let bytes_total = sources.iter().map(|source| source.bytes).sum::<Option<u64>>().unwrap_or(0);
        Self {
            args,
            run,
            bytes_done: 0,
            bytes_total,
            files: Vec::new(),
            table: Table::new(),
            sums: [Figures::default(), Figures::default()],
            first: None,
            unreadable: None,
        }
    }

    /// Answers every file; an error means that what went to `answers` is not whole.
    fn all(&mut self, sources: &[Source], answers: &mut dyn Write) -> Result<(), WriteProblem> {
        for source in sources {
            let mut object = Map::new();
            object.insert("file".to_owned(), json!(shown(&source.name)));
            object.insert("kind".to_owned(), json!(source.kind.key()));
            let mut failures = Vec::new();
            match self.file(source, answers) {
                Ok((figures, wrong)) => {
                    object.extend(report::to_json(&figures));
                    failures.extend(self.lacking(source, &figures, &wrong));
                    self.sums[source.kind as usize].add(&figures);
                    self.table.push(shown(&source.name), source.kind, &figures);
                }
                Err(WriteProblem::Failure(failure)) => {
                    self.unreadable.get_or_insert_with(|| failure.clone());
                    failures.push(failure);
                }
                Err(problem @ WriteProblem::Io(_)) => return Err(problem),
            }
            for failure in failures {
                self.run.console.error(&failure);
                object.entry("error").or_insert_with(|| failure.to_json());
                self.first.get_or_insert(failure);
            }
            self.files.push(Value::Object(object));
        }
        self.unreadable.clone().map_or(Ok(()), |failure| Err(WriteProblem::Failure(failure)))
    }

    /// Answers one file, block by block; gives its figures and the first few false answers.
    fn file(
        &mut self,
        source: &Source,
        answers: &mut dyn Write,
    ) -> Result<(Figures, Vec<FalseAnswer>), WriteProblem> {
        let console = &self.run.console;
        let mut queries = source.queries(Parameters { rounded: self.args.rounded })?;
        let decide = self.args.method.decider(source.kind);
        let (mut figures, mut first_wrong) = (Figures::default(), Vec::new());
        let mut block = Vec::with_capacity(BLOCK);
        loop {
            block.clear();
            for query in queries.by_ref().take(BLOCK) {
                block.push(query.map_err(|error| files::not_understood(source, &error))?);
            }
            if block.is_empty() {
                break;
            }
            let (found, wrong) = figures.add_block(&block, decide, self.args.repeat);
            for answer in found {
                answers.write_all(if answer { b"1\n" } else { b"0\n" })?;
            }
            for answer in &wrong {
                console.detail(1, &answer.to_text(&shown(&source.name)));
            }
            let room = PLACES - first_wrong.len();
            first_wrong.extend(wrong.into_iter().take(room));
            console.progress.report("queries", self.bytes_done + queries.bytes_read(), self.bytes_total);
        }
        self.bytes_done += queries.bytes_read();
        figures.rounded = queries.rounded();
        if figures.rounded > 0 {
            let count = grouped(figures.rounded);
            console.note(&format!("{}: {count} coordinates rounded", source.name.display()));
        }
        Ok((figures, first_wrong))
    }

    /// What the file lacks of `--require`.
    fn lacking(&self, source: &Source, figures: &Figures, wrong: &[FalseAnswer]) -> Option<Box<Failure>> {
        let Some(Requirement::Correct) = self.args.require else {
            return None;
        };
        let name = shown(&source.name);
        let (word, kind) = (shell_word(&source.name), source.kind.name());
        if figures.with_truth < figures.queries {
            return Some(
                Failure::new(Code::NoKnownAnswers, "the file tells no answers to compare with")
                    .subject(name)
                    .help(format!("welter ccd {word} --kind {kind}   # without --require correct")),
            );
        }
        if wrong.is_empty() {
            return None;
        }
        let what = format!(
            "{} false positives, {} false negatives",
            grouped(figures.false_positives),
            grouped(figures.false_negatives)
        );
        let mut failure = Failure::new(Code::FalseAnswers, what)
            .subject(&name)
            .help(format!("welter ccd {word} --kind {kind} -v   # lists them all"));
        for answer in wrong {
            failure = failure.place(answer.to_text(&name));
        }
        failure.place_count = (figures.false_positives + figures.false_negatives) as usize;
        Some(failure)
    }

    /// Tells the person and the script; gives the exit code.
    fn tell(mut self) -> Outcome {
        let console = &self.run.console;
        if !self.table.is_empty() {
            if self.files.len() > 1 {
                for (kind, sum) in Kind::ALL.into_iter().zip(&self.sums).filter(|(_, sum)| sum.queries > 0) {
                    self.table.push("total".to_owned(), kind, sum);
                }
            }
            console.result(&(self.table.to_text() + &report::verdict(&self.sums)))?;
        }
        let mut total = Map::new();
        for (kind, sum) in Kind::ALL.into_iter().zip(&self.sums) {
            total.insert(kind.key().to_owned(), Value::Object(report::to_json(sum)));
        }
        let mut object = Map::new();
        object.insert("method".to_owned(), json!(self.args.method.name()));
        object.insert("repeat".to_owned(), json!(self.args.repeat));
        object.insert("files".to_owned(), Value::Array(self.files));
        object.insert("total".to_owned(), Value::Object(total));
        if let (Some(name), None) = (&self.args.answers, &self.unreadable) {
            object.insert("answers".to_owned(), json!(shown(name)));
        }
        if let Some(failure) = &self.first {
            object.insert("error".to_owned(), failure.to_json());
        }
        console.object(&Value::Object(object))?;
        Ok(self.first.map_or(0, |failure| failure.code.exit()))
    }
}
