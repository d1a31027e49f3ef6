//! The page: [`page`].

use super::frame::Cube;
use crate::html::{base64, escaped};
use serde_json::json;
use std::fmt::Write as _;
use welter_meshing::DVec3;

const SCRIPT: &str = include_str!("viewer.js");

const STYLE: &str = "\
:root{color-scheme:light dark}\
body{margin:0;height:100vh;display:flex;flex-direction:column;font:15px/1.4 system-ui,sans-serif}\
canvas{flex:1;min-height:0;width:100%;touch-action:none;cursor:grab}\
footer{padding:.4rem .8rem;display:flex;gap:1rem;flex-wrap:wrap;align-items:center}\
#controls{display:flex;gap:.6rem;flex:1;min-width:16rem}#controls[hidden]{display:none}\
input[type=range]{flex:1}.help{opacity:.7}";

/// A frame, packed.
pub(super) struct Framed {
    pub(super) name: String,
    pub(super) cube: Cube,
    pub(super) bytes: Vec<u8>,
}

/// What is shown.
pub(super) struct Show<'a> {
    pub(super) title: &'a str,
    pub(super) frames: &'a [Framed],
    /// The axis that points up: `y` or `z`.
    pub(super) up: &'static str,
}

/// The page as HTML; it names no other file.
pub(super) fn page(show: &Show<'_>) -> String {
    let cube = Cube::around_all(show.frames.iter().map(|frame| &frame.cube)).unwrap_or(Cube::of(&[]));
    let center = 0.5 * cube.extent;
    // Of a point: what is seen of it does not matter.
    let radius = if center == DVec3::ZERO { 0.5 } else { center.length() };
    let told = |frame: &Framed| {
        let place = frame.cube.within(&cube);
        json!({ "name": frame.name, "corner": place.corner.to_array(), "side": place.side })
    };
    let meta = json!({
        "frames": show.frames.iter().map(told).collect::<Vec<_>>(),
        "center": center.to_array(),
        "radius": radius,
        "up": show.up,
    });
    // A name could end the script.
    let meta = meta.to_string().replace('<', "\\u003c");
    let title = escaped(show.title);
    let mut html = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n\
         <canvas id=\"view\" aria-label=\"{title}\"></canvas>\n<footer>\n\
         <span id=\"controls\"><button id=\"play\">Play</button>\
         <input id=\"frame\" type=\"range\" min=\"0\" value=\"0\" aria-label=\"frame\"></span>\n\
         <span id=\"what\">{title}</span>\n\
         <label><input id=\"edges\" type=\"checkbox\"> edges</label>\n\
         <label><input id=\"flat\" type=\"checkbox\"> flat</label>\n\
         <span class=\"help\">drag turns, shift or the right button moves, the wheel zooms, r resets</span>\n</footer>\n"
    );
    for (k, frame) in show.frames.iter().enumerate() {
        let _ =
            writeln!(html, "<script type=\"text/plain\" id=\"data-{k}\">{}</script>", base64(&frame.bytes));
    }
    let _ = write!(
        html,
        "<script>\n{SCRIPT}\nconst meta = {meta};\nif (typeof document !== \"undefined\") Viewer.start(meta);\n\
         </script>\n</body>\n</html>\n"
    );
    html
}
