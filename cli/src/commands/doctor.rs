//! `welter doctor`: does this build work on this machine?

use crate::codes::Code;
use crate::console::Stream;
use crate::failure::Failure;
use crate::machine;
use crate::numbers;
use crate::output::Output;
use crate::run::{Outcome, Run};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::IsTerminal;
use welter_predicates::{Sign, incircle, insphere, orient2d, orient3d, orient4d};

/// Check this build and this machine: predicates on known cases, threads, memory, terminal, a file written
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// List every error code with its exit code
    #[arg(long)]
    codes: bool,
    /// Panic on purpose, to try the bug report
    #[arg(long, hide = true)]
    panic: bool,
}

/// One answer known beforehand.
struct Case {
    name: &'static str,
    expected: Sign,
    found: Sign,
}

/// Inputs on which floating-point evaluation of the determinant goes wrong, with signs found in rational numbers.
fn cases() -> Vec<Case> {
    let tiny = f64::from_bits(1);
    let ulp = f64::EPSILON;
    let huge = 1e308;
    let p = |exponent: i32| f64::from_bits(((1023 + exponent) as u64) << 52);
    let case = |name, expected, found| Case { name, expected, found };
    vec![
        case("orient2d, collinear", Sign::Zero, orient2d([0.5, 0.5], [12.0, 12.0], [24.0, 24.0])),
        case("orient2d, one ulp off", Sign::Positive, orient2d([0.5, 0.5 + ulp], [12.0, 12.0], [24.0, 24.0])),
        case("orient2d, subnormal", Sign::Positive, orient2d([0.0, 0.0], [tiny, 0.0], [0.0, tiny])),
        case("orient2d, 1e308", Sign::Positive, orient2d([-huge, -huge], [huge, -huge], [0.0, huge])),
        case(
            "orient3d, 2^-400",
            Sign::Positive,
            orient3d([p(-400), 0.0, 0.0], [0.0, p(-400), 0.0], [0.0, 0.0, p(-400)], [0.0; 3]),
        ),
        case(
            "orient3d, 2^500",
            Sign::Negative,
            orient3d([0.0, p(500), 0.0], [p(500), 0.0, 0.0], [0.0, 0.0, p(500)], [0.0; 3]),
        ),
        case(
            "orient3d, coplanar",
            Sign::Zero,
            orient3d([0.1, 0.1, 0.1], [0.2, 0.2, 0.2], [0.3, 0.7, 0.9], [0.0; 3]),
        ),
        case(
            "orient4d, unit",
            Sign::Positive,
            orient4d(
                [1.0, 0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 1.0],
                [0.0; 4],
            ),
        ),
        case("incircle, cocircular", Sign::Zero, incircle([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0])),
        case(
            "incircle, mixed exponents",
            Sign::Negative,
            incircle(
                [0x2dd7_d386_e624_3a54, 0x1ff2_a08a_e0b0_8674].map(f64::from_bits),
                [0xa470_99dc_4b93_b81a, 0xbd71_112a_6c3b_2514].map(f64::from_bits),
                [0x68d4_721c_97f2_4c24, 0x2a45_96e2_0e00_e41a].map(f64::from_bits),
                [0x81a2_b4e3_9b73_efc0, 0x99fa_69d6_3ec3_5c3c].map(f64::from_bits),
            ),
        ),
        case(
            "insphere, cospherical",
            Sign::Zero,
            insphere([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]),
        ),
    ]
}

/// Says how many known answers came out, or fails with those that did not.
fn self_test(cases: &[Case]) -> Result<String, Box<Failure>> {
    let wrong: Vec<&Case> = cases.iter().filter(|case| case.found != case.expected).collect();
    if wrong.is_empty() {
        return Ok(format!("{} known answers reproduced", cases.len()));
    }
    let what = format!("{} of {} known answers came out wrong", wrong.len(), cases.len());
    let failure = Failure::new(Code::SelfTest, what).help("install again: cargo install --force --path cli");
    Err(wrong.into_iter().fold(failure, |failure, case| {
        failure.place(format!("{}: {:?}, should be {:?}", case.name, case.found, case.expected))
    }))
}

