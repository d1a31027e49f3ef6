//! What resolution may do: [`IntegrationParameters`].

use super::IntegrationError;

/// How collisions are resolved. Any values in range keep the surface free of intersections; they change how well the
/// predicted motion is followed, and at what cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IntegrationParameters {
    /// Whether the surface is proven embedded before anything is done. Without it a surface that is not
    /// is found out only if it is not so after the step either. Costs as much as the check of the ends. Default: true; a
    /// caller that has only positions that were accepted, and changes that were checked, may switch it off.
    pub check_start: bool,
    /// Distance below which elements repel each other, as part of the reference length; from 0 (no repulsion) to 1. Default:
    /// 1e-3, well below the shortest edges that remeshing leaves (a third to a half of the reference length), so that
    /// neighbours on a smooth surface do not repel each other, and well above the rounding of coordinates.
    pub proximity_rel: f64,
    /// Coefficient of Coulomb friction wherever an impulse acts; from 0, finite. Default: 0: fluids and geometric flows know none.
    pub friction: f64,
    /// Sweeps of single impulses. Default: 3 \[Brochu12, section 3.2.7\].
    pub sweeps: u32,
    /// Rounds in which impact zones are solved and may grow. Default: 12, chosen by trial on stacked sheets.
    pub zone_rounds: u32,
    /// The most collisions that one impact zone solves for; a larger one moves rigidly. Default: 8192, chosen by trial: two
    /// sheets of 5,760 triangles on each other end without rigid zones.
    pub most_zone_collisions: u32,
    /// Rounds in which rigid zones may grow. Default: 12, as `zone_rounds`.
    pub rigid_rounds: u32,
    /// How often the step is halved, and everything tried again, before vertices that still collide stay where they are.
    /// At most 64. Default: 3: what does not end in an eighth of a step is jammed rather than fast.
    pub most_halvings: u32,
    /// More collisions than so many times the number of vertices, or what would take as long to find out, are not resolved; the step is
    /// shortened at once, to some lengths of an edge. At least 1. Default: 32, twice what stacked sheets have that
    /// slide by an edge length (14): each vertex meets one or two triangles, each edge a few.
    pub most_collisions_per_vertex: u32,
}

impl Default for IntegrationParameters {
    fn default() -> Self {
        Self {
            check_start: true,
            proximity_rel: 1e-3,
            friction: 0.0,
            sweeps: 3,
            zone_rounds: 12,
            most_zone_collisions: 8192,
            rigid_rounds: 12,
            most_halvings: 3,
            most_collisions_per_vertex: 32,
        }
    }
}

impl IntegrationParameters {
    /// Whether all parameters are in range.
    ///
    /// # Errors
    /// [`IntegrationError::Parameter`] with the first that is not.
    pub fn validate(&self) -> Result<(), IntegrationError> {
        let require = |holds: bool, parameter, value, range| {
            if holds { Ok(()) } else { Err(IntegrationError::Parameter { parameter, value, range }) }
        };
        let proximity = (0.0..=1.0).contains(&self.proximity_rel);
        require(
            proximity,
            "proximity_rel",
            self.proximity_rel,
            "a part of the reference length, from 0 to 1",
        )?;
        let friction = (0.0..=f64::MAX).contains(&self.friction);
        require(friction, "friction", self.friction, "finite and not below 0")?;
        let halvings = self.most_halvings <= 64;
        require(halvings, "most_halvings", f64::from(self.most_halvings), "at most 64")?;
        let crowd = self.most_collisions_per_vertex;
        require(crowd >= 1, "most_collisions_per_vertex", f64::from(crowd), "at least 1")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_out_of_range_are_named() {
        let refused = |change: fn(&mut IntegrationParameters)| {
            let mut parameters = IntegrationParameters::default();
            parameters.validate().unwrap();
            change(&mut parameters);
            match parameters.validate() {
                Err(IntegrationError::Parameter { parameter, .. }) => parameter,
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(refused(|p| p.proximity_rel = f64::NAN), "proximity_rel");
        assert_eq!(refused(|p| p.proximity_rel = 1.5), "proximity_rel");
        assert_eq!(refused(|p| p.friction = -0.1), "friction");
        assert_eq!(refused(|p| p.friction = f64::INFINITY), "friction");
        assert_eq!(refused(|p| p.most_halvings = 65), "most_halvings");
        assert_eq!(refused(|p| p.most_collisions_per_vertex = 0), "most_collisions_per_vertex");
    }
}
