//! What is looked at: [`Scene`], with its [`Medium`], [`Light`] and [`Solid`]s.

use glam::DVec3;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};

use super::{Camera, RenderError};

/// Smoke inside a closed surface, solid objects, a light, a camera.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The surface that encloses the smoke. It may intersect itself and be inside out; [`InteriorRule`] tells
    /// what is smoke.
    pub smoke: &'a ClosedOrientedMesh,
    /// Time since emission, one number a vertex of `smoke`, from 0 to the largest of single precision; or
    /// empty, which means 0 everywhere.
    pub ages: &'a [f64],
    /// What is not smoke.
    pub solids: &'a [Solid<'a>],
    /// From where it is seen.
    pub camera: Camera,
    /// What it is lit by.
    pub light: Light,
    /// What the smoke is like.
    pub medium: Medium,
    /// Radiance seen where nothing is (red, green, blue), each from 0 to 2^40.
    pub background: [f64; 3],
}

impl Scene<'_> {
    /// Whether all of the scene is in range.
    ///
    /// # Errors
    /// [`RenderError`] with the first fault.
    pub fn validate(&self) -> Result<(), RenderError> {
        let vertices = self.smoke.positions().len();
        if !self.ages.is_empty() && self.ages.len() != vertices {
            return Err(RenderError::AgeCount { vertices, ages: self.ages.len() });
        }
        if let Some(vertex) = self.ages.iter().position(|age| !(0.0..=f64::from(f32::MAX)).contains(age)) {
            return Err(RenderError::Age { vertex, age: self.ages[vertex] });
        }
        for solid in self.solids {
            RenderError::require_color("the albedo of a solid", solid.albedo)?;
        }
        RenderError::require_color("background", self.background)?;
        self.camera.validate()?;
        self.light.validate()?;
        self.medium.validate()
    }
}

/// A solid object: opaque, and diffuse with Lambert's law. Both sides of its triangles are seen; it need not
/// be closed.
#[derive(Clone, Copy, Debug)]
pub struct Solid<'a> {
    /// Its surface.
    pub mesh: &'a TriMesh,
    /// Share of the light that it throws back (red, green, blue), each from 0 to 2^40; from 0 to 1 for a real
    /// one.
    pub albedo: [f64; 3],
}

/// A light so far away that its rays are parallel, and light from everywhere besides.
///
/// Point lights are not offered: the shadow texture would have to be a pyramid with its apex in the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// The way the light travels; any length but zero.
    pub direction: DVec3,
    /// What a white diffuse surface that faces the light shows of it, and what smoke without shadow and of
    /// infinite optical depth shows of it (red, green, blue); each from 0 to 2^40.
    pub radiance: [f64; 3],
    /// The same of light that comes from everywhere and is shadowed by nothing (red, green, blue); each from
    /// 0 to 2^40.
    pub ambient: [f64; 3],
}

impl Default for Light {
    /// White, from above, the front and the left of a camera that looks along -z with y upward, and a tenth
    /// of it from everywhere.
    fn default() -> Self {
        Self { direction: DVec3::new(1.0, -2.0, -1.0), radiance: [1.0; 3], ambient: [0.1; 3] }
    }
}

impl Light {
    /// Whether all numbers are in range.
    ///
    /// # Errors
    /// [`RenderError`] with the first that is not.
    pub fn validate(&self) -> Result<(), RenderError> {
        RenderError::require_finite("the direction of the light", self.direction)?;
        if self.direction == DVec3::ZERO {
            return Err(RenderError::Direction { name: "the direction of the light", value: self.direction });
        }
        RenderError::require_color("the radiance of the light", self.radiance)?;
        RenderError::require_color("the ambient light", self.ambient)
    }
}

/// What the smoke is like, everywhere inside the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Share of the light lost per length, absorbed or scattered away; one over a length; finite, from 0 on.
    /// Through a thickness `l` the part `exp(-extinction l)` of the light goes.
    pub extinction: f64,
    /// Share of the lost light that is scattered, the same into all directions (red, green, blue); each from
    /// 0 to 1.
    pub albedo: [f64; 3],
    /// What is inside.
    pub interior: InteriorRule,
}

impl Medium {
    /// White smoke of an extinction.
    #[must_use]
    pub fn white(extinction: f64) -> Self {
        Self { extinction, albedo: [1.0; 3], interior: InteriorRule::default() }
    }

    /// Whether all numbers are in range.
    ///
    /// # Errors
    /// [`RenderError`] with the first that is not.
    pub fn validate(&self) -> Result<(), RenderError> {
        let extinction = self.extinction;
        let fits = (0.0..=f64::MAX).contains(&extinction);
        RenderError::require(fits, "extinction", extinction, "finite and not below 0")?;
        let bad = self.albedo.into_iter().find(|a| !(0.0..=1.0).contains(a));
        bad.map_or(Ok(()), |value| {
            RenderError::require(false, "the albedo of the smoke", value, "from 0 to 1")
        })
    }
}

/// How dense the smoke is where the surface winds around a point `w` times, as part of the medium's density.
///
/// The winding number is 1 inside a surface that is embedded and oriented outward, 0 outside; 2 where two
/// parts of the inside overlap, -1 in a part that has been turned inside out, other numbers in knots of both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InteriorRule {
    /// 1 if `w` is not 0. The default: smoke does not become denser by a fold of its surface, which in a flow
    /// without divergence is an error of the surface, nor vanish in a part turned inside out \[Brochu12,
    /// section 5.3\].
    #[default]
    NonZero,
    /// 1 if `w` is above 0: parts turned inside out are clear.
    Positive,
    /// 1 if `w` is odd: what overlaps is clear, inside out or not. Counting crossings without their direction
    /// gives this.
    Odd,
    /// `|w|`: overlapping parts add up, as if each were smoke of its own.
    Multiplicity,
}

impl InteriorRule {
    /// The density of a winding number.
    ///
    /// Between the integers it goes along straight lines, and so gives the mean density of a region from its
    /// mean winding number, exactly if only two consecutive winding numbers occur there.
    ///
    /// ```
    /// use welter_fluids::volume_rendering::InteriorRule;
    /// let of = |w: f64| [InteriorRule::NonZero, InteriorRule::Positive, InteriorRule::Odd, InteriorRule::Multiplicity]
    ///     .map(|rule| rule.density(w));
    /// assert_eq!(of(0.25), [0.25; 4]);
    /// assert_eq!(of(2.0), [1.0, 1.0, 0.0, 2.0]);
    /// assert_eq!(of(-1.0), [1.0, 0.0, 1.0, 1.0]);
    /// ```
    #[inline]
    #[must_use]
    pub fn density(self, winding: f64) -> f64 {
        match self {
            Self::NonZero => winding.abs().min(1.0),
            Self::Positive => winding.clamp(0.0, 1.0),
            Self::Odd => (winding - 2.0 * (0.5 * winding).round()).abs(),
            Self::Multiplicity => winding.abs(),
        }
    }
}
