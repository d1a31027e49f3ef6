//! Volumetric meshes on their way to a file.

use super::product::{Boundary, Product, TAGS};
use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::input::STANDARD;
use crate::output::{Output, WriteProblem};
use clap::ValueEnum;
use std::path::Path;
use welter_meshing::io::{
    Encoding, MeditOptions, MshOptions, MshVersion, VolumeView, VtkEncoding, WriteError, write_medit,
    write_msh, write_vtu,
};

/// A format for volumetric meshes, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum VolumeFormat {
    // VTK unstructured grid.
    Vtu,
    // Gmsh.
    Msh,
    // MEDIT.
    Mesh,
}

impl VolumeFormat {
    /// The format that the extension of a name says.
    pub(super) fn of(name: &Path) -> Result<Self, Box<Failure>> {
        let extension = name.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        if let Some(format) = extension.as_deref().and_then(Self::of_extension) {
            return Ok(format);
        }
        let what = match extension {
            None if name == Path::new(STANDARD) => "a stream has no extension".to_owned(),
            None => "the name has no extension".to_owned(),
            Some(extension) => format!("volumetric meshes are not written as .{extension}"),
        };
        let help = if name == Path::new(STANDARD) {
            "name the format: --to vtu, --to msh or --to mesh".to_owned()
        } else {
            format!("-o {}   # or .msh (Gmsh) or .mesh (MEDIT)", shell_word(&name.with_extension("vtu")))
        };
        Err(Failure::new(Code::UnknownFormat, what)
            .subject(name.display().to_string())
            .why("the format is known from the extension: vtu, msh or mesh")
            .help(help))
    }

    /// The format that an extension stands for, in any case.
    pub(crate) fn of_extension(extension: &str) -> Option<Self> {
        let known = |format: &Self| format.extension().eq_ignore_ascii_case(extension);
        Self::value_variants().iter().copied().find(known)
    }

    /// Its name for people.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Vtu => "VTU",
            Self::Msh => "MSH",
            Self::Mesh => "MEDIT",
        }
    }

    pub(crate) fn extension(self) -> &'static str {
        match self {
            Self::Vtu => "vtu",
            Self::Msh => "msh",
            Self::Mesh => "mesh",
        }
    }
}

/// How a volumetric mesh is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct VolumeWriting {
    pub(super) format: VolumeFormat,
    pub(super) msh: MshVersion,
    pub(super) ascii: bool,
    /// Whether the faces of the boundary are written too.
    pub(super) with_boundary: bool,
}

impl VolumeWriting {
    /// Writes the mesh; returns what the format could not hold, in words.
    pub(super) fn write(
        &self,
        output: Output,
        product: &Product,
        boundary: &Boundary,
    ) -> Result<Vec<String>, Box<Failure>> {
        let fields = product.fields(boundary);
        let position = |vertex: usize| product.position(vertex);
        let (hexahedra, tetrahedra) = match &product.tetrahedra {
            Some(tetrahedra) => (&[][..], &tetrahedra.mesh().tetrahedra[..]),
            None => (product.volume.mesh.hexahedra(), &[][..]),
        };
        let view = VolumeView {
            hexahedra,
            tetrahedra,
            quadrilaterals: &boundary.quadrilaterals,
            triangles: &boundary.triangles,
            cell_fields: &fields,
            groups: &boundary.names,
            ..VolumeView::new(product.vertex_count(), &position)
        };
        self.write_view(output, &view, (!boundary.tags.is_empty()).then_some(TAGS))
    }

    /// Writes cells, tagged by a field; returns what the format could not hold, in words.
    pub(super) fn write_view(
        &self,
        output: Output,
        view: &VolumeView<'_>,
        tags: Option<&str>,
    ) -> Result<Vec<String>, Box<Failure>> {
        let name = output.name().to_owned();
        let report = output.write(|file| {
            let written = match self.format {
                VolumeFormat::Vtu => {
                    let encoding = if self.ascii { VtkEncoding::Ascii } else { VtkEncoding::Appended };
                    write_vtu(file, view, encoding)
                }
                VolumeFormat::Msh => {
                    let encoding = if self.ascii { Encoding::Ascii } else { Encoding::Binary };
                    write_msh(file, view, &MshOptions { version: self.msh, encoding, tags })
                }
                VolumeFormat::Mesh => write_medit(
                    file,
                    view,
                    &MeditOptions { cell_references: tags, ..MeditOptions::default() },
                ),
            };
            written.map_err(|error| match error {
                WriteError::Io(error) => WriteProblem::Io(error),
                other => WriteProblem::Failure(not_representable(&name, &other)),
            })
        })?;
        Ok(report.dropped.iter().map(ToString::to_string).collect())
    }
}

/// The failure for a mesh that the format cannot hold.
fn not_representable(name: &Path, error: &WriteError) -> Box<Failure> {
    Failure::new(Code::WriteFailed, error.to_string())
        .subject(name.display().to_string())
        .why("the format cannot hold this mesh")
        .help(format!("-o {}", shell_word(&name.with_extension("vtu"))))
}