/// Writes a file to the folder for temporary files and takes it away again.
fn write_a_file() -> Result<String, Box<Failure>> {
    let path = std::env::temp_dir().join(format!("welter-doctor-{}", std::process::id()));
    Output::prepare(&path, true, &[])?.write(|file| file.write_all(b"welter"))?;
    let read = std::fs::read(&path);
    let _ = std::fs::remove_file(&path);
    match read {
        Ok(bytes) if bytes == b"welter" => {
            Ok(format!("written and read in {}", std::env::temp_dir().display()))
        }
        _ => Err(Failure::new(Code::WriteFailed, "what was written could not be read back")
            .subject(path.display().to_string())
            .help("export TMPDIR=/another/folder")),
    }
}

/// Every thread of the pool answers.
fn ask_threads(run: &Run) -> String {
    let answers = rayon::broadcast(|_| ()).len();
    format!("{answers} of {} answer; the machine has {}", run.threads, machine::threads())
}

pub(crate) fn run(args: &Args, run: &Run) -> Outcome {
    assert!(!args.panic, "asked to panic by --panic");
    if args.codes {
        return list_codes(run);
    }
    let memory = |bytes: Option<u64>| bytes.map_or_else(|| "unknown".to_owned(), numbers::bytes);
    let checks: [(&str, Result<String, Box<Failure>>); 6] = [
        ("predicates", self_test(&cases())),
        ("threads", Ok(ask_threads(run))),
        (
            "memory",
            Ok(format!(
                "{} of {} available",
                memory(machine::available_memory()),
                memory(machine::total_memory())
            )),
        ),
        ("features", Ok(features().join(" "))),
        ("terminal", Ok(terminal())),
        ("files", write_a_file()),
    ];
    let mut text = format!("welter {} ({})\n", env!("CARGO_PKG_VERSION"), system());
    let mut list = Vec::new();
    let mut failed = None;
    for (name, result) in checks {
        let (mark, detail) = match &result {
            Ok(detail) => ("ok", detail.clone()),
            Err(failure) => ("FAILED", failure.what.clone()),
        };
        let _ = writeln!(text, "  {mark:<6} {name:<11} {detail}");
        list.push(json!({ "name": name, "ok": result.is_ok(), "detail": detail }));
        failed = failed.or(result.err());
    }
    let mut object = json!({
        "version": env!("CARGO_PKG_VERSION"),
        "system": system(),
        "threads": run.threads,
        "available_memory_bytes": machine::available_memory(),
        "features": features(),
        "checks": list,
    });
    if let (Some(failure), Value::Object(map)) = (&failed, &mut object) {
        map.insert("error".to_owned(), failure.to_json());
    }
    run.console.result(&text)?;
    run.console.object(&object)?;
    failed.map_or(Ok(0), Err)
}

fn system() -> String {
    format!("{} {}", std::env::consts::OS, std::env::consts::ARCH)
}

/// What the compiler was told about this build.
fn features() -> Vec<&'static str> {
    let profile = if cfg!(debug_assertions) { "debug build (slow)" } else { "release build" };
    let fma = if cfg!(target_feature = "fma") { Some("fma") } else { None };
    let avx2 = if cfg!(target_feature = "avx2") { Some("avx2") } else { None };
    [Some(profile), fma, avx2].into_iter().flatten().collect()
}

fn terminal() -> String {
    let yes = |is: bool| if is { "yes" } else { "no" };
    format!(
        "standard output {}, standard error {}, colour {}",
        yes(std::io::stdout().is_terminal()),
        yes(std::io::stderr().is_terminal()),
        yes(Stream::Err.color())
    )
}

fn list_codes(run: &Run) -> Outcome {
    let mut text = String::from("code   exit  meaning\n");
    let mut list = Vec::new();
    for code in Code::ALL {
        let _ = writeln!(text, "{}  {:>4}  {}", code.id(), code.exit(), code.title());
        list.push(
            json!({ "code": code.id(), "exit": code.exit(), "title": code.title(), "why": code.why() }),
        );
    }
    run.console.result(&text)?;
    run.console.object(&json!({ "codes": list }))?;
    Ok(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_answers_come_out() {
        assert!(self_test(&cases()).is_ok());
    }

    #[test]
    fn a_wrong_answer_fails_the_self_test() {
        let mut cases = cases();
        cases[0].expected = Sign::Positive;
        let failure = self_test(&cases).expect_err("one expectation is wrong");
        assert_eq!(failure.code, Code::SelfTest);
        assert_eq!(failure.places, ["orient2d, collinear: Zero, should be Positive"]);
    }
}
