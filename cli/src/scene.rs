//! Scene files (TOML), read with the place of everything in them: [`Scene`], [`Section`].
//!
//! Promises: every fault is told with file and line; a key that nobody asks for is a fault, and the nearest known one is suggested;
//! nothing is guessed or converted, but a whole number may stand for any number.

use crate::codes::Code;
use crate::failure::{Failure, shell_word};
use crate::input::{cannot_read, edit_distance};
use crate::overrides::Overrides;
use glam::DVec3;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Largest scene file that is read: text that people write is far smaller.
const MAX_BYTES: u64 = 16 << 20;

/// The text of a scene and its name, for messages.
pub(crate) struct Scene {
    pub(crate) name: PathBuf,
    pub(crate) text: String,
    /// Values that take the place of those in the text.
    overrides: Overrides,
}

impl Scene {
    /// A scene that is at hand.
    pub(crate) fn of(name: impl Into<PathBuf>, text: impl Into<String>) -> Self {
        Self { name: name.into(), text: text.into(), overrides: Overrides::default() }
    }

    /// Takes values of the command line, `key.of.table=value`, the last of a key last.
    pub(crate) fn set(mut self, arguments: &[String]) -> Result<Self, Box<Failure>> {
        self.overrides = Overrides::of(arguments, self.text.len())?;
        Ok(self)
    }

    /// Reads the file.
    pub(crate) fn read(name: &Path) -> Result<Self, Box<Failure>> {
        let subject = || name.display().to_string();
        let meta = fs::metadata(name).map_err(|error| cannot_read(name, &error))?;
        if meta.is_dir() {
            return Err(Failure::new(Code::IsDirectory, "this is a directory, and a scene is to be read")
                .subject(subject())
                .help("name a file in it"));
        }
        if meta.len() > MAX_BYTES {
            return Err(Failure::new(Code::SceneSyntax, "the file is too large for a scene")
                .subject(subject())
                .place(format!("{} bytes, at most {MAX_BYTES} are read", meta.len()))
                .help(format!("file {}   # tells what it is", shell_word(name))));
        }
        let bytes = fs::read(name).map_err(|error| cannot_read(name, &error))?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            Failure::new(Code::NotUtf8Text, format!("byte {at} is not UTF-8"))
                .subject(subject())
                .help(format!("file {}   # tells what it is", shell_word(name)))
        })?;
        Ok(Self::of(name, text))
    }

    /// What the text says.
    pub(crate) fn parse(&self) -> Result<Spanned<DeTable<'_>>, Box<Failure>> {
        let mut table = DeTable::parse(&self.text).map_err(|error| {
            let what = error.message().lines().collect::<Vec<_>>().join(", ");
            let span = error.span().unwrap_or(0..0);
            self.fault(Code::SceneSyntax, &span, format!("not TOML: {what}"))
                .help("https://toml.io has the syntax on one page")
        })?;
        self.overrides
            .apply(table.get_mut())
            .map_err(|(span, what)| self.fault(Code::BadValue, &span, what))?;
        Ok(table)
    }

    /// A failure at a place in the text.
    pub(crate) fn fault(&self, code: Code, span: &Range<usize>, what: impl Into<String>) -> Box<Failure> {
        if let Some(argument) = self.overrides.at(span) {
            return Failure::new(code, what)
                .subject(self.name.display().to_string())
                .place(format!("--set {argument}"))
                .help("a key is given with the tables that it is in: --set time.step=0.01");
        }
        let start = span.start.min(self.text.len());
        let line = self.text.as_bytes()[..start].iter().filter(|&&b| b == b'\n').count() + 1;
        let name = self.name.display().to_string();
        Failure::new(code, what)
            .subject(&name)
            .place(format!("{name}:{line}"))
            .help(format!("sed -n {line}p {}   # shows the line", shell_word(&self.name)))
    }
}

/// A table of a scene, whose keys are among those that it may have.
#[derive(Clone)]
pub(crate) struct Section<'t> {
    pub(crate) scene: &'t Scene,
    /// What stands before a key in messages: `field.parts[2].`.
    path: String,
    /// Where the table stands.
    pub(crate) span: Range<usize>,
    table: &'t DeTable<'t>,
}

/// A value of a scene.
#[derive(Clone)]
pub(crate) struct Entry<'t> {
    scene: &'t Scene,
    path: String,
    pub(crate) span: Range<usize>,
    value: &'t DeValue<'t>,
}

impl<'t> Section<'t> {
    /// The whole scene.
    pub(crate) fn whole(scene: &'t Scene, table: &'t Spanned<DeTable<'t>>) -> Self {
        Self { scene, path: String::new(), span: table.span(), table: table.get_ref() }
    }

