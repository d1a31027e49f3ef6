//! Whether a file holds edge-edge or vertex-face queries: [`Kind`].

use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use clap::ValueEnum;
use std::path::Path;

/// What moves against what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    EdgeEdge,
    VertexFace,
}

impl Kind {
    pub(super) const ALL: [Self; 2] = [Self::EdgeEdge, Self::VertexFace];

    /// For people.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::EdgeEdge => "edge-edge",
            Self::VertexFace => "vertex-face",
        }
    }

    /// In JSON, where it is a key too.
    pub(super) fn key(self) -> &'static str {
        match self {
            Self::EdgeEdge => "edge_edge",
            Self::VertexFace => "vertex_face",
        }
    }
}

/// The kind as asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum KindOption {
    EdgeEdge,
    VertexFace,
    // From the name of the file or of its folders.
    Auto,
}

impl KindOption {
    /// The kind of the queries in the file `name`.
    pub(super) fn of(self, name: &Path) -> Result<Kind, Box<Failure>> {
        match self {
            Self::EdgeEdge => Ok(Kind::EdgeEdge),
            Self::VertexFace => Ok(Kind::VertexFace),
            Self::Auto => told_by(name).ok_or_else(|| {
                Failure::new(Code::UnknownQueryKind, "edge-edge or vertex-face queries?")
                    .subject(name.display().to_string())
                    .why(
                        "the rows of both look the same; the kind is known from `edge-edge`, `vertex-face`, `ee` or \
                         `vf` in the name of the file or of its folder, and here it is not",
                    )
                    .help(format!(
                        "welter ccd {0} --kind edge-edge   # or: --kind vertex-face",
                        shell_word(name)
                    ))
            }),
        }
    }
}

/// Names that may tell the kind: that of the file and those of two folders around it, as benchmarks nest them.
const NAMES_LOOKED_AT: usize = 3;

/// The kind that the nearest name with exactly one kind in it tells.
fn told_by(path: &Path) -> Option<Kind> {
    let full = std::path::absolute(path).ok()?;
    let mut names = full.iter().rev().take(NAMES_LOOKED_AT).map(|name| name.to_string_lossy());
    let told = names.find_map(|name| {
        let named: Vec<Kind> = Kind::ALL.into_iter().filter(|&kind| names_kind(&name, kind)).collect();
        (!named.is_empty()).then_some(named)
    })?;
    match told[..] {
        [kind] => Some(kind),
        _ => None,
    }
}

/// Whether the words of `name` have the two words of the kind in sequence, in one, or as initials.
fn names_kind(name: &str, kind: Kind) -> bool {
    let name = name.to_ascii_lowercase();
    let words: Vec<&str> = name.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty()).collect();
    let (first, second, initials) = match kind {
        Kind::EdgeEdge => ("edge", "edge", "ee"),
        Kind::VertexFace => ("vertex", "face", "vf"),
    };
    words.iter().any(|&word| word == initials || word == format!("{first}{second}"))
        || words.windows(2).any(|pair| pair == [first, second])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_the_kind() {
        for (path, kind) in [
            ("set/edge-edge/data_0_0.csv", Some(Kind::EdgeEdge)),
            ("set/vertex-face/data_0_0.csv", Some(Kind::VertexFace)),
            ("set/Vertex_Face/part/data.csv", Some(Kind::VertexFace)),
            ("data-ee-7.csv", Some(Kind::EdgeEdge)),
            ("vf01.csv", Some(Kind::VertexFace)),
            ("EdgeEdge.csv", Some(Kind::EdgeEdge)),
            // The nearest name wins.
            ("edge-edge/vf.csv", Some(Kind::VertexFace)),
            ("ee-and-vf.csv", None),
            ("set/data.csv", None),
            ("trees/beef.csv", None),
            ("edge/edge.csv", None),
            ("edge-edge/a/b/data.csv", None),
        ] {
            assert_eq!(told_by(&Path::new("/").join(path)), kind, "{path}");
        }
    }
}
