//! From the table `[field]` of a scene to a field.

use crate::codes::Code;
use crate::failure::Failure;
use crate::scene::{Entry, Section};
use glam::{DMat3, DVec3};
use std::collections::BTreeMap;
use std::path::PathBuf;
use welter_meshing::distance::InsideRule;
use welter_meshing::field::*;
use welter_meshing::surface::ClosedOrientedMesh;

/// Tables within tables; more would be a mistake, and ends before the stack does.
const MAX_DEPTH: usize = 60;

/// Every kind of field, and the keys that it has beside those of all.
const KINDS: [(&str, &[&str]); 20] = [
    ("ball", &["center", "radius"]),
    ("box", &["min", "max", "rounding"]),
    ("torus", &["center", "axis", "radius", "tube_radius"]),
    ("capsule", &["ends", "radius"]),
    ("cylinder", &["ends", "radius"]),
    ("ellipsoid", &["center", "semi_axes"]),
    ("half-space", &["point", "normal"]),
    ("gyroid", &["period", "thickness"]),
    ("text", &["words", "height", "pen_radius", "depth", "caps"]),
    ("mesh", &["file", "inside"]),
    ("union", &["parts", "blend_width"]),
    ("intersection", &["parts", "blend_width"]),
    ("difference", &["from", "removed", "blend_width"]),
    ("offset", &["field", "distance"]),
    ("shell", &["field", "thickness"]),
    ("complement", &["field"]),
    ("affine", &["field", "matrix"]),
    ("displaced", &["field", "amplitude", "seed", "wavelength", "octaves", "gain", "lacunarity"]),
    ("noise", &["seed", "wavelength", "octaves", "gain", "lacunarity"]),
    ("constant", &["value"]),
];

/// Keys of every kind: a field is scaled, then rotated, then moved.
const PLACING: [&str; 4] = ["kind", "scale", "rotate", "translate"];

/// Meshes by their names in the scene.
pub(super) type Meshes = BTreeMap<PathBuf, ClosedOrientedMesh>;

/// Builds the tree of fields. Without meshes yet, everything else is checked and the names of their files are gathered.
pub(super) struct Builder<'m> {
    pub(super) meshes: Option<&'m Meshes>,
    pub(super) files: Vec<PathBuf>,
}

