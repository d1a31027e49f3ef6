//! Reads OBJ.
//!
//! `o` and `g` both begin a group that lasts until the next of either; one without a name ends it. A line may go on after
//! `\`. Faces may name vertices that come later (positive indices only). Statements on looks, lines, points and free-form
//! curves are passed over unread and counted; a keyword that OBJ does not have is an error. A vertex may carry a weight of
//! 1 or a colour; another weight has no meaning common to programs and is refused. Lines are read where they are asked for, in
//! place of faces.

use super::super::builder::Builder;
use super::super::error::{Place, ReadError};
use super::super::source::{MAX_LINE, Source};
use super::super::tokens::{self, Tokens};
use super::super::{Limits, PolylineData, ReadReport};
use crate::surface::TriangleSoup;
use glam::DVec3;
use std::io::Read;

/// Statements that hold no part of a polygonal surface, with the words used in the report.
const PASSED_OVER: [(&str, &str); 35] = [
    ("vn", "`vn` statements"),
    ("vt", "`vt` statements"),
    ("vp", "`vp` statements"),
    ("s", "`s` statements"),
    ("usemtl", "`usemtl` statements"),
    ("mtllib", "`mtllib` statements"),
    ("l", "`l` statements"),
    ("p", "`p` statements"),
    ("mg", "`mg` statements"),
    ("usemap", "`usemap` statements"),
    ("maplib", "`maplib` statements"),
    ("bevel", "`bevel` statements"),
    ("c_interp", "`c_interp` statements"),
    ("d_interp", "`d_interp` statements"),
    ("lod", "`lod` statements"),
    ("shadow_obj", "`shadow_obj` statements"),
    ("trace_obj", "`trace_obj` statements"),
    ("cstype", "`cstype` statements"),
    ("deg", "`deg` statements"),
    ("bmat", "`bmat` statements"),
    ("step", "`step` statements"),
    ("curv", "`curv` statements"),
    ("curv2", "`curv2` statements"),
    ("surf", "`surf` statements"),
    ("parm", "`parm` statements"),
    ("trim", "`trim` statements"),
    ("hole", "`hole` statements"),
    ("scrv", "`scrv` statements"),
    ("sp", "`sp` statements"),
    ("end", "`end` statements"),
    ("con", "`con` statements"),
    ("ctech", "`ctech` statements"),
    ("stech", "`stech` statements"),
    ("call", "`call` statements"),
    ("csh", "`csh` statements"),
];

/// The reader's state beside the soup.
struct Reader {
    builder: Builder,
    corners: Vec<u32>,
    /// Lines, if these are wanted.
    lines: Option<Vec<Vec<u32>>>,
    /// Whether faces are wanted.
    faces: bool,
    /// The largest index that named a vertex not yet read, and the line where it first stood.
    ahead: Option<(i64, Place)>,
}

pub(in super::super) fn read(
    input: impl Read,
    limits: &Limits,
) -> Result<(TriangleSoup, ReadReport), ReadError> {
    Ok(read_statements(input, limits, None, true)?.builder.finish())
}

/// Reads faces and lines.
pub(in super::super) fn read_with_lines(
    input: impl Read,
    limits: &Limits,
) -> Result<(TriangleSoup, Vec<Vec<u32>>, ReadReport), ReadError> {
    let Reader { builder, lines, .. } = read_statements(input, limits, Some(Vec::new()), true)?;
    let (soup, report) = builder.finish();
    Ok((soup, lines.unwrap_or_default(), report))
}

/// Reads lines in place of faces.
pub(in super::super) fn read_polylines(
    input: impl Read,
    limits: &Limits,
) -> Result<(PolylineData, ReadReport), ReadError> {
    let Reader { builder, lines, .. } = read_statements(input, limits, Some(Vec::new()), false)?;
    let (soup, report) = builder.finish();
    Ok((PolylineData { positions: soup.positions, lines: lines.unwrap_or_default() }, report))
}

