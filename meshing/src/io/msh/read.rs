//! Reads MSH: section by section.

use std::collections::BTreeMap;
use std::io::Read;

use super::ids::{Numbering, Places};
use super::input::Input;
use super::read_data::Data;
use super::{GEOMETRICAL, PHYSICAL, names, read_data, read_four, read_two};
use crate::DVec3;
use crate::io::error::{Place, ReadError, shown};
use crate::io::source::Source;
use crate::io::volume_builder::VolumeBuilder;
use crate::io::{DataField, Limits, ReadReport, VolumeData};

use super::types::ElementType;

const EXPECTED: &str = "an MSH file of Gmsh";
/// Sections that are passed over under their own name.
const PASSED_OVER: [&str; 6] = [
    "PartitionedEntities",
    "Periodic",
    "GhostElements",
    "Parametrizations",
    "ElementNodeData",
    "InterpolationScheme",
];

/// What was read so far.
pub(super) struct Reader {
    pub(super) builder: VolumeBuilder,
    /// The physical tag of each entity, by dimension and number.
    pub(super) entities: BTreeMap<(i32, i32), i32>,
    /// Whether names of physical groups were read.
    named: bool,
    pub(super) nodes: Option<Places>,
    pub(super) elements: Option<Numbering>,
    /// The physical tag and the entity of each element.
    pub(super) tags: Vec<[i32; 2]>,
    pub(super) node_data: Vec<Data>,
    pub(super) element_data: Vec<Data>,
}

pub(super) fn read(input: impl Read, limits: &Limits) -> Result<(VolumeData, ReadReport), ReadError> {
    let mut source = Source::new(input);
    source.begin_text(EXPECTED)?;
    let mut input = Input::new(source);
    let version_four = format(&mut input)?;
    let mut reader = Reader {
        builder: VolumeBuilder::new(limits),
        entities: BTreeMap::new(),
        named: false,
        nodes: None,
        elements: None,
        tags: Vec::new(),
        node_data: Vec::new(),
        element_data: Vec::new(),
    };
    while let Some(section) = section(&mut input)? {
        reader.section(&mut input, &section, version_four)?;
    }
    reader.finish(input.words().end())
}

/// The name of the next section; none at the end of the file.
fn section<R: Read>(input: &mut Input<R>) -> Result<Option<String>, ReadError> {
    let Some(line) = input.words().filled_line()? else { return Ok(None) };
    let name = line.strip_prefix(b"$").and_then(|name| std::str::from_utf8(name).ok()).map(str::to_owned);
    if let Some(name) = name.filter(|name| !name.is_empty() && !name.starts_with("End")) {
        return Ok(Some(name));
    }
    let found = shown(line);
    let expected = "the beginning of a section such as `$Nodes`".to_owned();
    Err(ReadError::Unexpected { at: input.line_place(), expected, found })
}

/// Reads the first section, passing over comments; whether the version is 4.1.
fn format<R: Read>(input: &mut Input<R>) -> Result<bool, ReadError> {
    loop {
        match section(input)?.as_deref() {
            None => return Err(ReadError::Empty { expected: EXPECTED.to_owned() }),
            Some("Comments") => input.skip_section("Comments")?,
            Some("MeshFormat") => break,
            Some(other) => {
                let found = other.as_bytes();
                return Err(ReadError::unexpected(input.line_place(), "section `MeshFormat` first", found));
            }
        }
    }
    let version = input.words().required(|| "the version of the format".to_owned())?.to_vec();
    let at = input.line_place();
    let four = match &version[..] {
        b"2" | b"2.0" | b"2.1" | b"2.2" => false,
        b"4.1" => true,
        b"1" | b"1.0" | b"4" | b"4.0" | b"3" | b"3.0" => {
            return Err(ReadError::Unsupported { at, what: format!("version {}", shown(&version)) });
        }
        _ => return Err(ReadError::unexpected(at, "version 2.2 or 4.1", &version)),
    };
    let wrong =
        |expected: &str, found: u64| ReadError::unexpected(at, expected, found.to_string().as_bytes());
    let binary = input.words().count(|| "0 for text or 1 for binary".to_owned())?;
    let size = input.text_count(|| "the size of numbers".to_owned())?;
    if binary > 1 {
        return Err(wrong("0 for text or 1 for binary", binary));
    }
    if !(size == 8 || size == 4 && four) {
        return Err(wrong("numbers of 8 bytes", size));
    }
    if binary == 1 {
        input.begin_binary(size as usize)?;
    }
    input.end_section("MeshFormat")?;
    Ok(four)
}

