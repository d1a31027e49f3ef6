//! A scene with every value that holds, those that the scene does not give among them: [`Resolved`].
//!
//! Promises: as TOML it is a scene that resolves to itself, bit for bit; the same text for the same values.

use crate::overrides::quoted;
use serde_json::{Map, Value as Json, json};
use std::fmt::Write as _;

/// A table: keys in the order in which they were asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Resolved(pub(super) Vec<(String, Value)>);

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Number(f64),
    Whole(u64),
    Flag(bool),
    Text(String),
    List(Vec<Value>),
    Table(Resolved),
    /// An array of tables.
    Tables(Vec<Resolved>),
    /// A key that has no default, and that the scene does not give.
    Absent,
    /// A table, or an array of `many`, of the kind.
    AbsentTable {
        many: bool,
    },
}

impl Resolved {
    /// As a scene.
    pub(crate) fn to_toml(&self) -> String {
        let mut text = String::new();
        self.write(&mut text, "", Absent::Hidden);
        text
    }

    /// As a scene, with the keys that may be given, and are not, as comments.
    pub(crate) fn to_toml_with_absent_keys(&self) -> String {
        let mut text = String::new();
        self.write(&mut text, "", Absent::Told);
        text
    }

    pub(crate) fn to_json(&self) -> Json {
        let given = self.0.iter().filter(|(_, value)| value.is_given());
        let pairs = given.map(|(key, value)| (key.clone(), value.to_json()));
        Json::Object(pairs.collect::<Map<_, _>>())
    }

    /// The values of the table first: what stands behind a header belongs to it.
    fn write(&self, text: &mut String, path: &str, absent: Absent) {
        for (key, value) in &self.0 {
            if !matches!(
                value,
                Value::Table(_) | Value::Tables(_) | Value::Absent | Value::AbsentTable { .. }
            ) {
                let _ = writeln!(text, "{key} = {}", value.in_line());
            }
        }
        for (key, value) in &self.0 {
            if *value == Value::Absent && absent == Absent::Told {
                let _ = writeln!(text, "# {key} = ...");
            }
        }
        for (key, value) in &self.0 {
            let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            let mut header = |[open, close]: [&str; 2], table: &Self| {
                let gap = if text.is_empty() { "" } else { "\n" };
                let _ = writeln!(text, "{gap}{open}{path}{close}");
                table.write(text, &path, absent);
            };
            match value {
                Value::Table(table) if absent == Absent::Told || table.has_values() => {
                    header(["[", "]"], table);
                }
                Value::Tables(tables) => tables.iter().for_each(|table| header(["[[", "]]"], table)),
                Value::AbsentTable { many } if absent == Absent::Told => {
                    let brackets = if *many { ["# [[", "]] ..."] } else { ["# [", "] ..."] };
                    header(brackets, &Self::default());
                }
                _ => {}
            }
        }
    }

    fn has_values(&self) -> bool {
        self.0.iter().any(|(_, value)| value.is_given())
    }
}

/// What is written of keys that are not there.
#[derive(Clone, Copy, PartialEq)]
enum Absent {
    Hidden,
    Told,
}

impl Value {
    /// Whether there is something to be written of it.
    fn is_given(&self) -> bool {
        match self {
            Self::Absent | Self::AbsentTable { .. } => false,
            Self::Table(table) => table.has_values(),
            _ => true,
        }
    }

    fn in_line(&self) -> String {
        match self {
            // With a point or an exponent, as TOML tells numbers from whole ones; the shortest that gives the same bits.
            Self::Number(number) => format!("{number:?}"),
            Self::Whole(number) => number.to_string(),
            Self::Flag(flag) => flag.to_string(),
            Self::Text(text) => quoted(text),
            Self::List(list) => {
                format!("[{}]", list.iter().map(Self::in_line).collect::<Vec<_>>().join(", "))
            }
            Self::Table(table) => {
                let given = table.0.iter().filter(|(_, value)| value.is_given());
                let pairs = given.map(|(key, value)| format!("{key} = {}", value.in_line()));
                format!("{{ {} }}", pairs.collect::<Vec<_>>().join(", "))
            }
            Self::Tables(tables) => Self::List(tables.iter().cloned().map(Self::Table).collect()).in_line(),
            Self::Absent | Self::AbsentTable { .. } => unreachable!("what is not given is not written"),
        }
    }

    fn to_json(&self) -> Json {
        match self {
            Self::Number(number) => json!(number),
            Self::Whole(number) => json!(number),
            Self::Flag(flag) => json!(flag),
            Self::Text(text) => json!(text),
            Self::List(list) => Json::Array(list.iter().map(Self::to_json).collect()),
            Self::Table(table) => table.to_json(),
            Self::Tables(tables) => Json::Array(tables.iter().map(Resolved::to_json).collect()),
            Self::Absent | Self::AbsentTable { .. } => Json::Null,
        }
    }
}

/// The first line in which two resolved scenes differ, of each, with its table.
pub(crate) fn first_difference(before: &str, now: &str) -> Option<[String; 2]> {
    fn lines(text: &str) -> Vec<String> {
        let mut table = "";
        let mut lines = Vec::new();
        for line in text.lines().filter(|line| !line.is_empty()) {
            if line.starts_with('[') {
                table = line;
            } else {
                lines.push(if table.is_empty() { line.to_owned() } else { format!("{table} {line}") });
            }
        }
        lines
    }
    let (before, now) = (lines(before), lines(now));
    (0..before.len().max(now.len())).find_map(|k| {
        let line = |lines: &[String]| lines.get(k).cloned().unwrap_or_else(|| "nothing".to_owned());
        let pair = [line(&before), line(&now)];
        (pair[0] != pair[1]).then_some(pair)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resolved() -> Resolved {
        let pair = |key: &str, value| (key.to_owned(), value);
        Resolved(vec![
            pair("title", Value::Text("a \"b\"".into())),
            pair(
                "surface",
                Value::Table(Resolved(vec![
                    pair(
                        "parts",
                        Value::Tables(vec![
                            Resolved(vec![pair("x", Value::Number(1e300))]),
                            Resolved(vec![pair("x", Value::Number(-0.0))]),
                        ]),
                    ),
                    pair("edge_length", Value::Number(0.1)),
                    pair("at", Value::List(vec![Value::Number(1.0), Value::Number(0.1 + 0.2)])),
                ])),
            ),
            pair(
                "time",
                Value::Table(Resolved(vec![pair("steps", Value::Whole(7)), pair("on", Value::Flag(true))])),
            ),
        ])
    }

    #[test]
    fn values_stand_before_tables() {
        assert_eq!(
            resolved().to_toml(),
            "title = \"a \\\"b\\\"\"\n\n[surface]\nedge_length = 0.1\nat = [1.0, 0.30000000000000004]\n\n\
             [[surface.parts]]\nx = 1e300\n\n[[surface.parts]]\nx = -0.0\n\n[time]\nsteps = 7\non = true\n"
        );
        assert_eq!(resolved().to_json()["surface"]["parts"][0]["x"], 1e300);
    }

    #[test]
    fn the_first_difference_is_told_with_its_table() {
        let text = resolved().to_toml();
        assert_eq!(first_difference(&text, &text), None);
        let other = text.replace("steps = 7", "steps = 8");
        assert_eq!(
            first_difference(&text, &other),
            Some(["[time] steps = 7".into(), "[time] steps = 8".into()])
        );
        assert_eq!(first_difference("", "a = 1\n"), Some(["nothing".into(), "a = 1".into()]));
    }
}
