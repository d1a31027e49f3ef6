//! Numbers on their way into a file, as text or as little-endian binary: [`Output`].

use std::io::{self, Write};

use crate::io::Encoding;
use crate::io::text::Decimal;

/// A writer of numbers.
pub(super) struct Output<'w, W> {
    output: &'w mut W,
    pub(super) binary: bool,
    /// Whether a number stands on the line in work.
    begun: bool,
}

impl<'w, W: Write> Output<'w, W> {
    pub(super) fn new(output: &'w mut W, encoding: Encoding) -> Self {
        Self { output, binary: encoding == Encoding::Binary, begun: false }
    }

    /// A line of text, in either encoding.
    pub(super) fn line(&mut self, text: &str) -> io::Result<()> {
        writeln!(self.output, "{text}")
    }

    /// The head of a file.
    pub(super) fn format(&mut self, version: &str) -> io::Result<()> {
        self.line("$MeshFormat")?;
        self.line(&format!("{version} {} 8", u8::from(self.binary)))?;
        if self.binary {
            // What tells a reader the byte order.
            self.int(1)?;
            self.line("")?;
        }
        self.line("$EndMeshFormat")
    }

    /// Ends a line of numbers. Binary has no lines.
    pub(super) fn end_line(&mut self) -> io::Result<()> {
        self.begun = false;
        if self.binary { Ok(()) } else { writeln!(self.output) }
    }

    /// Ends numbers and with them their section.
    pub(super) fn end_section(&mut self, name: &str) -> io::Result<()> {
        if self.binary {
            writeln!(self.output)?;
        }
        self.line(&format!("$End{name}"))
    }

    fn separate(&mut self) -> io::Result<()> {
        if std::mem::replace(&mut self.begun, true) { self.output.write_all(b" ") } else { Ok(()) }
    }

    /// Four bytes in binary.
    pub(super) fn int(&mut self, number: i32) -> io::Result<()> {
        if self.binary {
            return self.output.write_all(&number.to_le_bytes());
        }
        self.separate()?;
        write!(self.output, "{number}")
    }

    /// Eight bytes in binary.
    pub(super) fn size(&mut self, number: u64) -> io::Result<()> {
        if self.binary {
            return self.output.write_all(&number.to_le_bytes());
        }
        self.separate()?;
        write!(self.output, "{number}")
    }

    pub(super) fn double(&mut self, number: f64) -> io::Result<()> {
        if self.binary {
            return self.output.write_all(&number.to_le_bytes());
        }
        self.separate()?;
        write!(self.output, "{}", Decimal(number))
    }
}