impl Reader {
    fn section<R: Read>(&mut self, input: &mut Input<R>, name: &str, four: bool) -> Result<(), ReadError> {
        let at = input.line_place();
        match name {
            "PhysicalNames" => {
                self.once(self.named, "$PhysicalNames", at)?;
                self.named = true;
                names::read(input, &mut self.builder)?;
            }
            "Entities" if four => read_four::entities(input, self)?,
            "Nodes" => {
                self.once(self.nodes.is_some(), "$Nodes", at)?;
                let numbers =
                    if four { read_four::nodes(input, self) } else { read_two::nodes(input, self) }?;
                let places = numbers.into_places().map_err(|twice| ReadError::Unexpected {
                    at,
                    expected: "nodes with numbers of their own".to_owned(),
                    found: format!("{twice} twice"),
                })?;
                self.nodes = Some(places);
            }
            "Elements" => {
                self.once(self.elements.is_some(), "$Elements", at)?;
                let nodes = self.nodes.take();
                let nodes = nodes.ok_or_else(|| ReadError::unexpected(at, "`$Nodes` first", b"$Elements"))?;
                let numbers = if four {
                    read_four::elements(input, self, &nodes)
                } else {
                    read_two::elements(input, self, &nodes)
                }?;
                (self.nodes, self.elements) = (Some(nodes), Some(numbers));
            }
            "NodeData" => {
                let data = read_data::read(input, name, &mut self.builder)?;
                self.node_data.extend(data);
            }
            "ElementData" => {
                let data = read_data::read(input, name, &mut self.builder)?;
                self.element_data.extend(data);
            }
            _ => {
                let known = PASSED_OVER.iter().find(|known| **known == name);
                let what = known.map_or("sections of other kinds".to_owned(), |known| format!("`${known}`"));
                self.builder.ignore(what, at);
                return input.skip_section(name);
            }
        }
        input.end_section(name)
    }

    fn once(&self, before: bool, name: &str, at: Place) -> Result<(), ReadError> {
        let twice = || ReadError::unexpected(at, format!("one section `{name}`"), name.as_bytes());
        if before { Err(twice()) } else { Ok(()) }
    }

    pub(super) fn node(&mut self, position: [f64; 3], at: Place) -> Result<(), ReadError> {
        self.builder.vertex(DVec3::from_array(position), at)
    }

    /// Adds an element with the numbers of its nodes.
    pub(super) fn element(
        &mut self,
        kind: ElementType,
        nodes: &[u64],
        tags: [i32; 2],
        places: &Places,
        at: Place,
    ) -> Result<(), ReadError> {
        self.tags.push(tags);
        let kind = match kind {
            ElementType::Other(_, what) => return self.builder.pass_over(what, at),
            ElementType::Cell(kind) => kind,
        };
        let mut corners = [0; 8];
        for (corner, &number) in corners[..kind.corners()].iter_mut().zip(nodes) {
            let Some(place) = places.place(number) else {
                let expected = format!("the number of a node as corner of a {kind}");
                return Err(ReadError::Unexpected { at, expected, found: number.to_string() });
            };
            *corner = place as u32; // below the limit on vertices, which is of 32 bits
        }
        self.builder.cell(kind, &corners[..kind.corners()], at)
    }

    fn finish(mut self, last: Place) -> Result<(VolumeData, ReadReport), ReadError> {
        let missing = |what: &str| ReadError::Truncated { at: last, expected: format!("section `{what}`") };
        let nodes = self.nodes.take().ok_or_else(|| missing("$Nodes"))?;
        let elements = self.elements.take().ok_or_else(|| missing("$Elements"))?;
        let tags = std::mem::take(&mut self.tags);
        let column = |k: usize| tags.iter().map(|tags| tags[k]).collect::<Vec<i32>>();
        let mut fields = Vec::new();
        if tags.iter().any(|tags| tags[0] != 0) {
            fields.push(DataField::new(PHYSICAL, 1, column(0)));
        }
        if entities_say_more(&tags) {
            fields.push(DataField::new(GEOMETRICAL, 1, column(1)));
        }
        self.builder.add_cell_fields(fields);
        read_data::add_point_fields(&mut self.builder, self.node_data, &nodes)?;
        read_data::add_cell_fields(&mut self.builder, self.element_data, elements)?;
        Ok(self.builder.finish())
    }
}

/// Whether an entity is not the physical tag, or elements without tag are of several.
fn entities_say_more(tags: &[[i32; 2]]) -> bool {
    let mut untagged = None;
    tags.iter().any(|&[physical, entity]| match physical {
        0 => *untagged.get_or_insert(entity) != entity,
        tag => tag != entity,
    })
}