    /// Refuses keys that are not `known`, the first in the text.
    pub(crate) fn only(&self, known: &[&str]) -> Result<(), Box<Failure>> {
        let unknown = self.table.keys().filter(|key| !known.contains(&key.get_ref().as_ref()));
        let Some(key) = unknown.min_by_key(|key| key.span().start) else { return Ok(()) };
        let name: &str = key.get_ref();
        let what = format!("unknown key `{}{name}`", self.path);
        let fault = self.scene.fault(Code::UnknownKey, &key.span(), what);
        Err(match nearest(name, known) {
            Some(nearest) => fault.help(format!("did you mean `{nearest}`?")),
            None => fault.help(format!("the keys here are {}", known.join(", "))),
        })
    }

    /// The keys that are there, in the order of the text.
    pub(crate) fn keys(&self) -> Vec<&str> {
        let mut keys: Vec<_> = self.table.keys().collect();
        keys.sort_by_key(|key| key.span().start);
        keys.into_iter().map(|key| key.get_ref().as_ref()).collect()
    }

    pub(crate) fn get(&self, key: &str) -> Option<Entry<'t>> {
        let (_, value) = self.table.iter().find(|(name, _)| name.get_ref() == key)?;
        let path = format!("{}{key}", self.path);
        Some(Entry { scene: self.scene, path, span: value.span(), value: value.get_ref() })
    }

    pub(crate) fn required(&self, key: &str) -> Result<Entry<'t>, Box<Failure>> {
        self.get(key).ok_or_else(|| {
            let what = format!("the key `{}{key}` is missing", self.path);
            self.scene.fault(Code::MissingKey, &self.span, what).help(format!("add a line: {key} = ..."))
        })
    }

    /// The number of a key, or what stands for it.
    pub(crate) fn number(&self, key: &str, default: f64) -> Result<f64, Box<Failure>> {
        self.get(key).map_or(Ok(default), |entry| entry.number())
    }

    /// The vector of a key, or what stands for it.
    pub(crate) fn vector(&self, key: &str, default: DVec3) -> Result<DVec3, Box<Failure>> {
        self.get(key).map_or(Ok(default), |entry| entry.vector())
    }

    /// One of the choices of a key, the first if the key is not there.
    pub(crate) fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<T, Box<Failure>> {
        self.get(key).map_or(Ok(choices[0].1), |entry| entry.choice(choices))
    }

    /// A whole number of a key, or what stands for it.
    pub(crate) fn whole_number(&self, key: &str, default: u64) -> Result<u64, Box<Failure>> {
        self.get(key).map_or(Ok(default), |entry| entry.whole_number())
    }

    /// A failure about the table, or about the key in it if it is there.
    pub(crate) fn bad(&self, key: &str, what: impl Into<String>) -> Box<Failure> {
        let span = self.get(key).map_or(self.span.clone(), |entry| entry.span);
        self.scene.fault(Code::BadValue, &span, what)
    }
}

impl<'t> Entry<'t> {
    /// What it is, and what is wanted.
    pub(crate) fn bad(&self, wanted: &str) -> Box<Failure> {
        let what = format!("`{}` is {}, and {wanted} is wanted", self.path, shown(self.value));
        self.scene.fault(Code::BadValue, &self.span, what)
    }

    pub(crate) fn section(&self) -> Result<Section<'t>, Box<Failure>> {
        let table = self.value.as_table().ok_or_else(|| self.bad("a table"))?;
        let path = format!("{}.", self.path);
        Ok(Section { scene: self.scene, path, span: self.span.clone(), table })
    }

    /// The elements of an array.
    pub(crate) fn list(&self) -> Result<Vec<Entry<'t>>, Box<Failure>> {
        let array = self.value.as_array().ok_or_else(|| self.bad("an array"))?;
        let entry = |(k, value): (usize, &'t Spanned<DeValue<'t>>)| Entry {
            scene: self.scene,
            path: format!("{}[{k}]", self.path),
            span: value.span(),
            value: value.get_ref(),
        };
        Ok(array.iter().enumerate().map(entry).collect())
    }

    pub(crate) fn number(&self) -> Result<f64, Box<Failure>> {
        self.as_number().ok_or_else(|| self.bad("a number"))
    }

    fn as_number(&self) -> Option<f64> {
        match self.value {
            DeValue::Float(number) => number.as_str().parse().ok(),
            DeValue::Integer(number) => {
                i64::from_str_radix(number.as_str(), number.radix()).ok().map(|n| n as f64)
            }
            _ => None,
        }
    }

    pub(crate) fn whole_number(&self) -> Result<u64, Box<Failure>> {
        let number = self.value.as_integer();
        let number = number.and_then(|n| u64::from_str_radix(n.as_str(), n.radix()).ok());
        number.ok_or_else(|| self.bad("a whole number from 0 on"))
    }

    pub(crate) fn flag(&self) -> Result<bool, Box<Failure>> {
        self.value.as_bool().ok_or_else(|| self.bad("true or false"))
    }

    pub(crate) fn text(&self) -> Result<&'t str, Box<Failure>> {
        self.value.as_str().ok_or_else(|| self.bad("text in quotes"))
    }

    /// Three numbers, or the name of an axis for its direction.
    pub(crate) fn vector(&self) -> Result<DVec3, Box<Failure>> {
        if let Some(axis) = self.value.as_str() {
            let axes = [("x", DVec3::X), ("y", DVec3::Y), ("z", DVec3::Z)];
            return axes
                .into_iter()
                .find(|(name, _)| *name == axis)
                .map(|(_, direction)| direction)
                .ok_or_else(|| self.bad("three numbers, or \"x\", \"y\" or \"z\""));
        }
        let numbers: Option<Vec<f64>> =
            self.list().ok().and_then(|list| list.iter().map(Self::as_number).collect());
        match numbers.as_deref() {
            Some(&[x, y, z]) => Ok(DVec3::new(x, y, z)),
            _ => Err(self.bad("an array of three numbers")),
        }
    }

    /// As many vectors.
    pub(crate) fn vectors<const N: usize>(&self, wanted: &str) -> Result<[DVec3; N], Box<Failure>> {
        let list = self.list().map_err(|_| self.bad(wanted))?;
        let vectors = list.iter().map(Self::vector).collect::<Result<Vec<_>, _>>()?;
        vectors.try_into().map_err(|_| self.bad(wanted))
    }

    pub(crate) fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, Box<Failure>> {
        let name = self.text()?;
        if let Some((_, choice)) = choices.iter().find(|(known, _)| *known == name) {
            return Ok(*choice);
        }
        let known: Vec<&str> = choices.iter().map(|(known, _)| *known).collect();
        let fault = self.bad(&format!("one of {}", known.join(", ")));
        Err(match nearest(name, &known) {
            Some(nearest) => fault.help(format!("did you mean \"{nearest}\"?")),
            None => fault,
        })
    }
}

