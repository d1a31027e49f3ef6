//! The one table of error codes.
//!
//! The first digit of a code is the exit code of the command (`W0130`, interrupted, stands for 130). A code keeps
//! its number and meaning for good; a new fault takes a new number.

/// One row: variant, identifier, exit code, title, why it matters.
macro_rules! codes {
    ($($variant:ident = $id:literal, $exit:literal, $title:literal, $why:literal;)*) => {
        /// What went wrong, as a stable code.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Code { $(#[doc = $title] $variant),* }

        impl Code {
            /// Every code, ascending.
            pub(crate) const ALL: &[Self] = &[$(Self::$variant),*];

            /// `W####`.
            pub(crate) fn id(self) -> &'static str {
                match self { $(Self::$variant => $id),* }
            }

            /// The exit code of the process.
            pub(crate) fn exit(self) -> u8 {
                match self { $(Self::$variant => $exit),* }
            }

            /// A few words for a list of codes.
            pub(crate) fn title(self) -> &'static str {
                match self { $(Self::$variant => $title),* }
            }

            /// Why it matters, where the failure itself has no better sentence.
            pub(crate) fn why(self) -> &'static str {
                match self { $(Self::$variant => $why),* }
            }
        }
    };
}

codes! {
    Interrupted = "W0130", 130, "interrupted",
        "the work was stopped before its result was whole; no half-written file is left";

    OwnBug = "W1001", 1, "a bug of this program",
        "a rule that the program itself must keep was broken; no result of this run may be trusted";
    SelfTest = "W1002", 1, "self-test failed",
        "an answer known beforehand came out differently, so other answers of this build cannot be trusted";

    Usage = "W2001", 2, "command line not understood",
        "nothing was done, because what was asked for is not clear";
    UnknownShape = "W2002", 2, "no such built-in surface",
        "only the surfaces of `welter shape --list` are built in";
    SizeOutOfRange = "W2003", 2, "size out of range",
        "a size must be a positive finite length that the surface can be built with";
    SequenceMismatch = "W2004", 2, "a sequence on one side only",
        "a pattern names many files and a plain name names one";
    OutputIsInput = "W2005", 2, "output and input are the same file",
        "the original would be lost";
    StandardOutputTaken = "W2006", 2, "standard output is asked for twice",
        "with --json standard output holds exactly one JSON object";
    UnknownQueryKind = "W2007", 2, "kind of the queries unknown",
        "the rows of an edge-edge query and of a vertex-face query look the same";
    TextNotDrawn = "W2008", 2, "text that cannot be drawn",
        "a surface needs at least one visible character, and time and memory for the last";
    NoSuchCells = "W2009", 2, "no cells of this size",
        "the nodes of a grid must have exact coordinates that can be numbered";
    UnknownScene = "W2010", 2, "no such scene",
        "only the scenes of `welter new --list` come with the program";

    IndexOutOfRange = "W3010", 3, "vertex index out of range",
        "a corner that does not exist has no position";
    RepeatedIndex = "W3011", 3, "triangle with a repeated vertex",
        "such a triangle has no area and makes edges that no closed surface can have";
    NonFiniteVertex = "W3012", 3, "non-finite coordinate",
        "no determinant with an infinite or undefined entry has a sign, so no exact answer exists";
    NoTriangles = "W3013", 3, "no triangles",
        "a surface without triangles has nothing to look at";
    NotClosed = "W3021", 3, "not closed", "a surface with a boundary bounds no volume";
    NotOriented = "W3022", 3, "not consistently oriented",
        "neighbouring triangles disagree on which side is inside";
    NotManifold = "W3023", 3, "not manifold",
        "an edge with more than two triangles or a vertex with more than one fan has no single inside";
    SelfIntersecting = "W3024", 3, "self-intersecting",
        "methods that take an embedded surface give wrong answers where it passes through itself";
    InsideOut = "W3025", 3, "inside out",
        "no volume has a boundary that winds around it the wrong way";
    NoArea = "W3026", 3, "curves that bound no area",
        "the turning numbers of curves that bound an area add up to its Euler characteristic, at most their number";
    NotPlanar = "W3027", 3, "curves not in a plane",
        "only curves in a plane of constant z have an inside";

    NotFound = "W4001", 4, "no such file or folder", "there is nothing to read";
    UnknownFormat = "W4002", 4, "unknown file format",
        "the format is known from the extension, and this one is not among obj, ply, stl, off";
    IsDirectory = "W4003", 4, "a directory where a file is needed", "a directory holds no surface of its own";
    PermissionDenied = "W4004", 4, "not readable", "the system does not let this user read it";
    EmptyFile = "W4005", 4, "empty file", "there is nothing in it";
    Malformed = "W4006", 4, "malformed file",
        "what the file means at this place is not defined by its format, and guessing would make up geometry";
    Truncated = "W4007", 4, "file ends too early", "a part of the surface is missing";
    NotUtf8Text = "W4008", 4, "text in another encoding",
        "text formats are read as ASCII or UTF-8; in UTF-16 every second byte would be taken for a character";
    ReadFailed = "W4009", 4, "reading failed", "the system could not deliver the bytes";
    UnsupportedContent = "W4010", 4, "unsupported content",
        "the file is well formed but holds something that this version does not read";
    EmptySequence = "W4011", 4, "no file matches the pattern", "there is nothing to read";
    NotRepresentable = "W4012", 4, "coordinate that is no f64",
        "with a rounded coordinate the query is another one, whose answer may differ";
    NoRunFile = "W4013", 4, "no file of a run", "only what a run has written whole can be gone on from";

    SceneSyntax = "W5001", 5, "scene not understood", "a scene is read whole or not at all";
    UnknownKey = "W5002", 5, "unknown key in a scene",
        "a key that is passed over would silently not do what it was written for";
    MissingKey = "W5003", 5, "key missing in a scene", "there is no value that would be right for every scene";
    BadValue = "W5004", 5, "value out of range in a scene", "no surface or motion has such a parameter";
    NoBounds = "W5005", 5, "no bounds known", "a field can only be sampled within a box";
    GridRefused = "W5006", 5, "no such grid", "the nodes of a grid must have exact coordinates that can be numbered";
    UndefinedField = "W5007", 5, "field not a number", "a point where the field is no number is neither inside nor outside";
    EmptySurface = "W5008", 5, "no surface within the grid",
        "a surface passes only where the field is below the level at one node and not at its neighbour";
    SceneDiffers = "W5009", 5, "scene differs from that of the run",
        "the result would be neither that of one scene nor that of the other";

    OverMemory = "W6001", 6, "would pass the memory limit",
        "going on would end in swapping or in the system killing the process";
    OverCount = "W6002", 6, "more elements than can be numbered", "vertices and triangles are numbered with 32 bits";
    TooManySheets = "W6003", 6, "too many sheets over one another",
        "which of them belong together is found by trying, and there are too many ways to try";
    OverCells = "W6004", 6, "more cells than allowed",
        "time and memory grow with the number of cells";
    PageTooLong = "W6005", 6, "page too long", "browsers do not open such pages";

    FolderMissing = "W7001", 7, "output folder missing", "the result could not be written after the work";
    NotWritable = "W7002", 7, "output not writable", "the result could not be written after the work";
    OutputExists = "W7003", 7, "output exists", "what is there now would be lost";
    WriteFailed = "W7004", 7, "writing failed", "the result is not whole; the unfinished file was removed";
    OutputIsDirectory = "W7005", 7, "output is a directory", "a file cannot take the place of a directory";
    RunLocked = "W7006", 7, "run in use", "two processes that write one run would spoil it";
    NotARun = "W7007", 7, "folder of something else", "what is in it now could be lost among the files of a run";

    UnderResolved = "W8001", 8, "features too fine for the cells",
        "where cells are larger than the distance between sheets, these cannot be told apart";
    TimeLimit = "W8002", 8, "time limit reached",
        "what was not done by then is missing from the result";
    StepFailed = "W8003", 8, "step not completed", "what comes after it cannot be computed; all before it is kept";

    FalseAnswers = "W9001", 9, "answers differ from the known ones",
        "an answer that differs from the known one is wrong, or the known one is";
    NoKnownAnswers = "W9002", 9, "no known answers",
        "an answer without a known one to compare with may be right or wrong";
    MeshNotVerified = "W9003", 9, "mesh not verified",
        "a mesh that does not fit its surface is a bug, or the surface is beyond what the method can do";
}

#[cfg(test)]
mod tests {
    use super::Code;

    #[test]
    fn first_digit_is_the_exit_code() {
        for &code in Code::ALL {
            let digits = code.id().strip_prefix('W').expect("codes start with W");
            assert_eq!(digits.len(), 4, "{}", code.id());
            let number: u32 = digits.parse().expect("four digits");
            let exit = if number < 1000 { number } else { number / 1000 };
            assert_eq!(exit, u32::from(code.exit()), "{}", code.id());
        }
    }

    #[test]
    fn codes_are_ascending_and_unique() {
        assert!(Code::ALL.is_sorted_by(|a, b| a.id() < b.id()));
    }

    #[test]
    fn titles_and_reasons_are_sentences_without_a_stop() {
        for &code in Code::ALL {
            for text in [code.title(), code.why()] {
                assert!(!text.is_empty() && !text.ends_with('.'), "{}: {text}", code.id());
            }
        }
    }
}
