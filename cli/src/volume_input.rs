//! Volumetric meshes read from files: [`VolumeInput`].

use crate::commands::mesh::VolumeFormat;
use crate::failure::Failure;
use crate::input::{Kind, Reading, Told, not_understood, open_file};
use crate::progress::Progress;
use std::fs::File;
use std::path::{Path, PathBuf};
use welter_meshing::io::{Limits, ReadReport, VolumeData, read_medit, read_msh, read_vtu};

/// Memory of a volumetric mesh read and drawn, in bytes a byte of its file. Measured at the peak of `render`, which takes the most: 110 MB for
/// tetrahedra in a binary VTU of 17 MB (6.5; 5.5 for hexahedra, 3.1 as text), and 2.9 for MEDIT, 2.6 for binary MSH.
fn memory_per_byte(format: VolumeFormat) -> u64 {
    match format {
        VolumeFormat::Vtu => 7,
        VolumeFormat::Msh | VolumeFormat::Mesh => 4,
    }
}

/// The format that the extension names, if it is one of volumetric meshes and no format of surfaces was asked for.
pub(crate) fn volume_format_of(name: &Path, reading: &Reading) -> Option<VolumeFormat> {
    if reading.from.is_some() {
        return None;
    }
    name.extension().and_then(|extension| VolumeFormat::of_extension(&extension.to_string_lossy()))
}

/// A file that is open and has passed every check that needs no reading.
#[derive(Debug)]
pub(crate) struct VolumeInput {
    name: PathBuf,
    pub(crate) format: VolumeFormat,
    /// Size, where it is known.
    pub(crate) bytes: Option<u64>,
    file: File,
}

impl VolumeInput {
    /// Opens `name`.
    pub(crate) fn open(name: &Path, format: VolumeFormat, reading: &Reading) -> Result<Self, Box<Failure>> {
        let (file, bytes) = open_file(name, memory_per_byte(format), reading)?;
        Ok(Self { name: name.to_owned(), format, bytes, file })
    }

    /// Reads the mesh, and says what the file held besides.
    pub(crate) fn read(self, progress: &Progress) -> Result<(VolumeData, ReadReport), Box<Failure>> {
        let reader = Told::new(self.file, progress, self.bytes.unwrap_or(0));
        let limits = Limits::default();
        let read = match self.format {
            VolumeFormat::Vtu => read_vtu(reader, &limits),
            VolumeFormat::Msh => read_msh(reader, &limits),
            VolumeFormat::Mesh => read_medit(reader, &limits),
        };
        read.map_err(|error| not_understood(&self.name, Kind::Volume(self.format), &error))
    }
}
