//! What is found out about a volumetric mesh: [`Topology`].

use welter_meshing::volumetric::{
    BettiError, BettiLimits, Components, VolumeMesh, betti_numbers, euler_characteristics,
};
use welter_meshing::{Cancelled, Monitor};

/// Memory for Betti numbers, in bytes for each cell of any dimension.
const BYTES_A_CELL: u64 = 60;

/// How a mesh hangs together.
pub(crate) struct Topology {
    pub(super) components: Components,
    /// Pieces, tunnels, cavities; none if they take more memory or time than there is, or if nobody wants them.
    pub(super) betti: Option<[u64; 3]>,
}

impl Topology {
    /// Components and Euler characteristics; Betti numbers too if they take no more memory than `for_betti`.
    pub(super) fn of(
        volume: &VolumeMesh,
        for_betti: Option<u64>,
        monitor: &Monitor<'_>,
    ) -> Result<Self, Cancelled> {
        let components = euler_characteristics(&volume.mesh, monitor)?;
        let mut limits = BettiLimits::default();
        if let Some(bytes) = for_betti {
            limits.most_cells = limits.most_cells.min(bytes / BYTES_A_CELL);
        }
        if components.total().total() > limits.most_cells {
            return Ok(Self { components, betti: None });
        }
        let betti = match betti_numbers(&volume.mesh, &limits, monitor) {
            // There is no fourth: a closed hypersurface of sheets would be a fault that the Euler characteristic shows.
            Ok(numbers) => {
                Some(numbers.total()).map(|[pieces, tunnels, cavities, _]| [pieces, tunnels, cavities])
            }
            Err(BettiError::Cancelled(cancelled)) => return Err(cancelled),
            Err(_) => None,
        };
        Ok(Self { components, betti })
    }

    pub(super) fn euler_characteristic(&self) -> i64 {
        self.components.total().euler_characteristic()
    }
}
