//! Writes STL: text keeps f64 in shortest decimals and groups as solids; binary rounds to single precision.

use super::super::text::{Decimal, lost_names, one_line};
use super::super::view::runs;
use super::super::{Dropped, Encoding, SurfaceData, WriteError, WriteReport};
use super::weld::Weld;
use glam::DVec3;
use std::io::Write;

pub(in super::super) fn write<S: SurfaceData + ?Sized>(
    output: &mut impl Write,
    surface: &S,
    encoding: Encoding,
) -> Result<WriteReport, WriteError> {
    let mut dropped = Vec::new();
    let round = match encoding {
        Encoding::Ascii => |p: DVec3| p,
        Encoding::Binary => |p: DVec3| p.as_vec3().as_dvec3(),
    };
    if encoding == Encoding::Binary {
        let vertices = moved(surface.positions())?;
        if vertices > 0 {
            dropped.push(Dropped::CoordinatePrecision { vertices });
        }
    }
    lost_vertices(surface, round, &mut dropped);
    match encoding {
        Encoding::Ascii => {
            write_ascii(output, surface)?;
            dropped.extend(lost_names(surface.groups()));
        }
        Encoding::Binary => {
            write_binary(output, surface)?;
            let count = surface.groups().len();
            if count > 0 {
                dropped.push(Dropped::Groups { count });
            }
        }
    }
    let count = surface.triangle_colors().len();
    if count > 0 {
        dropped.push(Dropped::TriangleColors { count });
    }
    Ok(WriteReport { dropped })
}

/// Number of vertices that single precision moves; an error where one would move to infinity.
fn moved(positions: &[DVec3]) -> Result<usize, WriteError> {
    let mut count = 0;
    for (vertex, p) in positions.iter().enumerate() {
        let rounded = p.as_vec3().as_dvec3();
        for (value, rounded) in p.to_array().into_iter().zip(rounded.to_array()) {
            if value.is_finite() && !rounded.is_finite() {
                return Err(WriteError::BeyondSinglePrecision { vertex, value });
            }
        }
        count += usize::from(!p.is_nan() && rounded != *p);
    }
    Ok(count)
}

/// What a reader that welds equal corners will not find again: unused vertices, coincident ones, their order.
fn lost_vertices<S: SurfaceData + ?Sized>(
    surface: &S,
    round: fn(DVec3) -> DVec3,
    dropped: &mut Vec<Dropped>,
) {
    let mut used = vec![false; surface.positions().len()];
    let mut weld = Weld::new();
    let mut points = Vec::new();
    let mut renumbered = 0;
    let mut coincident = 0;
    for triangle in 0..surface.triangle_count() {
        for index in surface.triangle(triangle).map(|i| i as usize) {
            if std::mem::replace(&mut used[index], true) {
                continue;
            }
            renumbered += usize::from(index != points.len() + coincident);
            let point = round(surface.positions()[index]);
            match weld.find(point, &points) {
                Some(_) => coincident += 1,
                None => points.push(point),
            }
        }
    }
    let count = used.iter().filter(|used| !**used).count();
    if count > 0 {
        dropped.push(Dropped::UnusedVertices { count });
    }
    if coincident > 0 {
        dropped.push(Dropped::CoincidentVertices { count: coincident });
    }
    if renumbered > 0 {
        dropped.push(Dropped::VertexOrder { vertices: renumbered });
    }
}

fn write_ascii<S: SurfaceData + ?Sized>(output: &mut impl Write, surface: &S) -> Result<(), WriteError> {
    let mut solids = runs(surface);
    if solids.is_empty() {
        solids.push(("", 0..0));
    }
    for (name, run) in solids {
        let name = one_line(name);
        let space = if name.is_empty() { "" } else { " " };
        writeln!(output, "solid{space}{name}")?;
        for triangle in run {
            let corners = surface.triangle(triangle).map(|i| surface.positions()[i as usize]);
            let [x, y, z] = normal(corners);
            writeln!(output, "facet normal {x} {y} {z}\n outer loop")?;
            for p in corners {
                writeln!(output, "  vertex {} {} {}", Decimal(p.x), Decimal(p.y), Decimal(p.z))?;
            }
            writeln!(output, " endloop\nendfacet")?;
        }
        writeln!(output, "endsolid{space}{name}")?;
    }
    Ok(())
}

/// Begins a binary file; must not begin with `solid`.
const TITLE: &[u8] = b"binary STL written by welter";

fn write_binary<S: SurfaceData + ?Sized>(output: &mut impl Write, surface: &S) -> Result<(), WriteError> {
    let mut header = [0; 84];
    header[..TITLE.len()].copy_from_slice(TITLE);
    let count = u32::try_from(surface.triangle_count()).expect("counts were checked before");
    header[80..].copy_from_slice(&count.to_le_bytes());
    output.write_all(&header)?;
    for triangle in 0..surface.triangle_count() {
        let corners = surface.triangle(triangle).map(|i| surface.positions()[i as usize]);
        let numbers = normal(corners).into_iter().chain(corners.iter().flat_map(|p| p.as_vec3().to_array()));
        let mut record = [0; 50];
        for (bytes, number) in record.chunks_exact_mut(4).zip(numbers) {
            bytes.copy_from_slice(&number.to_le_bytes());
        }
        output.write_all(&record)?;
    }
    Ok(())
}

/// The unit normal; zero for a triangle without area or with a coordinate that is not finite.
fn normal([a, b, c]: [DVec3; 3]) -> [f32; 3] {
    // Quarters, then a scale of 1: nothing overflows, and small triangles keep their normal.
    let (u, v) = (b * 0.25 - a * 0.25, c * 0.25 - a * 0.25);
    let extent = u.abs().max(v.abs()).max_element();
    let cross = (u / extent).cross(v / extent);
    let normal = (cross / cross.abs().max_element()).normalize_or_zero();
    if normal.is_finite() { normal.as_vec3().to_array() } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_of_any_size_are_units_or_zero() {
        let corners = |s: f64| [DVec3::ZERO, DVec3::X * s, DVec3::Y * s];
        for s in [1e-300, 1.0, 1e308] {
            assert_eq!(normal(corners(s)), [0.0, 0.0, 1.0]);
        }
        assert_eq!(normal(corners(0.0)), [0.0; 3]);
        assert_eq!(normal(corners(f64::NAN)), [0.0; 3]);
    }
}