fn read_statements(
    input: impl Read,
    limits: &Limits,
    lines: Option<Vec<Vec<u32>>>,
    faces: bool,
) -> Result<Reader, ReadError> {
    let mut source = Source::new(input);
    source.begin_text("OBJ text")?;
    let mut reader = Reader { builder: Builder::new(limits), corners: Vec::new(), lines, faces, ahead: None };
    let mut joined = Vec::new();
    let mut filled = false;
    loop {
        let at = source.next_line_place();
        let Some(line) = source.next_line()? else { break };
        filled |= !line.trim_ascii().is_empty();
        if line.trim_ascii_end().last() != Some(&b'\\') {
            reader.statement(line, at)?;
            continue;
        }
        joined.clear();
        join(&mut joined, line);
        while let Some(line) = source.next_line()? {
            let goes_on = line.trim_ascii_end().last() == Some(&b'\\');
            join(&mut joined, line);
            if !goes_on {
                break;
            }
            if joined.len() > MAX_LINE {
                return Err(ReadError::LineTooLong { at, limit: MAX_LINE });
            }
        }
        reader.statement(&joined, at)?;
    }
    if !filled {
        return Err(ReadError::Empty { expected: "OBJ text".to_owned() });
    }
    if let Some((index, at)) = reader.ahead {
        let vertices = reader.builder.vertices();
        if index as u64 > vertices {
            return Err(ReadError::IndexOutOfRange { at, index, vertices, base: 1, declared: false });
        }
    }
    Ok(reader)
}

/// Appends a line without the `\` at its end.
fn join(joined: &mut Vec<u8>, line: &[u8]) {
    let line = line.trim_ascii_end();
    joined.extend_from_slice(line.strip_suffix(b"\\").unwrap_or(line));
    joined.push(b' ');
}

impl Reader {
    #[inline]
    fn statement(&mut self, line: &[u8], at: Place) -> Result<(), ReadError> {
        let mut tokens = Tokens::new(line);
        match tokens.next() {
            None => Ok(()),
            Some(b"v") => self.vertex(tokens, at),
            Some(b"l") if self.lines.is_some() => self.line(tokens, at),
            Some(b"f") if !self.faces => {
                self.builder.ignore("`f` statements", at);
                Ok(())
            }
            Some(b"f") => self.face(tokens, at),
            Some(b"g" | b"o") => {
                self.builder.begin_group(tokens::name(tokens.rest()));
                Ok(())
            }
            Some(word) if word[0] == b'#' => Ok(()),
            Some(word) => match PASSED_OVER.iter().find(|(keyword, _)| keyword.as_bytes() == word) {
                Some((_, what)) => {
                    self.builder.ignore(*what, at);
                    Ok(())
                }
                None => Err(ReadError::unexpected(at, "an OBJ statement such as `v`, `f` or `g`", word)),
            },
        }
    }

    #[inline]
    fn vertex(&mut self, mut tokens: Tokens<'_>, at: Place) -> Result<(), ReadError> {
        let number = self.builder.vertices() + 1;
        let mut coordinate = |name: char| -> Result<f64, ReadError> {
            let token = tokens.next().unwrap_or_default();
            tokens::float(token).ok_or_else(|| {
                ReadError::unexpected(at, format!("the {name} coordinate of vertex {number}"), token)
            })
        };
        let position = DVec3::new(coordinate('x')?, coordinate('y')?, coordinate('z')?);
        self.builder.vertex(position, at)?;
        let rest = tokens.rest();
        if rest.is_empty() { Ok(()) } else { self.vertex_extras(rest, at) }
    }

    /// What follows x y z: a weight of 1, or a colour of three or four numbers.
    #[cold]
    fn vertex_extras(&mut self, rest: &[u8], at: Place) -> Result<(), ReadError> {
        let mut count = 0;
        let mut last = f64::NAN;
        for token in Tokens::new(rest).take_while(|token| token[0] != b'#') {
            count += 1;
            last = tokens::float(token).ok_or_else(|| ReadError::unexpected(at, "a number", token))?;
        }
        match count {
            0 => Ok(()),
            1 if last == 1.0 => Ok(()),
            1 => Err(ReadError::Unsupported { at, what: format!("a vertex weight other than 1 ({last})") }),
            3 | 4 => {
                self.builder.ignore("vertex colours", at);
                Ok(())
            }
            _ => Err(ReadError::Unexpected {
                at,
                expected: "a vertex of 3, 4 (weight), 6 or 7 (colour) numbers".to_owned(),
                found: format!("{} numbers", 3 + count),
            }),
        }
    }

    #[inline]
    fn face(&mut self, tokens: Tokens<'_>, at: Place) -> Result<(), ReadError> {
        self.take_corners(tokens, "a face", 3, at)?;
        self.builder.polygon(&self.corners, at)
    }

    fn line(&mut self, tokens: Tokens<'_>, at: Place) -> Result<(), ReadError> {
        self.take_corners(tokens, "a line", 2, at)?;
        let corners = self.corners.clone();
        self.lines.get_or_insert_default().push(corners);
        Ok(())
    }

