//! Scenes read key by key: [`Settings`] is a table whose keys are known because they are asked for.
//!
//! Promises: a key that nobody asks for is refused, with the nearest one that somebody does; every value that holds, given or not, is kept,
//! so that the resolved scene tells all of them, and so is every key that may be given and was not; a value of the wrong kind or out of its range is a fault at its line.

use super::resolved::{Resolved, Value};
use crate::codes::Code;
use crate::failure::Failure;
use crate::scene::{Entry, Scene, Section, nearest};
use glam::DVec3;
use std::ops::Range;

/// What a number must be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowed {
    words: &'static str,
    holds: fn(f64) -> bool,
}

/// Above zero and finite.
pub(crate) const POSITIVE: Allowed =
    Allowed { words: "a finite number above 0", holds: |x| x > 0.0 && x.is_finite() };
/// Any finite number.
pub(crate) const FINITE: Allowed = Allowed { words: "a finite number", holds: f64::is_finite };

/// Any number but NaN; what takes it says what it may be.
pub(crate) const ANY: Allowed = Allowed { words: "a number", holds: |x| !x.is_nan() };

/// A table of a scene while it is read.
pub(crate) struct Settings<'t> {
    scene: &'t Scene,
    /// None where the scene has no such table: then every key is missing.
    section: Option<Section<'t>>,
    /// What stands before a key in messages.
    path: String,
    /// Of the table, or of the one around it.
    span: Range<usize>,
    asked: Vec<&'static str>,
    /// Where there is no table: one beside it that may be meant.
    suspect: Option<String>,
    resolved: Resolved,
}