impl<'m> Builder<'m> {
    pub(super) fn build(&mut self, entry: &Entry<'_>) -> Result<AnyField<'m>, Box<Failure>> {
        self.node(entry, 0)
    }

    fn node(&mut self, entry: &Entry<'_>, depth: usize) -> Result<AnyField<'m>, Box<Failure>> {
        if depth > MAX_DEPTH {
            return Err(entry.bad("at most 60 fields within each other"));
        }
        let section = entry.section()?;
        let kinds: Vec<(&str, usize)> = KINDS.iter().enumerate().map(|(k, (name, _))| (*name, k)).collect();
        let (kind, keys) = KINDS[section.required("kind")?.choice(&kinds)?];
        section.only(&[&PLACING[..], keys].concat())?;
        let field = self.of_kind(kind, &section, depth)?;
        placed(field, &section)
    }

    fn of_kind(&mut self, kind: &str, s: &Section<'_>, depth: usize) -> Result<AnyField<'m>, Box<Failure>> {
        /// Checks a field and shares it.
        macro_rules! checked {
            ($field:expr) => {{
                let field = $field;
                field.validate().map_err(|error| refused(s, &error))?;
                Ok(AnyField::new(field))
            }};
        }
        match kind {
            "ball" => checked!(Ball {
                center: s.vector("center", DVec3::ZERO)?,
                radius: s.required("radius")?.number()?
            }),
            "box" => checked!(Cuboid {
                min: s.required("min")?.vector()?,
                max: s.required("max")?.vector()?,
                rounding: s.number("rounding", 0.0)?,
            }),
            "torus" => checked!(Torus {
                center: s.vector("center", DVec3::ZERO)?,
                axis: s.vector("axis", DVec3::Z)?,
                radius: s.required("radius")?.number()?,
                tube_radius: s.required("tube_radius")?.number()?,
            }),
            "capsule" => checked!(Capsule { ends: ends(s)?, radius: s.required("radius")?.number()? }),
            "cylinder" => checked!(Cylinder { ends: ends(s)?, radius: s.required("radius")?.number()? }),
            "ellipsoid" => checked!(Ellipsoid {
                center: s.vector("center", DVec3::ZERO)?,
                semi_axes: s.required("semi_axes")?.vector()?,
            }),
            "half-space" => checked!(HalfSpace {
                point: s.vector("point", DVec3::ZERO)?,
                normal: s.required("normal")?.vector()?,
            }),
            "gyroid" => checked!(Gyroid {
                period: s.required("period")?.number()?,
                thickness: s.number("thickness", 0.0)?,
            }),
            "text" => text(s),
            "mesh" => self.mesh(s),
            "union" => {
                checked!(Union { parts: self.parts(s, depth)?, blend_width: s.number("blend_width", 0.0)? })
            }
            "intersection" => {
                checked!(Intersection {
                    parts: self.parts(s, depth)?,
                    blend_width: s.number("blend_width", 0.0)?
                })
            }
            "difference" => checked!(Difference {
                from: self.node(&s.required("from")?, depth + 1)?,
                removed: self.node(&s.required("removed")?, depth + 1)?,
                blend_width: s.number("blend_width", 0.0)?,
            }),
            "offset" => {
                checked!(Offset { field: self.inner(s, depth)?, distance: s.required("distance")?.number()? })
            }
            "shell" => checked!(Shell {
                field: self.inner(s, depth)?,
                thickness: s.required("thickness")?.number()?
            }),
            "complement" => Ok(AnyField::new(Complement { field: self.inner(s, depth)? })),
            "affine" => {
                let rows = s.required("matrix")?.vectors::<3>("an array of three rows of three numbers")?;
                let matrix = DMat3::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose();
                let field = Affine::new(self.inner(s, depth)?, matrix, DVec3::ZERO);
                field.map(AnyField::new).map_err(|error| refused(s, &error))
            }
            "displaced" => checked!(Displaced {
                field: self.inner(s, depth)?,
                noise: noise(s)?,
                amplitude: s.required("amplitude")?.number()?,
            }),
            "noise" => checked!(noise(s)?),
            _ => {
                let value = s.required("value")?.number()?;
                Ok(AnyField::new(move |_: DVec3| value))
            }
        }
    }

    fn inner(&mut self, s: &Section<'_>, depth: usize) -> Result<AnyField<'m>, Box<Failure>> {
        self.node(&s.required("field")?, depth + 1)
    }

    fn parts(&mut self, s: &Section<'_>, depth: usize) -> Result<Vec<AnyField<'m>>, Box<Failure>> {
        s.required("parts")?.list()?.iter().map(|part| self.node(part, depth + 1)).collect()
    }

    fn mesh(&mut self, s: &Section<'_>) -> Result<AnyField<'m>, Box<Failure>> {
        let file = PathBuf::from(s.required("file")?.text()?);
        let inside =
            [("nonzero", InsideRule::NonZero), ("positive", InsideRule::Positive), ("odd", InsideRule::Odd)];
        let inside = s.choice("inside", &inside)?;
        let Some(meshes) = self.meshes else {
            self.files.push(file);
            return Ok(AnyField::new(|_: DVec3| f64::NAN));
        };
        match meshes.get(&file) {
            Some(mesh) => Ok(AnyField::new(MeshDistance::new(mesh, inside))),
            None => Err(Failure::new(Code::OwnBug, "a mesh of the scene was not read")),
        }
    }
}

/// The failure for parameters out of range, at the key at fault.
fn refused(s: &Section<'_>, error: &FieldError) -> Box<Failure> {
    let key = match error {
        FieldError::Parameter { parameter, .. } => parameter,
        FieldError::Singular { .. } => "matrix",
        _ => "words",
    };
    s.bad(key, error.to_string())
}

fn ends(s: &Section<'_>) -> Result<[DVec3; 2], Box<Failure>> {
    s.required("ends")?.vectors::<2>("an array of two points")
}

fn text(s: &Section<'_>) -> Result<AnyField<'static>, Box<Failure>> {
    let default = TextShape::default();
    let shape = TextShape {
        words: s.required("words")?.text()?.to_owned(),
        height: s.number("height", default.height)?,
        pen_radius: s.number("pen_radius", default.pen_radius)?,
        depth: s.number("depth", default.depth)?,
        caps: s.choice("caps", &[("flat", Caps::Flat), ("rounded", Caps::Rounded)])?,
    };
    Text::new(&shape).map(AnyField::new).map_err(|error| refused(s, &error))
}

fn noise(s: &Section<'_>) -> Result<FractalNoise, Box<Failure>> {
    let default = FractalNoise::default();
    let octaves = s.whole_number("octaves", u64::from(default.octaves))?;
    Ok(FractalNoise {
        seed: s.whole_number("seed", default.seed)?,
        wavelength: s.number("wavelength", default.wavelength)?,
        octaves: u32::try_from(octaves).unwrap_or(u32::MAX),
        gain: s.number("gain", default.gain)?,
        lacunarity: s.number("lacunarity", default.lacunarity)?,
    })
}

/// The field where the keys of all kinds put it.
fn placed<'m>(field: AnyField<'m>, s: &Section<'_>) -> Result<AnyField<'m>, Box<Failure>> {
    if ["scale", "rotate", "translate"].iter().all(|key| s.get(key).is_none()) {
        return Ok(field);
    }
    let mut placed = Placed::of(field);
    placed.scale = s.number("scale", 1.0)?;
    placed.translation = s.vector("translate", DVec3::ZERO)?;
    if let Some(rotation) = s.get("rotate") {
        let rotation = rotation.section()?;
        rotation.only(&["axis", "degrees"])?;
        let axis = rotation.required("axis")?.vector()?;
        let degrees = rotation.required("degrees")?.number()?;
        if !(axis.is_finite() && axis != DVec3::ZERO && degrees.is_finite()) {
            return Err(rotation.bad("axis", "a rotation needs an axis with a direction and finite degrees"));
        }
        placed.rotation = rotation_about(axis, degrees);
    }
    placed.validate().map_err(|error| refused(s, &error))?;
    Ok(AnyField::new(placed))
}