    /// The vertices of a statement, of which there must be some.
    #[inline]
    fn take_corners(
        &mut self,
        tokens: Tokens<'_>,
        what: &str,
        least: usize,
        at: Place,
    ) -> Result<(), ReadError> {
        self.corners.clear();
        for token in tokens {
            if token[0] == b'#' {
                break;
            }
            let index = self.corner(token, at)?;
            self.corners.push(index);
        }
        if self.corners.len() >= least {
            return Ok(());
        }
        Err(ReadError::Unexpected {
            at,
            expected: format!("{what} of at least {least} vertices"),
            found: self.corners.len().to_string(),
        })
    }

    /// The vertex of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0.
    #[inline]
    fn corner(&mut self, token: &[u8], at: Place) -> Result<u32, ReadError> {
        let wrong = || ReadError::unexpected(at, "a vertex index (v, v/vt, v//vn or v/vt/vn)", token);
        let mut parts = token.split(|&b| b == b'/');
        let index = parts.next().and_then(tokens::integer).ok_or_else(wrong)?;
        let mut count = 1;
        for part in parts {
            count += 1;
            if count > 3 || !(part.is_empty() || tokens::integer(part).is_some()) {
                return Err(wrong());
            }
        }
        let vertices = self.builder.vertices();
        if index > 0 {
            if index as u64 > vertices {
                if index > i64::from(u32::MAX) {
                    return Err(ReadError::IndexOutOfRange { at, index, vertices, base: 1, declared: false });
                }
                if self.ahead.is_none_or(|(largest, _)| largest < index) {
                    self.ahead = Some((index, at));
                }
            }
            Ok((index - 1) as u32)
        } else if index < 0 && index.unsigned_abs() <= vertices {
            Ok((vertices - index.unsigned_abs()) as u32)
        } else {
            Err(ReadError::IndexOutOfRange { at, index, vertices, base: 1, declared: false })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(file: &str) -> Result<TriangleSoup, ReadError> {
        read(file.as_bytes(), &Limits::default()).map(|(soup, _)| soup)
    }

    #[test]
    fn a_line_goes_on_after_a_backslash_and_keeps_its_number() {
        let soup = text("v 0 0 \\\n 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 \\\n3\n").unwrap();
        assert_eq!(soup.triangles, [[0, 1, 2]]);
        let error = text("v 0 0 \\\n 0\nv 1 0 0\nv 0 1 x\n").unwrap_err();
        assert_eq!(error.place(), Some(Place::Line(4)));
    }

    #[test]
    fn faces_may_come_before_their_vertices() {
        assert_eq!(text("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").unwrap().triangles, [[0, 1, 2]]);
        let error = text("f 1 2 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").unwrap_err();
        assert_eq!(
            error.to_string(),
            "line 1: vertex index 4 is out of range, the file has 3 vertices and counts from 1"
        );
    }

    #[test]
    fn lines_are_read_in_place_of_faces() {
        let file = "v 0 0 0\nl 1 2 3\nv 1 0 0\nv 0 1 0\nl 3/1 -3/2 # home\nf 1 2 3\np 1\n";
        let (found, report) = read_polylines(file.as_bytes(), &Limits::default()).unwrap();
        assert_eq!((found.positions.len(), &found.lines[..]), (3, &[vec![0, 1, 2], vec![2, 0]][..]));
        let ignored: Vec<&str> = report.ignored.iter().map(|ignored| &*ignored.what).collect();
        assert_eq!(ignored, ["`f` statements", "`p` statements"]);
        let (soup, lines, report) = read_with_lines(file.as_bytes(), &Limits::default()).unwrap();
        assert_eq!((soup.triangles, lines), (vec![[0, 1, 2]], found.lines));
        assert_eq!(report.ignored.len(), 1);
        let error = |file: &str| read_polylines(file.as_bytes(), &Limits::default()).unwrap_err().to_string();
        assert_eq!(error("v 0 0 0\nl 1\n"), "line 2: expected a line of at least 2 vertices, found 1");
        let beyond = "line 2: vertex index 2 is out of range, the file has 1 vertices and counts from 1";
        assert_eq!(error("v 0 0 0\nl 1 2\n"), beyond);
    }

    #[test]
    fn relative_indices_count_back_from_the_face() {
        let soup = text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -1 -2\n").unwrap();
        assert_eq!(soup.triangles, [[0, 1, 2], [0, 3, 2]]);
    }
}
