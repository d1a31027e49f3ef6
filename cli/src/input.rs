//! Files read: found, opened and checked before the work, then read with progress.

use crate::codes::Code;
use crate::commands::mesh::VolumeFormat;
use crate::failure::{Failure, shell_word};
use crate::machine;
use crate::numbers;
use crate::output::plain;
use crate::progress::Progress;
use clap::ValueEnum;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use welter_meshing::io::{Format, Limits, Place, ReadError, ReadReport};
use welter_meshing::surface::TriangleSoup;

/// The name that stands for standard input or standard output.
pub(crate) const STANDARD: &str = "-";

/// Memory of a surface read and indexed, in bytes a byte of its file. Measured at the peak of a check of 972,846
/// triangles: 354 MiB for a PLY of 23 MiB (15; 20 in single precision), an OBJ of 49 MiB (7), an STL of 46 MiB (8).
fn memory_per_byte(format: Format) -> u64 {
    match format {
        Format::Ply => 20,
        Format::Obj | Format::Stl | Format::Off => 10,
    }
}

/// Options of every command that reads surfaces.
#[derive(clap::Args, Clone, Copy, Debug)]
pub(crate) struct Reading {
    /// Format of the input [default: by its extension]; needed for standard input
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub(crate) from: Option<FormatName>,
    /// Refuse inputs that would take more memory [default: what is free now]
    #[arg(long, value_name = "BYTES")]
    pub(crate) max_memory: Option<u64>,
}

/// A file format by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FormatName {
    Obj,
    Ply,
    Stl,
    Off,
}

impl FormatName {
    pub(crate) fn format(self) -> Format {
        match self {
            Self::Obj => Format::Obj,
            Self::Ply => Format::Ply,
            Self::Stl => Format::Stl,
            Self::Off => Format::Off,
        }
    }
}

/// The format that the extension of `path` names.
pub(crate) fn format_of(path: &Path, option: &str) -> Result<Format, Box<Failure>> {
    let extension = path.extension().map(|extension| extension.to_string_lossy().into_owned());
    let failure = |what: String| {
        Failure::new(Code::UnknownFormat, what)
            .subject(path.display().to_string())
            .help(format!("name the format: {option} obj, {option} ply, {option} stl or {option} off"))
    };
    match extension {
        None if path == Path::new(STANDARD) => Err(failure("a stream has no extension".to_owned())
            .why("the format is known from the extension, and a stream has none")),
        None => Err(failure("the name has no extension".to_owned())
            .why("the format is known from the extension, and there is none")),
        Some(extension) => Format::of_extension(&extension).ok_or_else(|| {
            if option == "--from" && VolumeFormat::of_extension(&extension).is_some() {
                return not_a_surface(path);
            }
            failure(format!("unknown extension .{extension}"))
        }),
    }
}

/// The failure for a volumetric mesh where a surface is to be read.
fn not_a_surface(path: &Path) -> Box<Failure> {
    Failure::new(
        Code::UnknownFormat,
        "the extension is that of a volumetric mesh, and a surface is to be read",
    )
    .subject(path.display().to_string())
    .why("only `welter info` and `welter render` take volumetric meshes")
    .help(format!("welter info {}   # if it holds a surface all the same: --from FORMAT", shell_word(path)))
}

/// What a file is read as.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    Surface(Format),
    Volume(VolumeFormat),
}

impl Kind {
    fn extension(self) -> &'static str {
        match self {
            Self::Surface(format) => format.extension(),
            Self::Volume(format) => format.extension(),
        }
    }
}

/// What a file holds of surfaces and of lines.
pub(crate) struct Drawn {
    pub(crate) soup: TriangleSoup,
    /// The vertices of each line, by index.
    pub(crate) lines: Vec<Vec<u32>>,
    pub(crate) held: ReadReport,
}

/// A surface file that is open and has passed every check that needs no reading.
#[derive(Debug)]
pub(crate) struct Input {
    pub(crate) name: PathBuf,
    pub(crate) format: Format,
    /// Size, where it is known.
    pub(crate) bytes: Option<u64>,
    stream: Stream,
}

#[derive(Debug)]
enum Stream {
    Standard(io::Stdin),
    File(File),
}

impl Read for Stream {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Standard(stream) => stream.read(buffer),
            Self::File(stream) => stream.read(buffer),
        }
    }
}

impl Input {
    /// Opens `name`.
    pub(crate) fn open(name: &Path, reading: &Reading) -> Result<Self, Box<Failure>> {
        let format = || match reading.from {
            Some(format) => Ok(format.format()),
            None => format_of(name, "--from"),
        };
        if name == Path::new(STANDARD) {
            let stream = Stream::Standard(io::stdin());
            return Ok(Self { name: name.to_owned(), format: format()?, bytes: None, stream });
        }
        let meta = fs::metadata(name).map_err(|error| cannot_read(name, &error))?;
        if meta.is_dir() {
            return Err(is_directory(name));
        }
        let format = format()?;
        let (file, bytes) = open_file(name, memory_per_byte(format), reading)?;
        Ok(Self { name: name.to_owned(), format, bytes, stream: Stream::File(file) })
    }