/// Reads a whole scene with `read`; gives what that gives, and the resolved scene.
pub(crate) fn read_scene<T>(
    scene: &Scene,
    read: impl FnOnce(&mut Settings<'_>) -> Result<T, Box<Failure>>,
) -> Result<(T, Resolved), Box<Failure>> {
    let table = scene.parse()?;
    let section = Section::whole(scene, &table);
    let settings = Settings::new(scene, Some(section), String::new(), 0..0);
    settings.read(read)
}

impl<'t> Settings<'t> {
    fn new(scene: &'t Scene, section: Option<Section<'t>>, path: String, around: Range<usize>) -> Self {
        let span = section.as_ref().map_or(around, |section| section.span.clone());
        Self { scene, section, path, span, asked: Vec::new(), suspect: None, resolved: Resolved::default() }
    }

    fn read<T>(
        mut self,
        read: impl FnOnce(&mut Self) -> Result<T, Box<Failure>>,
    ) -> Result<(T, Resolved), Box<Failure>> {
        let value = read(&mut self)?;
        if let Some(section) = &self.section {
            section.only(&self.asked)?;
        }
        Ok((value, self.resolved))
    }

    fn entry(&mut self, key: &'static str) -> Option<Entry<'t>> {
        self.asked.push(key);
        self.section.as_ref().and_then(|section| section.get(key))
    }

    fn keep(&mut self, key: &str, value: Value) {
        self.resolved.0.push((key.to_owned(), value));
    }

    /// Nothing, for a key that may be left away and was.
    fn absent<T>(&mut self, key: &'static str, value: Value) -> Result<Option<T>, Box<Failure>> {
        self.asked.push(key);
        self.keep(key, value);
        Ok(None)
    }

    /// The failure for a key that is not there. Another that nobody asked for so far may be meant.
    fn missing(&self, key: &str) -> Box<Failure> {
        let Some(section) = &self.section else {
            let table = self.path.trim_end_matches('.');
            let what = format!("the table [{table}] is missing, with the key `{key}`");
            let fault = self.scene.fault(Code::MissingKey, &self.span, what);
            return fault.help(match &self.suspect {
                Some(suspect) => format!("[{table}]; is it meant by [{suspect}]?"),
                None => format!("add [{table}], and below it: {key} = ..."),
            });
        };
        let fault = section.required(key).err().expect("the key is not there");
        match self.suspect_of(key) {
            Some(suspect) => fault.help(format!("{key} = ...; is it meant by `{suspect}`?")),
            None => fault,
        }
    }

    /// A key that nobody asked for so far, and that may be a misspelling.
    fn suspect_of(&self, key: &str) -> Option<String> {
        let section = self.section.as_ref()?;
        let keys = section.keys();
        let suspect = |name: &&str| !self.asked.contains(name) && nearest(name, &[key]).is_some();
        keys.into_iter().find(suspect).map(str::to_owned)
    }

    /// A fault at a key, or at its table.
    pub(crate) fn bad(&self, key: &str, what: impl Into<String>) -> Box<Failure> {
        match &self.section {
            Some(section) => section.bad(key, what),
            None => self.scene.fault(Code::BadValue, &self.span, what),
        }
    }

    /// Whether the scene gives a key.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.section.as_ref().is_some_and(|section| section.get(key).is_some())
    }

    /// A value of a key: as `read` reads it, or `default`, or a failure where there is none.
    fn value<T: Clone>(
        &mut self,
        key: &'static str,
        default: Option<T>,
        read: impl FnOnce(&Entry<'t>) -> Result<T, Box<Failure>>,
        keep: impl FnOnce(T) -> Value,
    ) -> Result<T, Box<Failure>> {
        let value = match (self.entry(key), default) {
            (Some(entry), _) => read(&entry)?,
            (None, Some(default)) => default,
            (None, None) => return Err(self.missing(key)),
        };
        self.keep(key, keep(value.clone()));
        Ok(value)
    }

    pub(crate) fn number(
        &mut self,
        key: &'static str,
        default: impl Into<Option<f64>>,
        allowed: Allowed,
    ) -> Result<f64, Box<Failure>> {
        self.value(key, default.into(), |entry| number(entry, allowed), Value::Number)
    }

    /// A number, if it is given.
    pub(crate) fn optional_number(
        &mut self,
        key: &'static str,
        allowed: Allowed,
    ) -> Result<Option<f64>, Box<Failure>> {
        if self.has(key) {
            return self.number(key, None, allowed).map(Some);
        }
        self.absent(key, Value::Absent)
    }

    /// A whole number from `least` on.
    pub(crate) fn whole(
        &mut self,
        key: &'static str,
        default: impl Into<Option<u64>>,
        least: u64,
    ) -> Result<u64, Box<Failure>> {
        let read = |entry: &Entry<'t>| match entry.whole_number()? {
            number if number >= least => Ok(number),
            _ => Err(entry.bad(&format!("a whole number from {least} on"))),
        };
        self.value(key, default.into(), read, Value::Whole)
    }

    /// A whole number, if it is given.
    pub(crate) fn optional_whole(
        &mut self,
        key: &'static str,
        least: u64,
    ) -> Result<Option<u64>, Box<Failure>> {
        if self.has(key) {
            return self.whole(key, None, least).map(Some);
        }
        self.absent(key, Value::Absent)
    }

    /// A whole number of 32 bits, from `least` on.
    pub(crate) fn small(&mut self, key: &'static str, default: u32, least: u32) -> Result<u32, Box<Failure>> {
        let read = |entry: &Entry<'t>| {
            let number = u32::try_from(entry.whole_number()?).ok().filter(|&number| number >= least);
            number.ok_or_else(|| entry.bad(&format!("a whole number from {least} to {}", u32::MAX)))
        };
        self.value(key, Some(default), read, |number| Value::Whole(number.into()))
    }

    pub(crate) fn flag(&mut self, key: &'static str, default: bool) -> Result<bool, Box<Failure>> {
        self.value(key, Some(default), Entry::flag, Value::Flag)
    }

    /// Text, if it is given.
    pub(crate) fn text(&mut self, key: &'static str) -> Result<Option<String>, Box<Failure>> {
        if !self.has(key) {
            return self.absent(key, Value::Absent);
        }
        self.value(key, None, |entry| entry.text().map(str::to_owned), Value::Text).map(Some)
    }

    /// Keeps text that the scene need not give, such as what a file was found to hold.
    pub(crate) fn settle_text(&mut self, key: &'static str, text: &str) {
        let pairs = &mut self.resolved.0;
        match pairs.iter_mut().find(|(known, _)| known == key) {
            Some((_, value)) => *value = Value::Text(text.to_owned()),
            None => self.keep(key, Value::Text(text.to_owned())),
        }
    }

    /// A finite vector.
    pub(crate) fn vector(
        &mut self,
        key: &'static str,
        default: impl Into<Option<DVec3>>,
    ) -> Result<DVec3, Box<Failure>> {
        let read = |entry: &Entry<'t>| {
            let vector = entry.vector()?;
            if vector.is_finite() { Ok(vector) } else { Err(entry.bad("a vector of finite numbers")) }
        };
        let keep = |v: DVec3| Value::List(v.to_array().map(Value::Number).to_vec());
        self.value(key, default.into(), read, keep)
    }

    /// Pairs of numbers, the first of them ascending.
    pub(crate) fn pairs(&mut self, key: &'static str, wanted: &str) -> Result<Vec<[f64; 2]>, Box<Failure>> {
        self.rows(key, wanted, true)
    }

    /// As many numbers each, the first of them ascending if they are `ordered`.
    pub(crate) fn rows<const N: usize>(
        &mut self,
        key: &'static str,
        wanted: &str,
        ordered: bool,
    ) -> Result<Vec<[f64; N]>, Box<Failure>> {
        let read = |entry: &Entry<'t>| {
            let list = entry.list().map_err(|_| entry.bad(wanted))?;
            let mut rows: Vec<[f64; N]> = Vec::new();
            for row in &list {
                let all = row.list().map_err(|_| row.bad(wanted))?;
                let numbers = all.iter().map(|one| number(one, FINITE)).collect::<Result<Vec<_>, _>>()?;
                let numbers: [f64; N] = numbers.try_into().map_err(|_| row.bad(wanted))?;
                if ordered && rows.last().is_some_and(|last| last[0] >= numbers[0]) {
                    return Err(row.bad("a later pair"));
                }
                rows.push(numbers);
            }
            if rows.is_empty() { Err(entry.bad(wanted)) } else { Ok(rows) }
        };
        let keep = |rows: Vec<[f64; N]>| {
            Value::List(rows.iter().map(|row| Value::List(row.map(Value::Number).to_vec())).collect())
        };
        self.value(key, None, read, keep)
    }

    /// Rows, if they are given.
    pub(crate) fn optional_rows<const N: usize>(
        &mut self,
        key: &'static str,
        wanted: &str,
    ) -> Result<Option<Vec<[f64; N]>>, Box<Failure>> {
        if self.has(key) {
            return self.rows(key, wanted, true).map(Some);
        }
        self.absent(key, Value::Absent)
    }

    /// A vector, if it is given.
    pub(crate) fn optional_vector(&mut self, key: &'static str) -> Result<Option<DVec3>, Box<Failure>> {
        if self.has(key) {
            return self.vector(key, None).map(Some);
        }
        self.absent(key, Value::Absent)
    }

    /// Two whole numbers from `least` to `most`.
    pub(crate) fn size(
        &mut self,
        key: &'static str,
        default: [u32; 2],
        [least, most]: [u32; 2],
    ) -> Result<[u32; 2], Box<Failure>> {
        let read = |entry: &Entry<'t>| {
            let wanted = format!("an array of two whole numbers from {least} to {most}");
            let list = entry.list().map_err(|_| entry.bad(&wanted))?;
            let side = |one: &Entry<'t>| {
                let side = one.whole_number().ok().and_then(|n| u32::try_from(n).ok());
                side.filter(|n| (least..=most).contains(n))
                    .ok_or_else(|| one.bad(&format!("{least} to {most}")))
            };
            let sides = list.iter().map(side).collect::<Result<Vec<_>, _>>()?;
            sides.try_into().map_err(|_| entry.bad(&wanted))
        };
        let keep = |sides: [u32; 2]| Value::List(sides.map(|n| Value::Whole(n.into())).to_vec());
        self.value(key, Some(default), read, keep)
    }

    /// One of the choices, the first if the key is not there.
    pub(crate) fn choice<T: Copy>(
        &mut self,
        key: &'static str,
        choices: &[(&str, T)],
    ) -> Result<T, Box<Failure>> {
        let places: Vec<(&str, usize)> =
            choices.iter().enumerate().map(|(k, (name, _))| (*name, k)).collect();
        let keep = |k: usize| Value::Text(choices[k].0.to_owned());
        let chosen = self.value(key, Some(0), |entry| entry.choice(&places), keep)?;
        Ok(choices[chosen].1)
    }

    /// One of the choices, of which none stands for the others.
    pub(crate) fn required_choice<T: Copy>(
        &mut self,
        key: &'static str,
        choices: &[(&str, T)],
    ) -> Result<T, Box<Failure>> {
        if self.has(key) {
            return self.choice(key, choices);
        }
        self.asked.push(key);
        let known: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        Err(self.missing(key).help(format!("{key} = \"...\", one of {}", known.join(", "))))
    }

    /// Some of the choices, each at most once; `default` are places in `choices`.
    pub(crate) fn choices<T: Copy>(
        &mut self,
        key: &'static str,
        default: &[usize],
        choices: &[(&str, T)],
    ) -> Result<Vec<T>, Box<Failure>> {
        let places: Vec<(&str, usize)> =
            choices.iter().enumerate().map(|(k, (name, _))| (*name, k)).collect();
        let read = |entry: &Entry<'t>| {
            let names = places.iter().map(|(name, _)| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
            let list = entry.list().map_err(|_| entry.bad(&format!("an array of some of {names}")))?;
            let mut chosen: Vec<usize> = Vec::new();
            for one in &list {
                let place = one.choice(&places)?;
                if chosen.contains(&place) {
                    return Err(one.bad("each of them once"));
                }
                chosen.push(place);
            }
            Ok(chosen)
        };
        let keep = |chosen: Vec<usize>| {
            Value::List(chosen.into_iter().map(|k| Value::Text(choices[k].0.to_owned())).collect())
        };
        let chosen = self.value(key, Some(default.to_vec()), read, keep)?;
        Ok(chosen.into_iter().map(|k| choices[k].1).collect())
    }

    /// A table, without keys if it is not there.
    pub(crate) fn table<T>(
        &mut self,
        key: &'static str,
        read: impl FnOnce(&mut Settings<'t>) -> Result<T, Box<Failure>>,
    ) -> Result<T, Box<Failure>> {
        let section = self.entry(key).map(|entry| entry.section()).transpose()?;
        let path = format!("{}{key}.", self.path);
        let mut settings = Settings::new(self.scene, section, path, self.span.clone());
        settings.suspect = self.suspect_of(key);
        let (value, resolved) = settings.read(read)?;
        if !resolved.0.is_empty() {
            self.keep(key, Value::Table(resolved));
        }
        Ok(value)
    }

    /// A table, if it is there.
    pub(crate) fn optional_table<T>(
        &mut self,
        key: &'static str,
        read: impl FnOnce(&mut Settings<'t>) -> Result<T, Box<Failure>>,
    ) -> Result<Option<T>, Box<Failure>> {
        if self.has(key) {
            return self.table(key, read).map(Some);
        }
        self.absent(key, Value::AbsentTable { many: false })
    }

    /// An array of tables, if it is there.
    pub(crate) fn tables<T>(
        &mut self,
        key: &'static str,
        mut read: impl FnMut(&mut Settings<'t>) -> Result<T, Box<Failure>>,
    ) -> Result<Option<Vec<T>>, Box<Failure>> {
        if !self.has(key) {
            return self.absent(key, Value::AbsentTable { many: true });
        }
        let entry = self.entry(key).expect("it is there");
        let (mut values, mut tables) = (Vec::new(), Vec::new());
        for (k, element) in entry.list()?.iter().enumerate() {
            let path = format!("{}{key}[{k}].", self.path);
            let section = Some(element.section()?);
            let (value, resolved) =
                Settings::new(self.scene, section, path, self.span.clone()).read(&mut read)?;
            values.push(value);
            tables.push(resolved);
        }
        if values.is_empty() {
            return Err(entry.bad("at least one table"));
        }
        self.keep(key, Value::Tables(tables));
        Ok(Some(values))
    }
}

fn number(entry: &Entry<'_>, allowed: Allowed) -> Result<f64, Box<Failure>> {
    let number = entry.number()?;
    if (allowed.holds)(number) { Ok(number) } else { Err(entry.bad(allowed.words)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Read = (f64, Option<u64>, Vec<f64>, Vec<[f64; 2]>, bool, [u32; 2], &'static str);

    fn read(text: &str) -> Result<(Read, Resolved), Box<Failure>> {
        read_scene(&Scene::of("a.toml", text), |scene| {
            let (step, steps) = scene.table("time", |time| {
                Ok((time.number("step", None, POSITIVE)?, time.optional_whole("steps", 1)?))
            })?;
            let parts = scene.tables("parts", |part| part.number("scale", 1.0, FINITE))?;
            let kind = scene.choice("kind", &[("one", "1"), ("two", "2")])?;
            let pairs = if scene.has("pairs") { scene.pairs("pairs", "pairs")? } else { Vec::new() };
            let (flag, size) = scene.table("output", |output| {
                Ok((output.flag("pictures", false)?, output.size("size", [3, 4], [1, 100])?))
            })?;
            Ok((step, steps, parts.unwrap_or_default(), pairs, flag, size, kind))
        })
    }

    const FULL: &str = "kind = \"two\"\n[time]\nstep = 0.1\nsteps = 5\n[[parts]]\nscale = 2\n[[parts]]\n[output]\nsize = [7, 8]\n";

    #[test]
    fn what_holds_is_kept_and_resolves_to_itself() {
        let (values, resolved) = read(FULL).unwrap();
        assert_eq!(values, (0.1, Some(5), vec![2.0, 1.0], vec![], false, [7, 8], "2"));
        let text = resolved.to_toml();
        assert!(text.contains("pictures = false") && text.contains("scale = 1.0"), "{text}");
        let (again, twice) = read(&text).unwrap();
        assert_eq!((again, twice), (values, resolved));
    }

    #[test]
    fn keys_that_are_not_given_are_told_as_comments() {
        let (_, resolved) = read("[time]\nstep = 0.1\n").unwrap();
        let told = resolved.to_toml_with_absent_keys();
        for line in ["step = 0.1\n# steps = ...\n", "\n# [[parts]] ...\n"] {
            assert!(told.contains(line), "{told}");
        }
        assert_eq!(read(&told).unwrap().1, resolved);
        let lines = |text: &str| -> Vec<String> {
            text.lines().filter(|it| !it.is_empty() && !it.starts_with('#')).map(str::to_owned).collect()
        };
        assert_eq!(lines(&told), lines(&resolved.to_toml()), "the same but for those");
        assert!(resolved.to_json()["time"].get("steps").is_none());
    }

    #[test]
    fn some_of_the_choices_are_kept_in_their_order() {
        let read = |text: &str| {
            read_scene(&Scene::of("a.toml", text), |scene| {
                scene.choices("formats", &[1], &[("png", 'p'), ("exr", 'e')])
            })
        };
        for (text, chosen, told) in [
            ("", vec!['e'], "formats = [\"exr\"]\n"),
            ("formats = []", vec![], "formats = []\n"),
            ("formats = [\"exr\", \"png\"]", vec!['e', 'p'], "formats = [\"exr\", \"png\"]\n"),
        ] {
            let (values, resolved) = read(text).unwrap();
            assert_eq!((values, resolved.to_toml().as_str()), (chosen, told));
        }
        for text in
            ["formats = \"png\"", "formats = [\"png\", \"png\"]", "formats = [\"pgn\"]", "formats = [1]"]
        {
            assert_eq!(read(text).unwrap_err().code, Code::BadValue, "{text}");
        }
    }

    #[test]
    fn faults_are_told_at_their_line_with_what_may_be_meant() {
        for (text, code, line, help) in [
            ("[time]\nstep = 1\nsteeps = 2", Code::UnknownKey, 3, "`steps`"),
            ("[time]\nstpe = 1", Code::MissingKey, 1, "`stpe`"),
            ("[time]\nsteps = 1", Code::MissingKey, 1, "step = ..."),
            ("kind = \"one\"", Code::MissingKey, 1, "[time]"),
            ("[tiem]\nstep = 1", Code::MissingKey, 1, "[tiem]"),
            ("[time]\nstep = 0", Code::BadValue, 2, ""),
            ("[time]\nstep = nan", Code::BadValue, 2, ""),
            ("[time]\nstep = 1\nsteps = 0", Code::BadValue, 3, ""),
            ("[time]\nstep = 1\n[[parts]]\nscal = 2", Code::UnknownKey, 4, "`scale`"),
            ("parts = []\n[time]\nstep = 1", Code::BadValue, 1, ""),
            ("kind = \"tow\"\n[time]\nstep = 1", Code::BadValue, 1, "\"two\""),
            ("pairs = [[0, 1], [0, 2]]\n[time]\nstep = 1", Code::BadValue, 1, ""),
            ("[time]\nstep = 1\n[output]\nsize = [0, 1]", Code::BadValue, 4, ""),
            ("[time]\nstep = 1\n[output]\npictures = 1", Code::BadValue, 4, ""),
        ] {
            let fault = read(text).unwrap_err();
            assert_eq!(
                (fault.code, fault.places[0].as_str()),
                (code, format!("a.toml:{line}").as_str()),
                "{text}"
            );
            assert!(fault.help.contains(help), "{text}: {}", fault.help);
        }
    }
}
