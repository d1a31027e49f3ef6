//! What is the same in all pictures of a run, and the pictures: [`Studio`].

use super::files::{PLANES, exr, png};
use super::{RenderSpec, files};
use crate::codes::Code;
use crate::commands::sim::bounds::Bounds;
use crate::commands::sim::solids::Solid;
use crate::failure::Failure;
use crate::runs::{PictureProblem, Pictures};
use serde_json::{Value, json};
use std::time::Instant;
use welter_fluids::procedural::Path;
use welter_fluids::smoke::{ClosedSmoke, Emission, EmittedShape};
use welter_fluids::volume_rendering::{self, Camera, RenderError, Scene, render};
use welter_meshing::Monitor;
use welter_meshing::surface::{ClosedOrientedMesh, TriMesh};

/// Everything but the smoke.
#[derive(Clone, Debug)]
pub(in crate::commands::sim) struct Studio {
    spec: RenderSpec,
    camera: Camera,
    solids: Vec<Drawn>,
}

/// A solid as it is drawn.
#[derive(Clone, Debug)]
struct Drawn {
    mesh: TriMesh,
    path: Option<Path>,
    albedo: [f64; 3],
}

impl Studio {
    /// For the smoke of some emissions; `bounds` are those of flows, as far as they have any.
    pub(in crate::commands::sim) fn new(
        spec: &RenderSpec,
        emissions: &[Emission],
        bounds: &[Bounds],
        solids: &[Solid],
    ) -> Result<Self, Box<Failure>> {
        let open = emissions.iter().position(|emission| matches!(emission.shape, EmittedShape::Open(_)));
        if let (Some(open), None) = (open, &spec.layer) {
            return Err(Failure::new(
                Code::BadValue,
                "an open sheet encloses no smoke: for a picture it needs a thickness",
            )
            .subject(format!("emissions[{open}]"))
            .help("layer_thickness = 0.2   # in the table [render], a length of the scene"));
        }
        let released = emissions.iter().filter_map(|emission| {
            let points = emission.shape.mesh().positions().iter().copied();
            let bounds = Bounds::of(points)?.along(emission.path.as_ref());
            // A layer is as deep on one side, which may be any once the sheet has turned over.
            let depth = match (&emission.shape, &spec.layer) {
                (EmittedShape::Open(_), Some(layer)) => layer.thickness,
                _ => 0.0,
            };
            Some(bounds.grown(depth))
        });
        let known = released.chain(bounds.iter().copied()).chain(solids.iter().filter_map(Solid::bounds));
        let known = known.reduce(Bounds::joined).unwrap_or(Bounds::around(glam::DVec3::ZERO, 1.0));
        let camera = spec.camera.camera(known, [spec.parameters.width, spec.parameters.height]);
        camera.validate().map_err(|error| {
            Failure::new(Code::BadValue, error.to_string())
                .subject("the camera of the scene")
                .help("box = [[-1, -1, 0], [1, 1, 3]]   # in the table [render.camera]: what is to be seen")
        })?;
        // Planes are drawn as far as one would notice their end only beside the picture.
        let horizon = 8.0 * (known.diagonal() + camera.eye.distance(known.middle()));
        let mut drawn = Vec::new();
        for solid in solids.iter().filter(|solid| solid.drawn) {
            let mesh = solid.surface.mesh(known.middle(), horizon).map_err(|error| {
                Failure::new(Code::BadValue, error.to_string())
                    .subject("a solid of the scene")
                    .help("drawn = false   # in its table [[solids]]")
            })?;
            drawn.push(Drawn { mesh, path: solid.boundary.path.clone(), albedo: solid.albedo });
        }
        Ok(Self { spec: spec.clone(), camera, solids: drawn })
    }

    /// Whether a frame has pictures.
    pub(in crate::commands::sim) fn draws(&self, frame: u64) -> bool {
        self.spec.frames.contains(frame)
    }

    /// The pictures of a surface with the ages of its vertices, at a time.
    pub(in crate::commands::sim) fn draw(
        &self,
        mesh: &TriMesh,
        ages: &[f64],
        time: f64,
        monitor: &Monitor<'_>,
    ) -> Result<Pictures, PictureProblem> {
        let failed = |what: String| {
            PictureProblem::Failed(
                Failure::new(Code::BadValue, what)
                    .subject(format!("the picture at time {time}"))
                    .help("--set render.enabled=false   # a run without pictures"),
            )
        };
        let start = Instant::now();
        let smoke = self.closed(mesh, ages).map_err(failed)?;
        let meshes: Vec<TriMesh> =
            self.solids.iter().map(|solid| solid.at(time)).collect::<Result<_, _>>().map_err(failed)?;
        let pairs = meshes.iter().zip(&self.solids);
        let solids: Vec<volume_rendering::Solid<'_>> =
            pairs.map(|(mesh, solid)| volume_rendering::Solid { mesh, albedo: solid.albedo }).collect();
        let scene = Scene {
            smoke: &smoke.surface,
            ages: &smoke.ages,
            solids: &solids,
            camera: self.camera,
            light: self.spec.light,
            medium: self.spec.medium,
            background: self.spec.background,
        };
        let closing = start.elapsed().as_secs_f64();
        let (picture, report) =
            render(&scene, &self.spec.parameters, monitor).map_err(|error| match error {
                RenderError::Cancelled(_) => PictureProblem::Cancelled,
                error => failed(error.to_string()),
            })?;
        let rendered = start.elapsed().as_secs_f64();
        let files = self.files(&picture).map_err(|error| failed(error.to_string()))?;
        let total = start.elapsed().as_secs_f64();
        let told = json!({
            "triangles": smoke.surface.triangles().len(),
            "crossings": report.crossings,
            "most_crossings": report.most_crossings,
            "covered_pixels": report.covered_pixels,
            "pixels_from_inside": report.pixels_from_inside,
            "shadow_size": report.shadow_size,
        });
        let seconds = json!({
            "layers": closing,
            "shadow": report.seconds.shadow,
            "projection": report.seconds.projection,
            "pixels": report.seconds.pixels,
            "composition": report.seconds.composition,
            "encoding": total - rendered,
            "total": total,
        });
        let (Value::Object(told), Value::Object(seconds)) = (told, seconds) else {
            unreachable!("objects were written")
        };
        Ok(Pictures { files, told, seconds })
    }

