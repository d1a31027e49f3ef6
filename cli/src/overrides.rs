//! Values of the command line in the place of those of a scene: `--set flow.period=3`.
//!
//! Promises: what is set is read as what is in the file, with the same faults, and the place told is the argument. A value that is not TOML
//! is text: `--set flow.kind=rotation` needs no quotes. A number in a key is a place in an array, from 0 on.
//!
//! Method: each value is parsed in a text of its own, behind as many spaces that its places come after those of the file and of the values
//! before, so that a place tells where it is from.

use crate::codes::Code;
use crate::failure::Failure;
use std::borrow::Cow;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The key that a value has in its own text.
const VALUE: &str = "value = ";

/// Values in the order in which they take effect.
#[derive(Debug, Default)]
pub(crate) struct Overrides(Vec<Override>);

#[derive(Debug)]
struct Override {
    /// As given.
    argument: String,
    path: Vec<String>,
    /// Spaces, and the value under [`VALUE`].
    text: String,
    span: Range<usize>,
}

impl Overrides {
    /// Arguments `key=value` over a scene of as many bytes.
    pub(crate) fn of(arguments: &[String], scene_bytes: usize) -> Result<Self, Box<Failure>> {
        // The end of the text is a place of the file.
        let mut start = scene_bytes + 1;
        let mut list = Vec::new();
        for argument in arguments {
            let refused = |what: &str| {
                Failure::new(Code::Usage, format!("--set {argument}: {what}"))
                    .help("--set time.step=0.01   # key and value")
            };
            let (key, value) = argument.split_once('=').ok_or_else(|| refused("there is no `=`"))?;
            let path: Vec<String> = key.split('.').map(|part| part.trim().to_owned()).collect();
            if path.iter().any(String::is_empty) {
                return Err(refused("a part of the key is empty"));
            }
            let value = value.trim();
            let is_toml =
                DeTable::parse(&format!("{VALUE}{value}")).is_ok_and(|table| table.get_ref().len() == 1);
            let value = if is_toml { value.to_owned() } else { quoted(value) };
            let text = format!("{}{VALUE}{value}", " ".repeat(start));
            let span = start..text.len() + 1;
            start = span.end;
            list.push(Override { argument: argument.clone(), path, text, span });
        }
        Ok(Self(list))
    }

    /// The argument that a place is of.
    pub(crate) fn at(&self, span: &Range<usize>) -> Option<&str> {
        let found = self.0.iter().find(|one| one.span.contains(&span.start));
        found.map(|one| one.argument.as_str())
    }

    /// Puts the values into a scene; or what is in the way, and of which argument.
    pub(crate) fn apply<'t>(&'t self, table: &mut DeTable<'t>) -> Result<(), (Range<usize>, String)> {
        for one in &self.0 {
            let parsed = DeTable::parse(&one.text).expect("it was parsed before");
            let value = parsed.into_inner().into_iter().next().map(|(_, value)| value);
            let value = value.expect("one key was written");
            put(table, &one.path, &one.span, value).map_err(|what| (one.span.clone(), what))?;
        }
        Ok(())
    }
}

/// Text as TOML.
pub(crate) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            c if c.is_control() => out.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

fn put<'t>(
    table: &mut DeTable<'t>,
    path: &'t [String],
    span: &Range<usize>,
    value: Spanned<DeValue<'t>>,
) -> Result<(), String> {
    let [key, rest @ ..] = path else { return Ok(()) };
    let name = || Spanned::new(span.clone(), Cow::Borrowed(key.as_str()));
    if rest.is_empty() {
        // Removed first, so that the key has the place of the new value.
        table.remove(key.as_str());
        table.insert(name(), value);
        return Ok(());
    }
    if !table.contains_key(key.as_str()) {
        table.insert(name(), Spanned::new(span.clone(), DeValue::Table(DeTable::new())));
    }
    let inner = table.get_mut(key.as_str()).expect("it was put there");
    put_within(inner.get_mut(), key, rest, span, value)
}

