//! A surface on its way to a file.

use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::input::{FormatName, STANDARD, format_of};
use crate::output::{Output, WriteProblem};
use crate::run::Run;
use std::path::{Path, PathBuf};
use welter_meshing::io::{self, Encoding, Format, SurfaceData, WriteError, WriteOptions};

/// Where and how a command writes a surface.
#[derive(clap::Args, Clone, Debug)]
pub(crate) struct Writing {
    /// File to write, not overwritten without --force; `-` is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,
    /// Format of the output [default: by its extension]; needed for standard output
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) to: Option<FormatName>,
    /// Write text where the format has text and binary (PLY, STL)
    #[arg(long)]
    pub(crate) ascii: bool,
}

impl Writing {
    /// The format, from `--to` or the extension.
    pub(crate) fn format(&self) -> Result<Format, Box<Failure>> {
        match self.to {
            Some(format) => Ok(format.format()),
            None => format_of(&self.output, "--to"),
        }
    }

    pub(crate) fn options(&self) -> WriteOptions {
        WriteOptions { encoding: if self.ascii { Encoding::Ascii } else { Encoding::Binary } }
    }
}

/// With `--json`, standard output cannot also take a file.
pub(crate) fn refuse_standard_output_with_json(output: &Path, run: &Run) -> Result<(), Box<Failure>> {
    if output == Path::new(STANDARD) && run.console.json {
        return Err(Failure::new(
            Code::StandardOutputTaken,
            "standard output cannot take the file and the JSON object",
        )
        .help("name an output file with -o, or leave out --json"));
    }
    Ok(())
}

/// Writes a surface; returns what the format could not hold, in words.
pub(crate) fn write_surface<S: SurfaceData>(
    output: Output,
    format: Format,
    surface: &S,
    options: &WriteOptions,
) -> Result<Vec<String>, Box<Failure>> {
    let name = output.name().to_owned();
    let report = output.write(|file| {
        io::write(format, file, surface, options).map_err(|error| match error {
            WriteError::Io(error) => WriteProblem::Io(error),
            other => WriteProblem::Failure(not_representable(&name, format, &other)),
        })
    })?;
    Ok(report.dropped.iter().map(ToString::to_string).collect())
}

/// The failure for a surface that the format cannot hold.
fn not_representable(name: &Path, format: Format, error: &WriteError) -> Box<Failure> {
    let (code, help) = match error {
        WriteError::IndexOutOfRange { .. } => (Code::IndexOutOfRange, "add --drop-defects".to_owned()),
        WriteError::BeyondSinglePrecision { .. } => (
            Code::WriteFailed,
            format!("-o {}   # keeps double precision", shell_word(&name.with_extension("ply"))),
        ),
        _ => (Code::WriteFailed, format!("-o {}", shell_word(&name.with_extension("ply")))),
    };
    Failure::new(code, error.to_string())
        .subject(name.display().to_string())
        .why(format!("{format} cannot hold this surface"))
        .help(help)
}
/// Standard output takes the report, so it cannot take a file too.
pub(crate) fn refuse_standard_output(output: &Path) -> Result<(), Box<Failure>> {
    if output == Path::new(STANDARD) {
        return Err(Failure::new(Code::StandardOutputTaken, "standard output takes the report already")
            .why("the report and the file would be mixed")
            .help("name a file"));
    }
    Ok(())
}