    /// The surface, with sheets as layers.
    fn closed(&self, mesh: &TriMesh, ages: &[f64]) -> Result<ClosedSmoke, String> {
        match &self.spec.layer {
            Some(layer) => layer.close(mesh, ages).map_err(|error| error.to_string()),
            None => {
                let surface = ClosedOrientedMesh::new(mesh.clone()).map_err(|error| error.to_string())?;
                Ok(ClosedSmoke { surface, ages: ages.to_vec() })
            }
        }
    }

    fn files(&self, picture: &volume_rendering::Picture) -> std::io::Result<Vec<(&'static str, Vec<u8>)>> {
        let spec = &self.spec;
        let mut files = Vec::new();
        for (name, plane) in PLANES.iter().filter(|(_, plane)| spec.png.contains(plane)) {
            files.push((*name, png(picture, *plane, spec.color_bits, spec.age_white)?));
        }
        if !spec.exr.is_empty() {
            files.push((files::EXR, exr(picture, &spec.exr, spec.half)?));
        }
        Ok(files)
    }
}

impl Drawn {
    /// Where it is at a time.
    fn at(&self, time: f64) -> Result<TriMesh, String> {
        let Some(path) = &self.path else { return Ok(self.mesh.clone()) };
        let displacement = path.at(time);
        let mut soup = self.mesh.to_soup();
        soup.positions.iter_mut().for_each(|position| *position += displacement);
        TriMesh::new(soup).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use crate::commands::sim::bounds::Bounds;
    use crate::commands::sim::scene::SimScene;
    use crate::progress::{Progress, ProgressMode};
    use crate::scene::Scene;
    use glam::DVec3;

    const SCENE: &str = "[[emissions]]\nshape = \"sheet\"\n[[emissions]]\nshape = \"sphere\"\nedge_length = 0.5\n\
        path = [[0, 0, 0, 0], [1, 0, 4, 0]]\n[[flows]]\nkind = \"ring\"\nradius = 2\ncenter = [0, 0, 1]\n\
        path = [[0, 0, 0, 0], [5, 0, 0, 7]]\n[[flows]]\nkind = \"wind\"\nvelocity = [0, 0, 9]\n[[solids]]\nkind = \"ball\"\n\
        radius = 0.5\nramp_width = 1\ncenter = [-3, 0, 0]\npath = [[0, 0, 0, 0], [1, 1, 0, 0]]\n[[solids]]\nkind = \"half-space\"\n\
        ramp_width = 1\npoint = [0, 0, -3]\ndrawn = false\n[time]\nstep = 0.5\nsteps = 4\n[render]\nextinction = 1\n\
        layer_thickness = 2.5\nsize = [200, 100]\n[render.camera]\nfill = 0.75\n";

    #[test]
    fn all_that_is_known_beforehand_is_in_the_picture_and_solids_go_their_way() {
        let (scene, _) = SimScene::read(&Scene::of("a.toml", SCENE), 0).unwrap();
        let emissions = scene.emissions(&Progress::new(ProgressMode::None, true)).unwrap();
        let studio = scene.studio(&emissions).unwrap().unwrap();
        // The ring reaches up to 8 + 2, the layer down to -2.5, the ball to -3.5, the emitter as far as its polyhedron.
        let puff = Bounds::of(emissions[1].shape.mesh().positions().iter().copied()).unwrap();
        let high = DVec3::new(3.0, 4.0 + puff.high.y, 10.0);
        let known = Bounds { low: DVec3::new(-3.5, -3.0, -2.5), high };
        assert!(studio.camera.target.distance(known.middle()) < 1e-9, "{}", studio.camera.target);
        let forward = (studio.camera.target - studio.camera.eye).normalize();
        let right = forward.cross(DVec3::Z).normalize();
        let top = right.cross(forward);
        let slope = (0.5 * studio.camera.vertical_field_of_view).tan();
        let most = known.corners().map(|corner| {
            let p = corner - studio.camera.eye;
            let [x, y] = [p.dot(right), p.dot(top)].map(|c| (c / p.dot(forward)).abs() / slope);
            (0.5 * x).max(y)
        });
        assert!((most.into_iter().fold(0.0, f64::max) - 0.75).abs() < 1e-9, "{most:?}");
        assert_eq!(studio.solids.len(), 1, "the plane is not drawn");
        for (time, x) in [(0.0, -3.0), (1.0, -2.0), (3.0, -2.0)] {
            let mesh = studio.solids[0].at(time).unwrap();
            let bounds = Bounds::of(mesh.positions().iter().copied()).unwrap();
            assert!((bounds.middle() - DVec3::new(x, 0.0, 0.0)).length() < 1e-12, "{bounds:?}");
        }
    }
}
