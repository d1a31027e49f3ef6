//! A surface meshed as the command does it if nothing is asked for, for other commands: [`Meshed`].

use super::facts::Facts;
use super::findings::Topology;
use super::product::{Boundary, Product};
use super::refused::code_of;
use super::volume_file::{VolumeFormat, VolumeWriting};
use crate::codes::Code;
use crate::console::Seconds;
use crate::cutaway::{self, Cutaway};
use crate::failure::Failure;
use crate::machine;
use crate::output::Output;
use crate::render::Image;
use crate::run::Run;
use welter_meshing::Monitor;
use welter_meshing::io::MshVersion;
use welter_meshing::surface::ClosedOrientedMesh;
use welter_meshing::surface::measure::signed_volume;
use welter_meshing::volumetric::{Resolution, Verification, VolumeParameters, mesh_volume, verify};

/// A mesh of hexahedra, verified.
pub(crate) struct Meshed {
    product: Product,
    topology: Topology,
    verification: Verification,
    surface_volume: f64,
}

impl Meshed {
    /// With so many cells along the shortest side.
    pub(crate) fn of(
        surface: &ClosedOrientedMesh,
        cells: u32,
        name: &str,
        run: &Run,
        seconds: &mut Seconds,
    ) -> Result<Self, Box<Failure>> {
        let console = &run.console;
        let report = |p: welter_meshing::Progress| console.progress.report(p.stage, p.done, p.total);
        let monitor = Monitor::new(Some(&report), None);
        let stopped = |_| Failure::new(Code::Interrupted, "the work was stopped");
        let parameters =
            VolumeParameters { resolution: Resolution::ShortestSide(cells), ..VolumeParameters::default() };
        let volume = console
            .stage(seconds, "meshing", || mesh_volume(surface, &parameters, &monitor))
            .map_err(|error| {
                Failure::new(code_of(&error), error.to_string()).subject(name).help(format!(
                    "welter shape {name} -o {name}.ply   # then: welter mesh {name}.ply -o {name}.vtu"
                ))
            })?;
        let free = machine::available_memory();
        let topology =
            console.stage(seconds, "topology", || Topology::of(&volume, free, &monitor)).map_err(stopped)?;
        let verification =
            console.stage(seconds, "verifying", || verify(surface, &volume, &monitor)).map_err(stopped)?;
        let components = topology.components.labels().of().to_vec();
        let product = Product { volume, tetrahedra: None, components };
        Ok(Self { product, topology, verification, surface_volume: signed_volume(surface) })
    }

    pub(crate) fn facts(&self) -> Facts<'_> {
        Facts {
            product: &self.product,
            topology: Some(&self.topology),
            verification: Some(&self.verification),
            surface_volume: self.surface_volume,
        }
    }

    /// A picture, cut open where the most sheets lie over one another.
    pub(crate) fn draw(
        &self,
        title: &str,
        size: [u32; 2],
        run: &Run,
        seconds: &mut Seconds,
    ) -> Result<Image, Box<Failure>> {
        let mesh = &self.product.volume.mesh;
        let (components, cut) =
            (&self.product.components[..], cutaway::through_overlap(&self.product.volume));
        let view = Cutaway { mesh, components, cut, camera: None, size, title };
        cutaway::draw(&view, run, seconds, &Monitor::none()).map_err(cutaway::Problem::into_failure)
    }

    /// Writes it as VTU.
    pub(crate) fn write(&self, output: Output) -> Result<(), Box<Failure>> {
        let writing = VolumeWriting {
            format: VolumeFormat::Vtu,
            msh: MshVersion::V4,
            ascii: false,
            with_boundary: false,
        };
        writing.write(output, &self.product, &Boundary::default()).map(drop)
    }
}
