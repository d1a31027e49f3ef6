//! Names for the cells that have a tag: [`CellGroup`].

use std::collections::BTreeSet;

use super::WriteError;
use super::data_field::check_name;

/// A named group of cells of a volumetric mesh: those of a dimension that have a tag.
///
/// ```
/// use welter_meshing::{DVec3, io::{CellGroup, DataField, Limits, MshOptions, VolumeData, read_msh, write_msh}};
/// let group = |field: &str| CellGroup { name: "left lung".to_owned(), field: field.to_owned(), dimension: 3, tag: 7 };
/// let mesh = VolumeData {
///     positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
///     tetrahedra: vec![[0, 1, 2, 3]],
///     cell_fields: vec![DataField::new("body", 1, vec![7_i32])],
///     groups: vec![group("body")],
///     ..VolumeData::default()
/// };
/// let mut file = Vec::new();
/// mesh.with_view(|view| write_msh(&mut file, view, &MshOptions { tags: Some("body"), ..MshOptions::default() }))?;
/// let (read, _) = read_msh(&file[..], &Limits::default())?;
/// assert_eq!(read.groups, [group("gmsh:physical")]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellGroup {
    /// Its name, any text.
    pub name: String,
    /// The name of the field of integers on cells that holds the tags. There may be no such field where there are no cells of the tag.
    pub field: String,
    /// Dimension of its cells: 3 or 2.
    pub dimension: usize,
    /// The tag of its cells.
    pub tag: i32,
}

/// Groups are of a dimension that cells have, and no two of the same cells.
pub(super) fn check_groups(groups: &[CellGroup]) -> Result<(), WriteError> {
    let mut known = BTreeSet::new();
    for (group, CellGroup { name, field, dimension, tag }) in groups.iter().enumerate() {
        check_name(field)?;
        let refused = |why| Err(WriteError::CellGroup { group, name: name.clone(), why });
        if !matches!(dimension, 2 | 3) {
            return refused("is of a dimension other than 2 and 3");
        }
        if !known.insert((field, dimension, tag)) {
            return refused("has the field, dimension and tag of a group before it");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_of_the_same_cells_are_refused() {
        let group = |field: &str, dimension, tag| {
            let name = format!("{field} {dimension} {tag}");
            CellGroup { name, field: field.to_owned(), dimension, tag }
        };
        let groups = [group("a", 2, 1), group("a", 3, 1), group("b", 2, 1), group("a", 2, -1)];
        assert!(check_groups(&groups).is_ok());
        let error = check_groups(&[groups.to_vec(), vec![group("a", 3, 1)]].concat()).unwrap_err();
        let why = "has the field, dimension and tag of a group before it";
        assert_eq!(error.to_string(), format!("group 4 (\"a 3 1\") {why}"));
        let error = check_groups(&[group("a", 1, 1)]).unwrap_err();
        assert_eq!(error.to_string(), "group 0 (\"a 1 1\") is of a dimension other than 2 and 3");
    }
}