fn put_within<'t>(
    place: &mut DeValue<'t>,
    name: &str,
    path: &'t [String],
    span: &Range<usize>,
    value: Spanned<DeValue<'t>>,
) -> Result<(), String> {
    match place {
        DeValue::Table(table) => put(table, path, span, value),
        DeValue::Array(list) => {
            let [index, rest @ ..] = path else { return Ok(()) };
            let count = list.len();
            let element = index.parse().ok().and_then(|k: usize| list.get_mut(k));
            let Some(element) = element else {
                return Err(format!("`{name}` is an array of {count}, and `{index}` is no place in it"));
            };
            if rest.is_empty() {
                *element = value;
                return Ok(());
            }
            put_within(element.get_mut(), index, rest, span, value)
        }
        other => Err(format!("`{name}` is of the kind {}, and has no keys", other.type_str())),
    }
}

#[cfg(test)]
mod tests {
    use crate::codes::Code;
    use crate::scene::{Scene, Section};

    fn scene(sets: &[&str]) -> Scene {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        let text = "[a]\nb = 1\nc = [1, 2]\nlist = [{ x = 1 }, { x = 2 }]\n";
        Scene::of("a.toml", text).set(&sets).unwrap()
    }

    #[test]
    fn values_take_the_place_of_those_of_the_file() {
        let scene =
            scene(&["a.b=2.5", "a.c=[3]", "a.list.1.x = 7", "d.kind=some text", "a.b = 3", "d.e.f=1"]);
        let table = scene.parse().unwrap();
        let whole = Section::whole(&scene, &table);
        let section = |key: &str| whole.get(key).unwrap().section().unwrap();
        let (a, d) = (section("a"), section("d"));
        assert_eq!(a.number("b", 0.0).unwrap(), 3.0);
        assert_eq!(a.get("c").unwrap().list().unwrap().len(), 1);
        let list = a.get("list").unwrap().list().unwrap();
        let x = |k: usize| list[k].section().unwrap().number("x", 0.0).unwrap();
        assert_eq!((x(0), x(1)), (1.0, 7.0));
        assert_eq!(d.get("kind").unwrap().text().unwrap(), "some text");
        assert_eq!(d.get("e").unwrap().section().unwrap().number("f", 0.0).unwrap(), 1.0);
    }

    #[test]
    fn faults_name_the_argument() {
        let scene = scene(&["a.b=one", "a.unknown=\"x\""]);
        let table = scene.parse().unwrap();
        let a = Section::whole(&scene, &table).get("a").unwrap().section().unwrap();
        let fault = a.number("b", 0.0).unwrap_err();
        assert_eq!(fault.places, ["--set a.b=one"]);
        let fault = a.only(&["b", "c", "list"]).unwrap_err();
        assert_eq!((fault.code, fault.places[0].as_str()), (Code::UnknownKey, "--set a.unknown=\"x\""));
        // A fault of the file is told with its line as before.
        assert_eq!(a.get("c").unwrap().number().unwrap_err().places, ["a.toml:3"]);
    }

    #[test]
    fn what_cannot_be_set_is_refused() {
        for wrong in ["a", "=1", "a..b=1"] {
            let scene = Scene::of("a.toml", "");
            assert!(scene.set(&[wrong.to_owned()]).is_err(), "{wrong}");
        }
        for wrong in ["a.b.c=1", "a.c.2=1", "a.c.x=1", "a.list.0.x.y=1"] {
            let fault = scene(&[wrong]).parse().unwrap_err();
            assert_eq!(fault.places, [format!("--set {wrong}")]);
        }
    }

    #[test]
    fn quoted_text_reads_back() {
        for text in ["a\"b\\c", "\u{1}\n", "", "ä"] {
            let scene = Scene::of("a.toml", format!("x = {}", super::quoted(text)));
            let table = scene.parse().unwrap();
            assert_eq!(Section::whole(&scene, &table).get("x").unwrap().text().unwrap(), text);
        }
    }
}
