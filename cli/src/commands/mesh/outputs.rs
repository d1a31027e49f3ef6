//! Where the results of `welter mesh` go, found out before the work: [`Outputs`].

use super::options::{Args, Msh};
use super::volume_file::{VolumeFormat, VolumeWriting};
use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::output::Output;
use crate::run::Run;
use std::path::Path;
use welter_meshing::io::MshVersion;

pub(super) struct Outputs {
    pub(super) writing: VolumeWriting,
    pub(super) volume: Output,
    pub(super) hosts: Option<Output>,
    pub(super) picture: Option<Output>,
}

impl Outputs {
    pub(super) fn prepare(args: &Args, run: &Run) -> Result<Self, Box<Failure>> {
        let format = match args.to {
            Some(format) => format,
            None => VolumeFormat::of(&args.output)?,
        };
        let msh = match args.msh {
            Msh::Two => MshVersion::V2,
            Msh::Four => MshVersion::V4,
        };
        // Gmsh and MEDIT files are for solvers, which set their boundary conditions there.
        let with_boundary = args.boundary || format != VolumeFormat::Vtu;
        let named = [Some(&args.output), args.hosts.as_ref(), args.picture.as_ref()];
        let names: Vec<&Path> = named.into_iter().flatten().map(|name| name.as_path()).collect();
        for (k, name) in names.iter().enumerate() {
            if names[..k].contains(name) {
                return Err(Failure::new(Code::Usage, "two results would be written to the same file")
                    .subject(name.display().to_string())
                    .help("name a file of its own for each"));
            }
        }
        let open = |name: &Path| Output::prepare(name, run.force, &[args.input.as_path()]);
        let volume = open(&args.output)?;
        let hosts = args.hosts.as_deref().map(|name| {
            require_extension(name, "csv", "tables are written as .csv")?;
            open(name)
        });
        let picture = args.picture.as_deref().map(|name| {
            require_extension(name, "png", "pictures are written as .png")?;
            open(name)
        });
        Ok(Self {
            writing: VolumeWriting { format, msh, ascii: args.ascii, with_boundary },
            volume,
            hosts: hosts.transpose()?,
            picture: picture.transpose()?,
        })
    }
}

fn require_extension(name: &Path, extension: &str, what: &str) -> Result<(), Box<Failure>> {
    if name.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension)) {
        return Ok(());
    }
    Err(Failure::new(Code::UnknownFormat, what)
        .subject(name.display().to_string())
        .why("the format is known from the extension")
        .help(shell_word(&name.with_extension(extension))))
}
