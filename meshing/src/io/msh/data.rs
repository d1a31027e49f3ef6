//! Which fields an MSH file holds, and what is lost of the others: [`dropped`].

use super::PHYSICAL;
use crate::io::{DataField, Dropped, FieldLoss, FieldValues, VolumeView};

/// Numbers of components that the format knows: scalars, vectors, tensors.
pub(super) const COMPONENTS: [usize; 3] = [1, 3, 9];
/// Largest integer below which f64 holds all.
const EXACT: u64 = 1 << 53;

/// Why a field is not written as data; none if it is.
pub(super) fn left_out(field: &DataField<'_>, places: usize, tags: Option<&str>) -> Option<FieldLoss> {
    let is_physical_beside_tags = tags.is_some() && field.name == PHYSICAL;
    if field.name.contains('"') || is_physical_beside_tags {
        Some(FieldLoss::Name)
    } else if !COMPONENTS.contains(&field.components) || places > i32::MAX as usize {
        Some(FieldLoss::Everything)
    } else {
        None
    }
}

/// Whether tags are read as the field that they were.
fn comes_back(field: &DataField<'_>) -> bool {
    let FieldValues::Int32(values) = &field.values else { return false };
    field.name == PHYSICAL && values.iter().any(|&tag| tag != 0)
}

/// The fields that are not in the file, or not as they were.
pub(super) fn dropped(mesh: &VolumeView<'_>, tags: Option<&str>) -> Vec<Dropped> {
    let mut dropped = Vec::new();
    let mut drop = |field: &DataField<'_>, loss| {
        dropped.push(Dropped::Field { name: field.name.to_string(), loss });
    };
    for field in mesh.point_fields {
        if let Some(loss) = left_out(field, mesh.vertices, None).or_else(|| changed(&field.values)) {
            drop(field, loss);
        }
    }
    for field in mesh.cell_fields {
        if tags == Some(&*field.name) {
            if !comes_back(field) {
                drop(field, FieldLoss::Renamed);
            }
        } else if let Some(loss) = left_out(field, mesh.cell_count(), tags).or_else(|| changed(&field.values))
        {
            drop(field, loss);
        }
    }
    dropped
}

/// What becomes of numbers that are written as f64.
fn changed(values: &FieldValues<'_>) -> Option<FieldLoss> {
    match values {
        FieldValues::Float64(_) => None,
        FieldValues::Int64(values) if values.iter().any(|value| value.unsigned_abs() > EXACT) => {
            Some(FieldLoss::Precision)
        }
        _ => Some(FieldLoss::Type),
    }
}
