//! A self-contained page: a title, a sentence, a picture, tables.

use std::fmt::Write as _;

/// What a page shows.
#[derive(Debug)]
pub(crate) struct Page<'a> {
    pub(crate) title: &'a str,
    /// The result in one sentence.
    pub(crate) verdict: &'a str,
    /// PNG files, each with its caption.
    pub(crate) pictures: &'a [(&'a [u8], &'a str)],
    /// Curves of numbers over the steps of a run, each with its name.
    pub(crate) graphs: &'a [(String, Vec<f64>)],
    /// Headings and rows of name and value.
    pub(crate) tables: &'a [(&'a str, Vec<(String, String)>)],
    /// Commands to try next.
    pub(crate) commands: &'a [String],
}

const STYLE: &str = "\
:root{color-scheme:light dark}\
body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem}\
h1{font-size:1.6rem;margin-bottom:.2rem}h2{font-size:1.1rem;margin-top:2rem}\
.verdict{font-size:1.1rem;border-left:4px solid #de4c14;padding-left:.8rem}\
figure{margin:1.5rem 0}img,svg{max-width:100%;height:auto;border-radius:6px}\
figcaption,footer{opacity:.7;font-size:.9rem}\
table{border-collapse:collapse}td{padding:.15rem 1.5rem .15rem 0;border-bottom:1px solid #8884}\
td:last-child{font-variant-numeric:tabular-nums}\
pre{background:#8882;padding:.7rem;border-radius:6px;overflow-x:auto}";

impl Page<'_> {
    /// The page as HTML; it names no other file.
    pub(crate) fn to_html(&self) -> String {
        let title = escaped(self.title);
        let mut html = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n\
             <p class=\"verdict\">{}</p>\n",
            escaped(self.verdict)
        );
        for (png, caption) in self.pictures {
            let _ = writeln!(
                html,
                "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>",
                escaped(caption),
                base64(png)
            );
        }
        for (name, values) in self.graphs {
            html.push_str(&graph(name, values));
        }
        for (heading, rows) in self.tables {
            let _ = writeln!(html, "<h2>{}</h2>\n<table>", escaped(heading));
            for (name, value) in rows {
                let _ = writeln!(html, "<tr><td>{}</td><td>{}</td></tr>", escaped(name), escaped(value));
            }
            html.push_str("</table>\n");
        }
        if !self.commands.is_empty() {
            let _ = writeln!(html, "<h2>Try next</h2>\n<pre>{}</pre>", escaped(&self.commands.join("\n")));
        }
        let _ = writeln!(
            html,
            "<footer><p>welter {}</p></footer>\n</body>\n</html>",
            escaped(env!("CARGO_PKG_VERSION"))
        );
        html
    }
}

/// A curve, with its least, greatest and last value in words. What is not finite interrupts it.
fn graph(name: &str, values: &[f64]) -> String {
    const SIZE: [f64; 2] = [600.0, 90.0];
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (least, greatest) =
        (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let Some(last) = finite().next_back() else { return String::new() };
    let across = SIZE[0] / (values.len().max(2) - 1) as f64;
    let share = |value: f64| {
        let whole = greatest - least;
        if whole > 0.0 { (value - least) / whole } else { 0.5 }
    };
    let (mut path, mut drawing) = (String::new(), false);
    for (k, &value) in values.iter().enumerate() {
        if value.is_finite() {
            let letter = if drawing { 'L' } else { 'M' };
            let (x, y) = (k as f64 * across, SIZE[1] * (1.0 - share(value)));
            let _ = write!(path, "{letter}{x:.1} {y:.1}");
        }
        drawing = value.is_finite();
    }
    let number = crate::numbers::number;
    let caption = escaped(&format!(
        "{name}: from {} to {}, at the end {}",
        number(least),
        number(greatest),
        number(last)
    ));
    format!(
        "<figure><svg viewBox=\"-2 -2 604 94\" role=\"img\" aria-label=\"{caption}\">\
         <path d=\"{path}\" fill=\"none\" stroke=\"#de4c14\" stroke-width=\"1.5\" stroke-linejoin=\"round\"/></svg>\
         <figcaption>{caption}</figcaption></figure>\n"
    )
}

pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c => out.push(c),
        }
    }
    out
}

/// Base 64 with padding, as data URIs take it.
pub(crate) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word =
            chunk.iter().enumerate().fold(0_u32, |word, (k, &byte)| word | u32::from(byte) << (16 - 8 * k));
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k) & 63) as usize];
            text.push(if k <= chunk.len() { char::from(digit) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_standard_examples() {
        // RFC 4648, section 10.
        for (plain, coded) in
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn curves_keep_within_their_frame_and_stop_at_gaps() {
        let text = graph("volume", &[1.0, f64::NAN, 3.0, 2.0, f64::INFINITY]);
        assert!(text.contains("d=\"M0.0 90.0M300.0 0.0L450.0 45.0\""), "{text}");
        assert!(text.contains("volume: from 1 to 3, at the end 2"), "{text}");
        assert!(graph("same", &[5.0, 5.0]).contains("M0.0 45.0L600.0 45.0"));
        assert_eq!(graph("none", &[f64::NAN]), "");
    }

    #[test]
    fn names_of_files_cannot_break_the_page() {
        let page = Page {
            title: "<script>",
            verdict: "a & b",
            pictures: &[],
            graphs: &[],
            tables: &[],
            commands: &[],
        };
        let html = page.to_html();
        assert!(!html.contains("<script>") && html.contains("a &amp; b"));
    }
}
