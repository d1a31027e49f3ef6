//! Tests of volumetric meshes in files: round trips bit for bit, malformed input with its place, truncation at every byte, changed bytes,
//! and what other programs read of files written here.

mod accepted;
mod compressed;
mod consumers;
mod malformed;
mod round_trips;

use welter_meshing::io::{
    Encoding, Limits, MeditOptions, MshOptions, MshVersion, ReadError, ReadReport, VolumeData, VtkEncoding,
    WriteError, WriteReport, read_medit, read_msh, read_vtu, write_medit, write_msh, write_vtu,
};

/// A format in one of its forms.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Vtu(VtkEncoding),
    Msh(MshVersion, Encoding),
    Medit,
}

const FORMS: [Form; 8] = [
    Form::Vtu(VtkEncoding::Appended),
    Form::Vtu(VtkEncoding::Base64),
    Form::Vtu(VtkEncoding::Ascii),
    Form::Msh(MshVersion::V2, Encoding::Ascii),
    Form::Msh(MshVersion::V2, Encoding::Binary),
    Form::Msh(MshVersion::V4, Encoding::Ascii),
    Form::Msh(MshVersion::V4, Encoding::Binary),
    Form::Medit,
];

impl Form {
    /// The file of a mesh, with a field on cells as tags where the form has any.
    fn write(self, mesh: &VolumeData, tags: Option<&str>) -> Result<(Vec<u8>, WriteReport), WriteError> {
        let mut file = Vec::new();
        let report = mesh.with_view(|view| match self {
            Self::Vtu(encoding) => write_vtu(&mut file, view, encoding),
            Self::Msh(version, encoding) => {
                write_msh(&mut file, view, &MshOptions { version, encoding, tags })
            }
            Self::Medit => {
                write_medit(&mut file, view, &MeditOptions { cell_references: tags, vertex_references: None })
            }
        })?;
        Ok((file, report))
    }

    fn read(self, file: &[u8]) -> Result<(VolumeData, ReadReport), ReadError> {
        match self {
            Self::Vtu(_) => read_vtu(file, &Limits::default()),
            Self::Msh(..) => read_msh(file, &Limits::default()),
            Self::Medit => read_medit(file, &Limits::default()),
        }
    }

    /// A file name that tells the form.
    fn name(self) -> String {
        let extension = match self {
            Self::Vtu(_) => "vtu",
            Self::Msh(..) => "msh",
            Self::Medit => "mesh",
        };
        let words: String = format!("{self:?}").chars().filter(char::is_ascii_alphanumeric).collect();
        format!("{words}.{extension}")
    }
}

/// All of a mesh as text that tells numbers apart where their bits differ, but for NaN.
fn text(mesh: &VolumeData) -> String {
    format!("{mesh:?}")
}
