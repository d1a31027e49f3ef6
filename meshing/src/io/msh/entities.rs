//! The physical tags of cells and the entities to which they belong: [`Tags`], [`Entity`].

use std::collections::{BTreeMap, BTreeSet};

use crate::DVec3;
use crate::io::{CellKind, FieldValues, VolumeView, WriteError};

/// The largest tag: one number is left for an entity of the cells without.
pub(super) const LARGEST: i64 = i32::MAX as i64 - 1;

/// The tags of the cells of a mesh.
pub(super) struct Tags<'a> {
    values: Option<&'a FieldValues<'a>>,
    /// The entity of cells without tag, the same for both dimensions.
    untagged: i32,
}

/// An entity: cells of one dimension and tag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entity {
    pub(super) physical: i32,
    pub(super) min: DVec3,
    pub(super) max: DVec3,
}

impl<'a> Tags<'a> {
    /// The tags in the field of a name, checked.
    pub(super) fn new(mesh: &VolumeView<'a>, name: Option<&str>) -> Result<Self, WriteError> {
        let Some(name) = name else { return Ok(Self { values: None, untagged: 1 }) };
        let fits = |field: &&'a crate::io::DataField<'a>| {
            field.name == name && field.components == 1 && field.values.is_integer()
        };
        let field = mesh.cell_fields.iter().find(fits);
        let values =
            &field.ok_or_else(|| WriteError::NoTags { name: name.to_owned(), place: "cell" })?.values;
        let mut used = BTreeSet::new();
        for number in 0..values.len() {
            let tag = values.integer(number).expect("the field was found to hold integers");
            if !(0..=LARGEST).contains(&tag) {
                return Err(WriteError::Tag { place: "cell", number, tag, limit: LARGEST });
            }
            used.insert(tag as i32);
        }
        let untagged = (1..i32::MAX).find(|tag| !used.contains(tag)).unwrap_or(i32::MAX);
        Ok(Self { values: Some(values), untagged })
    }

    /// The physical tag of a cell; 0 for none.
    #[inline]
    pub(super) fn physical(&self, cell: usize) -> i32 {
        self.values.and_then(|values| values.integer(cell)).unwrap_or(0) as i32 // checked to be in range
    }

    /// The entity of a cell.
    #[inline]
    pub(super) fn entity(&self, cell: usize) -> i32 {
        match self.physical(cell) {
            0 => self.untagged,
            tag => tag,
        }
    }

    /// The entities with cells, by dimension and number, each with its extent. A mesh of vertices alone has one volume, which holds them.
    pub(super) fn entities(&self, mesh: &VolumeView<'_>) -> BTreeMap<(usize, i32), Entity> {
        let mut entities: BTreeMap<(usize, i32), Entity> = BTreeMap::new();
        let mut cell = 0;
        for kind in CellKind::ALL {
            for index in 0..mesh.count(kind) {
                let corners = mesh.corners(kind, index);
                let first = (mesh.position)(corners[0] as usize);
                let entity = entities.entry((kind.dimension(), self.entity(cell))).or_insert(Entity {
                    physical: self.physical(cell),
                    min: first,
                    max: first,
                });
                for &corner in corners {
                    entity.include((mesh.position)(corner as usize));
                }
                cell += 1;
            }
        }
        if entities.is_empty() && mesh.vertices > 0 {
            let first = (mesh.position)(0);
            let mut entity = Entity { physical: 0, min: first, max: first };
            (0..mesh.vertices).for_each(|vertex| entity.include((mesh.position)(vertex)));
            entities.insert((3, self.untagged), entity);
        }
        entities
    }
}

impl Entity {
    fn include(&mut self, position: DVec3) {
        self.min = self.min.min(position);
        self.max = self.max.max(position);
    }
}
