//! What a person or a script is told when something fails: [`Failure`].

use crate::codes::Code;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// How many places are listed before "and N more".
const LISTED: usize = 5;

/// One fault: code, what, where, why, and a command that mends it.
#[derive(Clone, Debug)]
pub(crate) struct Failure {
    pub(crate) code: Code,
    /// The file or argument at fault.
    pub(crate) subject: Option<String>,
    /// What is wrong, in one line.
    pub(crate) what: String,
    /// Ids, coordinates, file:line.
    pub(crate) places: Vec<String>,
    /// How many places there are in all; at least `places.len()`.
    pub(crate) place_count: usize,
    /// Why it matters.
    pub(crate) why: String,
    /// A command that mends it, or what to do.
    pub(crate) help: String,
}

impl Failure {
    pub(crate) fn new(code: Code, what: impl Into<String>) -> Box<Self> {
        Box::new(Self {
            code,
            subject: None,
            what: what.into(),
            places: Vec::new(),
            place_count: 0,
            why: code.why().to_owned(),
            help: "welter --help".to_owned(),
        })
    }

    pub(crate) fn subject(mut self: Box<Self>, subject: impl Into<String>) -> Box<Self> {
        self.subject = Some(subject.into());
        self
    }

    /// Adds a place; only the first few are kept, all are counted.
    pub(crate) fn place(mut self: Box<Self>, place: impl Into<String>) -> Box<Self> {
        if self.places.len() < LISTED {
            self.places.push(place.into());
        }
        self.place_count += 1;
        self
    }

    pub(crate) fn why(mut self: Box<Self>, why: impl Into<String>) -> Box<Self> {
        self.why = why.into();
        self
    }

    pub(crate) fn help(mut self: Box<Self>, help: impl Into<String>) -> Box<Self> {
        self.help = help.into();
        self
    }

    /// The value of the key `error`.
    pub(crate) fn to_json(&self) -> Value {
        json!({
            "code": self.code.id(),
            "exit": self.code.exit(),
            "file": self.subject,
            "what": self.what,
            "where": self.places,
            "where_count": self.place_count,
            "why": self.why,
            "help": self.help,
        })
    }

    /// Text for a terminal.
    pub(crate) fn to_text(&self, color: bool) -> String {
        let (red, bold, cyan, off) =
            if color { ("\x1b[1;31m", "\x1b[1m", "\x1b[36m", "\x1b[0m") } else { ("", "", "", "") };
        let mut text = format!("{red}error[{}]{off}{bold}: ", self.code.id());
        if let Some(subject) = &self.subject {
            let _ = write!(text, "{}: ", printable(subject));
        }
        let _ = writeln!(text, "{}{off}", printable(&self.what));
        for (k, place) in self.places.iter().enumerate() {
            let label = if k == 0 { "where:" } else { "      " };
            let _ = writeln!(text, "  {cyan}{label}{off} {}", printable(place));
        }
        if self.place_count > self.places.len() {
            let _ = writeln!(text, "         and {} more", self.place_count - self.places.len());
        }
        let _ = writeln!(text, "  {cyan}why:{off}   {}", printable(&self.why));
        let _ = writeln!(text, "  {cyan}help:{off}  {}", printable(&self.help));
        text
    }
}

/// Control characters of foreign text (file names, lines of a file) do not reach the terminal.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { char::REPLACEMENT_CHARACTER } else { c }).collect()
}

/// A path as text; names that are no Unicode get replacement characters.
pub(crate) fn shown(path: &std::path::Path) -> String {
    path.display().to_string()
}

/// A path as a word of a shell command that can be pasted.
pub(crate) fn shell_word(path: &std::path::Path) -> String {
    let text = path.display().to_string();
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:@%,".contains(c);
    if !text.is_empty() && text.chars().all(plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_has_what_where_why_help() {
        let failure = Failure::new(Code::NonFiniteVertex, "1 vertex has a non-finite coordinate")
            .subject("part.stl")
            .place("vertex 17 at (NaN, 0, 1)")
            .help("welter convert part.stl -o mended.stl --drop-defects");
        assert_eq!(
            failure.to_text(false),
            "error[W3012]: part.stl: 1 vertex has a non-finite coordinate\n\
             \x20 where: vertex 17 at (NaN, 0, 1)\n\
             \x20 why:   no determinant with an infinite or undefined entry has a sign, so no exact answer exists\n\
             \x20 help:  welter convert part.stl -o mended.stl --drop-defects\n"
        );
    }

    #[test]
    fn escape_sequences_of_a_file_name_stay_out_of_the_terminal() {
        let failure = Failure::new(Code::NotFound, "no such file").subject("\x1b[2J.obj");
        assert!(!failure.to_text(false).contains('\x1b'));
    }

    #[test]
    fn long_lists_are_cut_and_counted() {
        let failure = (0..9).fold(Failure::new(Code::RepeatedIndex, "x"), |f, k| f.place(format!("{k}")));
        assert_eq!(failure.places.len(), LISTED);
        assert!(failure.to_text(false).contains("and 4 more"));
    }

    #[test]
    fn shell_words_can_be_pasted() {
        assert_eq!(shell_word(std::path::Path::new("a b's.obj")), r"'a b'\''s.obj'");
        assert_eq!(shell_word(std::path::Path::new("out/a.obj")), "out/a.obj");
    }
}
