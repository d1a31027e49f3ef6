//! Solids in a flow: from the tables `[[solids]]` to signed distances, and to what is drawn of them.

use super::bounds::Bounds;
use super::flows::{fault, read_path};
use super::rendering::require_color;
use super::solid_surfaces::SolidSurface;
use crate::failure::Failure;
use crate::runs::settings::{ANY, Settings};
use glam::DVec3;
use welter_fluids::procedural::BoundaryParameters;
use welter_meshing::field::{AnyField, Ball, Capsule, Cuboid, Cylinder, FieldError, HalfSpace, Torus};

/// A solid, and how the flow is led around it.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub(super) shape: AnyField<'static>,
    pub(super) boundary: BoundaryParameters,
    pub(super) surface: SolidSurface,
    /// Whether pictures show it.
    pub(super) drawn: bool,
    /// Share of the light that it throws back (red, green, blue).
    pub(super) albedo: [f64; 3],
}

#[derive(Clone, Copy)]
enum Kind {
    Ball,
    Box,
    Torus,
    Capsule,
    Cylinder,
    HalfSpace,
}

const KINDS: [(&str, Kind); 6] = [
    ("ball", Kind::Ball),
    ("box", Kind::Box),
    ("torus", Kind::Torus),
    ("capsule", Kind::Capsule),
    ("cylinder", Kind::Cylinder),
    ("half-space", Kind::HalfSpace),
];

impl Solid {
    pub(super) fn read(table: &mut Settings<'_>) -> Result<Self, Box<Failure>> {
        let (shape, surface) = match table.required_choice("kind", &KINDS)? {
            Kind::Ball => {
                let ball = Ball {
                    center: table.vector("center", DVec3::ZERO)?,
                    radius: table.number("radius", None, ANY)?,
                };
                valid(table, ball.validate())?;
                (AnyField::new(ball), SolidSurface::ball(&ball))
            }
            Kind::Box => {
                let cuboid = Cuboid {
                    min: table.vector("min", None)?,
                    max: table.vector("max", None)?,
                    rounding: table.number("rounding", 0.0, ANY)?,
                };
                valid(table, cuboid.validate())?;
                (AnyField::new(cuboid), SolidSurface::Box(cuboid))
            }
            Kind::Torus => {
                let torus = Torus {
                    center: table.vector("center", DVec3::ZERO)?,
                    axis: table.vector("axis", DVec3::Z)?,
                    radius: table.number("radius", None, ANY)?,
                    tube_radius: table.number("tube_radius", None, ANY)?,
                };
                valid(table, torus.validate())?;
                (AnyField::new(torus), SolidSurface::torus(&torus))
            }
            Kind::Capsule => {
                let capsule = Capsule { ends: read_ends(table)?, radius: table.number("radius", None, ANY)? };
                valid(table, capsule.validate())?;
                (AnyField::new(capsule), SolidSurface::capsule(&capsule))
            }
            Kind::Cylinder => {
                let cylinder =
                    Cylinder { ends: read_ends(table)?, radius: table.number("radius", None, ANY)? };
                valid(table, cylinder.validate())?;
                (AnyField::new(cylinder), SolidSurface::cylinder(&cylinder))
            }
            Kind::HalfSpace => {
                let half = HalfSpace {
                    point: table.vector("point", DVec3::ZERO)?,
                    normal: table.vector("normal", DVec3::Z)?,
                };
                valid(table, half.validate())?;
                (AnyField::new(half), SolidSurface::Plane(half))
            }
        };
        let boundary = BoundaryParameters {
            ramp_width: table.number("ramp_width", None, ANY)?,
            anchor: table.optional_vector("anchor")?,
            path: read_path(table)?,
        };
        boundary.validate().map_err(|error| fault(table, &error))?;
        let drawn = table.flag("drawn", true)?;
        let albedo = table.vector("albedo", DVec3::splat(0.5))?.to_array();
        require_color(table, "albedo", albedo)?;
        Ok(Self { shape, boundary, surface, drawn, albedo })
    }
}

impl Solid {
    /// A box around all places where it is, if it ends somewhere.
    pub(super) fn bounds(&self) -> Option<Bounds> {
        self.surface.bounds().map(|bounds| bounds.along(self.boundary.path.as_ref()))
    }
}

fn read_ends(table: &mut Settings<'_>) -> Result<[DVec3; 2], Box<Failure>> {
    let wanted = "an array of two points, such as [[0, 0, 0], [0, 0, 1]]";
    let rows: Vec<[f64; 3]> = table.rows("ends", wanted, false)?;
    let [a, b] = rows[..] else {
        return Err(
            table.bad("ends", format!("`ends` is an array of {}, and {wanted} is wanted", rows.len()))
        );
    };
    Ok([a, b].map(DVec3::from_array))
}

/// A fault at the key that an error names.
fn valid(table: &Settings<'_>, valid: Result<(), FieldError>) -> Result<(), Box<Failure>> {
    valid.map_err(|error| {
        let key = match error {
            FieldError::Parameter { parameter, .. } => parameter,
            _ => "kind",
        };
        table.bad(key, error.to_string())
    })
}