/// A value in a few words.
fn shown(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", text.chars().take(40).collect::<String>().escape_debug()),
        DeValue::Integer(number) => number.as_str().to_owned(),
        DeValue::Float(number) => number.as_str().to_owned(),
        DeValue::Array(list) => format!("an array of {}", list.len()),
        other => format!("of the kind {}", other.type_str()),
    }
}

/// The known name that differs least, if by little.
pub(crate) fn nearest<'k>(name: &str, known: &[&'k str]) -> Option<&'k str> {
    let name: String = name.chars().take(40).flat_map(char::to_lowercase).collect();
    let (edits, nearest) = known.iter().map(|known| (edit_distance(&name, known), *known)).min()?;
    (edits <= nearest.len() / 3 + 1).then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with<T>(text: &str, look: impl FnOnce(Section<'_>) -> T) -> T {
        let scene = Scene::of("a.toml", text);
        let table = scene.parse().expect("valid TOML");
        look(Section::whole(&scene, &table))
    }

    #[test]
    fn values_of_every_kind_are_read() {
        with("a = 1\nb = -2.5e3\nc = [1, 2.0, 0x10]\nd = \"y\"\ne = 1_000\nf = inf", |section| {
            assert_eq!(section.number("a", 0.0).unwrap(), 1.0);
            assert_eq!(section.number("b", 0.0).unwrap(), -2500.0);
            assert_eq!(section.number("f", 0.0).unwrap(), f64::INFINITY);
            assert_eq!(section.number("g", 7.0).unwrap(), 7.0);
            assert_eq!(section.vector("c", DVec3::ZERO).unwrap(), DVec3::new(1.0, 2.0, 16.0));
            assert_eq!(section.vector("d", DVec3::ZERO).unwrap(), DVec3::Y);
            assert_eq!(section.whole_number("e", 0).unwrap(), 1000);
            assert_eq!(section.choice("d", &[("x", 0), ("y", 1)]).unwrap(), 1);
        });
    }

    #[test]
    fn faults_have_a_line_and_a_suggestion() {
        with("radius = 1\n\nraduis = 2\nb = \"wrong\"", |section| {
            let fault = section.only(&["radius", "center"]).unwrap_err();
            assert_eq!((fault.code, fault.places[0].as_str()), (Code::UnknownKey, "a.toml:3"));
            assert!(fault.help.contains("radius"), "{}", fault.help);
            let fault = section.number("b", 0.0).unwrap_err();
            assert_eq!(fault.what, "`b` is \"wrong\", and a number is wanted");
            assert_eq!(fault.places[0], "a.toml:4");
            let fault = section.required("height").err().expect("there is none");
            assert_eq!(fault.code, Code::MissingKey);
        });
    }

    #[test]
    fn what_is_not_toml_is_told_with_its_line() {
        let scene = Scene::of("a.toml", "a = 1\nb = = 2");
        let fault = scene.parse().unwrap_err();
        assert_eq!((fault.code, fault.places[0].as_str()), (Code::SceneSyntax, "a.toml:2"));
        // Nesting without end is refused and not followed.
        let deep = Scene::of("a.toml", format!("a = {}", "[".repeat(100_000)));
        assert!(deep.parse().is_err());
    }
}
