//! Values at all nodes of a grid: one by one, or from whole arrays of the parts' values.
//!
//! A part that knows a faster way than one node after the other, a mesh, is worth arrays for all parts; others are quicker without.

use rayon::prelude::*;

use crate::field::ScalarField;
use crate::grid::Grid3;
use crate::{Cancelled, DVec3, Monitor};

/// Numbers that one thread takes at a time.
const CHUNK: usize = 1 << 14;

/// The value at each node, asked for by itself.
pub(super) fn one_by_one(
    field: &(impl ScalarField + ?Sized),
    grid: &Grid3,
    monitor: &Monitor<'_>,
) -> Result<Vec<f64>, Cancelled> {
    let [nx, ny, nz] = grid.nodes();
    let stage = monitor.stage("sampling", u64::from(ny) * u64::from(nz));
    let mut values = vec![0.0; grid.node_count()];
    values.par_chunks_mut(nx as usize).enumerate().try_for_each(|(row, values)| {
        stage.check()?;
        let [_, y, z] = grid.node(grid.node_at(row * nx as usize));
        for (i, value) in (0..nx).zip(values) {
            *value = field.value(DVec3::new(grid.coordinate(0, i), y, z));
        }
        stage.advance(1);
        Ok(())
    })?;
    Ok(values)
}

/// A function of each value.
pub(super) fn mapped(mut values: Vec<f64>, f: impl Fn(f64) -> f64 + Sync) -> Vec<f64> {
    values.par_iter_mut().with_min_len(CHUNK).for_each(|value| *value = f(*value));
    values
}

/// A function of each two values of the same node.
pub(super) fn joined(mut values: Vec<f64>, others: &[f64], f: impl Fn(f64, f64) -> f64 + Sync) -> Vec<f64> {
    let pairs = values.par_iter_mut().zip(others).with_min_len(CHUNK);
    pairs.for_each(|(value, &other)| *value = f(*value, other));
    values
}

/// The values of parts joined in order; of no part, `none`.
pub(super) fn folded<F: ScalarField>(
    parts: &[F],
    none: f64,
    grid: &Grid3,
    monitor: &Monitor<'_>,
    f: impl Fn(f64, f64) -> f64 + Sync,
) -> Result<Vec<f64>, Cancelled> {
    let Some((first, others)) = parts.split_first() else {
        return Ok(vec![none; grid.node_count()]);
    };
    let start = first.at_nodes(grid, monitor)?;
    others.iter().try_fold(start, |values, part| Ok(joined(values, &part.at_nodes(grid, monitor)?, &f)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::InsideRule;
    use crate::field::{
        AnyField, Ball, Complement, Difference, Intersection, MeshDistance, Offset, Shell, Union,
    };
    use crate::shapes::{BoxPair, two_boxes};

    #[test]
    fn whole_arrays_have_the_bits_of_single_values() {
        let mesh = two_boxes(&BoxPair::overlapping()).expect("valid parameters");
        let solid = AnyField::new(MeshDistance::new(&mesh, InsideRule::default()));
        let ball = AnyField::new(Ball { radius: 0.9, ..Ball::default() });
        let offset = AnyField::new(Offset { field: solid.clone(), distance: 0.1 });
        let shell = AnyField::new(Shell { field: solid.clone(), thickness: 0.3 });
        let fields = [
            solid.clone(),
            AnyField::new(Union { parts: vec![ball.clone(), offset.clone()], blend_width: 0.2 }),
            AnyField::new(Intersection {
                parts: vec![solid.clone(), ball.clone(), shell.clone()],
                blend_width: 0.0,
            }),
            AnyField::new(Difference { from: ball.clone(), removed: offset, blend_width: 0.1 }),
            AnyField::new(Complement { field: shell }),
        ];
        let grid = Grid3::new([-2.0, -1.5, -1.0], 0.25, [15, 12, 9]).expect("exact");
        for (i, field) in fields.iter().enumerate() {
            assert!(field.knows_nodes() && !ball.knows_nodes());
            let values = field.at_nodes(&grid, &Monitor::none()).expect("nobody stops");
            for (number, value) in values.into_iter().enumerate() {
                let node = grid.position(grid.node_at(number));
                assert_eq!(value.to_bits(), field.value(node).to_bits(), "field {i} at {node}");
            }
        }
    }
}
