//! File names that stand for a sequence of frames: `frame_%04d.ply` or `frame_{}.ply`.
//!
//! On the input side both find every file whose name has a number in that place; `%04d` takes four digits or more,
//! `{}` any number of digits. On the output side `%04d` pads with zeros, `{}` writes the number as the input had it.

use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::input::cannot_read;
use std::fs;
use std::path::{Path, PathBuf};

/// A file name with one place for a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern {
    folder: PathBuf,
    before: String,
    after: String,
    /// Least number of digits; `None` for `{}`.
    digits: Option<usize>,
}

/// One frame: its number, the digits as written, the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Frame {
    pub(crate) number: u64,
    pub(crate) written: String,
    pub(crate) path: PathBuf,
}

impl Pattern {
    /// The pattern in `path`, if there is one in its last component.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?;
        let folder = path.parent().map(Path::to_owned).unwrap_or_default();
        let made = |before: &str, after: &str, digits| {
            Some(Self { folder: folder.clone(), before: before.to_owned(), after: after.to_owned(), digits })
        };
        if let Some((before, after)) = name.split_once("{}") {
            return made(before, after, None);
        }
        let (before, rest) = name.split_once('%')?;
        let end = rest.find('d')?;
        let width = &rest[..end];
        let digits = match width {
            "" => 1,
            width => width.strip_prefix('0')?.parse().ok().filter(|digits| (1..=19).contains(digits))?,
        };
        made(before, &rest[end + 1..], Some(digits))
    }

    /// The existing files of the pattern by ascending number.
    pub(crate) fn frames(&self) -> Result<Vec<Frame>, Box<Failure>> {
        let folder = if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder };
        let mut frames = Vec::new();
        for entry in fs::read_dir(folder).map_err(|error| cannot_read(folder, &error))? {
            let entry = entry.map_err(|error| cannot_read(folder, &error))?;
            let Ok(name) = entry.file_name().into_string() else { continue };
            if let Some((number, written)) = self.number_in(&name) {
                frames.push(Frame { number, written, path: self.folder.join(&name) });
            }
        }
        frames.sort_by(|a, b| (a.number, &a.path).cmp(&(b.number, &b.path)));
        if let Some([a, b]) = twice(&frames) {
            return Err(Failure::new(Code::SequenceMismatch, "two files have the same frame number")
                .subject(self.shown())
                .place(a.path.display().to_string())
                .place(b.path.display().to_string())
                .why("one frame cannot be two files")
                .help("name the number of digits: frame_%04d.ply"));
        }
        if frames.is_empty() {
            return Err(Failure::new(Code::EmptySequence, "no file matches this pattern")
                .subject(self.shown())
                .help(format!("ls {}", shell_word(folder))));
        }
        Ok(frames)
    }

    fn number_in(&self, name: &str) -> Option<(u64, String)> {
        let written = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?;
        let all_digits = !written.is_empty() && written.bytes().all(|byte| byte.is_ascii_digit());
        // `%04d` writes 12345 with five digits and never 00012.
        let fits = self.digits.is_none_or(|digits| {
            written.len() == digits || (written.len() > digits && !written.starts_with('0'))
        });
        if all_digits && fits { Some((written.parse().ok()?, written.to_owned())) } else { None }
    }

    /// The file of a frame.
    pub(crate) fn path_of(&self, frame: &Frame) -> PathBuf {
        let Self { before, after, .. } = self;
        self.folder.join(match self.digits {
            Some(digits) => format!("{before}{:0digits$}{after}", frame.number),
            None => format!("{before}{}{after}", frame.written),
        })
    }

    fn shown(&self) -> String {
        let number = self.digits.map_or("{}".to_owned(), |digits| format!("%0{digits}d"));
        self.folder.join(format!("{}{number}{}", self.before, self.after)).display().to_string()
    }
}

/// The first two neighbours with the same number.
fn twice(frames: &[Frame]) -> Option<[&Frame; 2]> {
    frames.windows(2).find(|pair| pair[0].number == pair[1].number).map(|pair| [&pair[0], &pair[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u64, written: &str) -> Frame {
        Frame { number, written: written.to_owned(), path: PathBuf::new() }
    }

    #[test]
    fn patterns_are_found() {
        let printf = Pattern::of(Path::new("run/frame_%04d.ply")).expect("a pattern");
        assert_eq!(
            (printf.before.as_str(), printf.after.as_str(), printf.digits),
            ("frame_", ".ply", Some(4))
        );
        assert_eq!(Pattern::of(Path::new("a_{}.obj")).expect("a pattern").digits, None);
        assert_eq!(Pattern::of(Path::new("a_%d.obj")).expect("a pattern").digits, Some(1));
        for plain in ["frame.ply", "100%.ply", "frame_%s.ply", "%4d.ply", "{}/frame.ply"] {
            assert_eq!(Pattern::of(Path::new(plain)), None, "{plain}");
        }
    }

    #[test]
    fn numbers_are_read_and_written_back() {
        let printf = Pattern::of(Path::new("f_%04d.ply")).expect("a pattern");
        assert_eq!(printf.number_in("f_0012.ply"), Some((12, "0012".to_owned())));
        assert_eq!(printf.number_in("f_12345.ply"), Some((12_345, "12345".to_owned())));
        for other in ["f_12.ply", "f_00012.ply", "f_.ply", "f_00a2.ply", "g_0012.ply"] {
            assert_eq!(printf.number_in(other), None, "{other}");
        }
        assert_eq!(printf.path_of(&frame(7, "7")), Path::new("f_0007.ply"));
        let braces = Pattern::of(Path::new("f_{}.ply")).expect("a pattern");
        assert_eq!(braces.path_of(&frame(7, "007")), Path::new("f_007.ply"));
        assert_eq!(braces.number_in("f_99999999999999999999.ply"), None);
    }
}