    /// Reads the surface and the lines, of which only OBJ has any, and says what the file held besides.
    pub(crate) fn read_with_lines(self, progress: &Progress) -> Result<Drawn, Box<Failure>> {
        if self.format != Format::Obj {
            let (soup, held) = self.read(progress)?;
            return Ok(Drawn { soup, lines: Vec::new(), held });
        }
        let reader = Told::new(self.stream, progress, self.bytes.unwrap_or(0));
        let read = welter_meshing::io::read_obj_with_lines(reader, &Limits::default());
        let (soup, lines, held) =
            read.map_err(|error| not_understood(&self.name, Kind::Surface(self.format), &error))?;
        Ok(Drawn { soup, lines, held })
    }

    /// Reads the surface, and says what the file held besides.
    pub(crate) fn read(self, progress: &Progress) -> Result<(TriangleSoup, ReadReport), Box<Failure>> {
        let total = self.bytes.unwrap_or(0);
        let reader = Told::new(self.stream, progress, total);
        welter_meshing::io::read_reported(self.format, reader, &Limits::default())
            .map_err(|error| not_understood(&self.name, Kind::Surface(self.format), &error))
    }
}

/// Opens a file, if it has bytes and memory suffices for so many bytes for each of them; also its size, where it is known.
pub(crate) fn open_file(
    name: &Path,
    memory_per_byte: u64,
    reading: &Reading,
) -> Result<(File, Option<u64>), Box<Failure>> {
    let meta = fs::metadata(name).map_err(|error| cannot_read(name, &error))?;
    if meta.is_dir() {
        return Err(is_directory(name));
    }
    let file = File::open(name).map_err(|error| cannot_read(name, &error))?;
    let bytes = meta.is_file().then_some(meta.len());
    if bytes == Some(0) {
        return Err(empty(name));
    }
    if let (Some(bytes), Some(free)) = (bytes, reading.max_memory.or_else(machine::available_memory)) {
        let needed = bytes.saturating_mul(memory_per_byte);
        if needed > free {
            let what = format!(
                "reading and indexing it may take {}, and {} {}",
                numbers::bytes(needed),
                numbers::bytes(free),
                if reading.max_memory.is_some() { "are allowed" } else { "are free" }
            );
            return Err(Failure::new(Code::OverMemory, what)
                .subject(name.display().to_string())
                .place(format!("file of {}", numbers::bytes(bytes)))
                .help(format!("--max-memory {needed}   # to try all the same")));
        }
    }
    Ok((file, bytes))
}

/// Tells how many bytes were read.
pub(crate) struct Told<'a, R> {
    stream: R,
    progress: &'a Progress,
    done: u64,
    told: u64,
    total: u64,
}

impl<'a, R> Told<'a, R> {
    pub(crate) fn new(stream: R, progress: &'a Progress, total: u64) -> Self {
        Self { stream, progress, done: 0, told: 0, total }
    }
}

impl<R: Read> Read for Told<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        const STEP: u64 = 1 << 20;
        let n = self.stream.read(buffer)?;
        self.done += n as u64;
        if self.done - self.told >= STEP || (n == 0 && self.done > self.told) {
            self.told = self.done;
            self.progress.report("reading", self.done, self.total);
        }
        Ok(n)
    }
}

fn is_directory(name: &Path) -> Box<Failure> {
    let mut surfaces: Vec<PathBuf> = fs::read_dir(name)
        .into_iter()
        .flatten()
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| format_of(path, "--from").is_ok())
        .collect();
    surfaces.sort();
    let help = match surfaces.first() {
        Some(first) => format!(
            "welter info {}   # or name a file in it, such as {}",
            shell_word(name),
            shell_word(first)
        ),
        None => "name a file".to_owned(),
    };
    Failure::new(Code::IsDirectory, "this is a directory, and a surface file is to be read")
        .subject(name.display().to_string())
        .help(help)
}

fn empty(name: &Path) -> Box<Failure> {
    Failure::new(Code::EmptyFile, "the file has no bytes")
        .subject(name.display().to_string())
        .help(format!("ls -l {}   # then write it again with the program it comes from", shell_word(name)))
}

/// The failure for an error of the system on opening `name`.
pub(crate) fn cannot_read(name: &Path, error: &io::Error) -> Box<Failure> {
    let subject = name.display().to_string();
    match error.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => {
            let folder = match name.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            };
            let help = match nearest_name(name, folder) {
                Some(nearest) => format!("did you mean {}?", shell_word(&nearest)),
                None => format!("ls {}", shell_word(folder)),
            };
            Failure::new(Code::NotFound, "no such file or folder").subject(subject).help(help)
        }
        ErrorKind::PermissionDenied => Failure::new(Code::PermissionDenied, "permission denied")
            .subject(subject)
            .help(format!("chmod u+r {}", shell_word(name))),
        _ => Failure::new(Code::ReadFailed, format!("cannot be read: {}", plain(error)))
            .subject(subject)
            .help(format!("ls -l {}", shell_word(name))),
    }
}

