//! [`VolumeParameters`]: how fine, how large, how often refined.

use super::VolumeError;

/// The size of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Resolution {
    /// Length of a cell's edge; rounded to 24 significant bits, so that all nodes are exact.
    Spacing(f64),
    /// Cells along the shortest side of the surface's bounding box, as in Table 3.1 of \[Gagniere22\].
    ShortestSide(u32),
}

/// Parameters of a volumetric mesh.
///
/// ```
/// use welter_meshing::volumetric::{Resolution, VolumeParameters};
/// let parameters = VolumeParameters { resolution: Resolution::Spacing(0.05), ..VolumeParameters::default() };
/// assert!(parameters.validate().is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VolumeParameters {
    /// The size of cells. The default is 63 along the shortest side, that of most examples of \[Gagniere22\].
    pub resolution: Resolution,
    /// How often cells may be halved where features are too fine for them; the mesh is coarsened again afterwards. The default, 3,
    /// is 512 times the cells.
    pub max_refinements: u32,
    /// Most cells of the grid, counted over its whole box, at any refinement. The default is 2^32.
    pub max_cells: u64,
    /// How often the mesh is coarsened by doubling, beyond what undoes refinements; less often where a larger hexahedron would change the
    /// topology, or hold two of the sheets that lie over one another. The default is 0.
    pub coarsenings: u32,
    /// Whether cells are also halved where Euler characteristics, summed over all components, tell that a tunnel or a gap lies within one. The
    /// default is yes. [`verify`](super::verify) compares them component by component.
    pub check_topology: bool,
}

impl Default for VolumeParameters {
    fn default() -> Self {
        Self {
            resolution: Resolution::ShortestSide(63),
            max_refinements: 3,
            max_cells: 1 << 32,
            coarsenings: 0,
            check_topology: true,
        }
    }
}

impl VolumeParameters {
    /// Whether all parameters are within their ranges.
    ///
    /// # Errors
    /// [`VolumeError::Parameter`] for the first that is not.
    pub fn validate(&self) -> Result<(), VolumeError> {
        let refused = |name, value, range| Err(VolumeError::Parameter { name, value, range });
        match self.resolution {
            Resolution::Spacing(h) if !(h.is_finite() && h > 0.0) => {
                refused("spacing", h, "a positive length")
            }
            Resolution::ShortestSide(0) => refused("cells along the shortest side", 0.0, "at least 1"),
            _ if self.max_refinements > 16 => {
                refused("refinements", f64::from(self.max_refinements), "at most 16")
            }
            _ if self.coarsenings > 16 => refused("coarsenings", f64::from(self.coarsenings), "at most 16"),
            _ => Ok(()),
        }
    }
}