/// The file of `folder` whose name differs least from that of `name`, if by little.
fn nearest_name(name: &Path, folder: &Path) -> Option<PathBuf> {
    let wanted = name.file_name()?.to_string_lossy().into_owned();
    let mut candidates: Vec<(usize, PathBuf)> = fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter_map(|path| Some((edit_distance(&wanted, &path.file_name()?.to_string_lossy()), path)))
        .collect();
    candidates.sort();
    candidates
        .into_iter()
        .next()
        .filter(|(distance, _)| *distance <= 2 && *distance * 3 <= wanted.len())
        .map(|(_, path)| path)
}

/// Levenshtein distance in characters.
pub(crate) fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

/// The failure for a file whose content could not be read as what it should be.
pub(crate) fn not_understood(name: &Path, kind: Kind, error: &ReadError) -> Box<Failure> {
    let (word, extension) = (shell_word(name), kind.extension());
    let shown = name.display().to_string();
    let again = "write it again with the program it comes from; it may have been cut off while copying";
    let (code, help) = match error {
        ReadError::Empty { .. } => return empty(name).place("nothing but white space"),
        ReadError::Encoding { found, .. } if found.starts_with("UTF") => {
            let encoding = found.split(' ').next().unwrap_or("UTF-16");
            let stem = name.file_stem().unwrap_or_default().to_string_lossy();
            let converted = name.with_file_name(format!("{stem}-utf8.{extension}"));
            (Code::NotUtf8Text, format!("iconv -f {encoding} -t UTF-8 {word} > {}", shell_word(&converted)))
        }
        ReadError::Encoding { found, .. } if found.contains("gzip") => {
            let help = match kind {
                Kind::Surface(_) => format!("gunzip -c {word} | welter check --from {extension} -"),
                Kind::Volume(_) => format!("gunzip -c {word} > plain.{extension}"),
            };
            (Code::UnsupportedContent, help)
        }
        ReadError::Encoding { .. } => (Code::UnsupportedContent, format!("file {word}   # tells what it is")),
        ReadError::Truncated { .. } => (Code::Truncated, again.to_owned()),
        ReadError::IndexOutOfRange { .. } => {
            (Code::IndexOutOfRange, "remove the face or cell there, or write the file again".to_owned())
        }
        ReadError::Unsupported { .. } => {
            let help = match kind {
                Kind::Surface(_) => "write it as plain triangles or polygons",
                Kind::Volume(VolumeFormat::Vtu) => "write it in one piece, compressed by zlib or not at all",
                Kind::Volume(_) => "write it as MSH 2.2 or 4.1, or as MEDIT text",
            };
            (Code::UnsupportedContent, help.to_owned())
        }
        ReadError::OverLimit { .. } => (Code::OverCount, "split the file into parts".to_owned()),
        ReadError::Io { source, .. } => (
            Code::ReadFailed,
            format!("cp {word} /tmp   # to see whether the disk delivers it: {}", plain(source)),
        ),
        _ => {
            let or_name_it =
                if matches!(kind, Kind::Surface(_)) { " else name the format: --from" } else { "" };
            (Code::Malformed, format!("file {word}   # is it what its extension says?{or_name_it}"))
        }
    };
    let what = match error.place() {
        Some(at) => {
            let text = error.to_string();
            text.strip_prefix(&format!("{at}: ")).unwrap_or(&text).to_owned()
        }
        None => error.to_string(),
    };
    let failure = Failure::new(code, what).subject(&shown).help(help);
    match error.place() {
        Some(Place::Line(line)) => failure.place(format!("{shown}:{line}")),
        Some(at) => failure.place(format!("{shown}, {at}")),
        None => failure,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disk_that_does_not_deliver_is_told_with_the_byte() {
        let error = ReadError::Io { offset: 512, source: ErrorKind::TimedOut.into() };
        let failure = not_understood(Path::new("a.ply"), Kind::Surface(Format::Ply), &error);
        assert_eq!((failure.code, failure.places[0].as_str()), (Code::ReadFailed, "a.ply, byte 512"));
        let code = |kind: ErrorKind| cannot_read(Path::new("a.ply"), &kind.into()).code;
        assert_eq!(code(ErrorKind::TimedOut), Code::ReadFailed);
        assert_eq!(code(ErrorKind::PermissionDenied), Code::PermissionDenied);
    }

    #[test]
    fn more_elements_than_ids_are_told_with_the_line() {
        let limits = Limits { max_vertices: 1, ..Limits::default() };
        let text = &b"v 0 0 0\nv 1 0 0\n"[..];
        let error = welter_meshing::io::read(Format::Obj, text, &limits).expect_err("one is allowed");
        let failure = not_understood(Path::new("a.obj"), Kind::Surface(Format::Obj), &error);
        assert_eq!((failure.code, failure.places[0].as_str()), (Code::OverCount, "a.obj:2"));
    }

    #[test]
    fn edit_distances() {
        assert_eq!(edit_distance("spot.obj", "spot.obj"), 0);
        assert_eq!(edit_distance("spto.obj", "spot.obj"), 2);
        assert_eq!(edit_distance("", "abc"), 3);
        assert_eq!(edit_distance("bunny", "bunnies"), 3);
    }
}
