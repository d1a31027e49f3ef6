//! The mesh of a body, compared with what the body's own connectivity says: [`outcome`], and many of them in a [`Tally`].

use std::collections::BTreeMap;

use welter_kit::mesher::bodies::Body;
use welter_kit::mesher::{Complex, Random, Unfolded, check, equals_unfolded};
use welter_meshing::DVec3;
use welter_meshing::Monitor;
use welter_meshing::distance::grid_winding_numbers;
use welter_meshing::grid::Grid3;
use welter_meshing::spatial::{Winding, WindingNumbers};
use welter_meshing::surface::{ClosedOrientedMesh, TriId};
use welter_meshing::volumetric::{Place, Resolution, VolumeError, VolumeMesh, VolumeParameters, mesh_volume};

/// A number from the environment, such as `WELTER_MESHER_SEEDS`, how many seeds.
pub(super) fn number_from(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().map_or(otherwise, |text| text.parse().expect("a number"))
}

/// How good an outcome is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Class {
    /// The mesh of the body.
    AsUnfolded,
    /// The body is not immersed, and there is a mesh of its surface all the same, which passes all checks.
    Otherwise,
    /// The surface winds a negative number of times around a point, which was found by other means.
    Negative,
    /// Cells were too large at each size that was allowed.
    UnderResolved,
    /// Cells were too large for the mesher at each size, though the body's own hexahedra are as many on each cell as it is deep there
    /// already with cells of the size asked for: the search for copies took a way to tell them apart that is not the body's.
    Missed,
    /// The surface bounds several volumes, and the mesh is that of another one than the body.
    Ambiguous,
    /// The mesh or the error is wrong.
    Wrong,
}

/// What became of a seed.
pub(super) struct Outcome {
    pub(super) class: Class,
    /// Whether the body is immersed, so that there is a mesh.
    pub(super) immersed: bool,
    /// The most sheets over one another in the mesh.
    pub(super) sheets: i32,
    pub(super) kind: String,
    pub(super) note: String,
}

impl Outcome {
    /// With a word before the kind.
    pub(super) fn of(mut self, group: &str) -> Self {
        self.kind = format!("{group}: {}", self.kind);
        self
    }
}

/// Cells that the seed makes small or large.
pub(super) fn parameters(body: &Body, seed: u64, max_refinements: u32) -> VolumeParameters {
    let share = 0.3 + 0.6 * (seed % 7) as f64 / 6.0;
    let positions = &body.solid.positions;
    let low = positions.iter().copied().reduce(|a, b| a.min(b)).unwrap();
    let high = positions.iter().copied().reduce(|a, b| a.max(b)).unwrap();
    let budget = number_from("WELTER_MESHER_CELLS", 60_000) as f64;
    let spacing = (body.radius * share).max(((high - low).element_product() / budget).cbrt());
    VolumeParameters {
        resolution: Resolution::Spacing(spacing),
        max_refinements,
        ..VolumeParameters::default()
    }
}

/// Meshes a body, on cells that its seed makes small or large, and compares.
pub(super) fn outcome(body: &Body, seed: u64, max_refinements: u32) -> Outcome {
    let surface = body.solid.surface();
    let upright = body.solid.inverted() == 0;
    let outcome = |class: Class, sheets: i32, kind: &str, note: String| {
        // To look for folds takes longer, and where the mesh is that of the body there are none.
        let folded = if class == Class::AsUnfolded { None } else { body.solid.folded_vertex() };
        let word = match folded {
            _ if !upright => "inside out somewhere, ",
            Some(_) => "folded around a vertex, ",
            None => "",
        };
        let (kind, immersed) = (format!("{word}{kind}"), word.is_empty());
        let place =
            folded.map_or(String::new(), |v| format!("; a fold at {}", body.solid.positions[v as usize]));
        Outcome { class, immersed, sheets, kind, note: format!("{}: {note}{place}", body.name) }
    };
    let volume = match mesh_volume(&surface, &parameters(body, seed, max_refinements), &Monitor::none()) {
        Ok(volume) => volume,
        Err(error @ VolumeError::Negative { place, .. }) => {
            return match negative_point(body, &surface, &place) {
                Some((point, number)) => {
                    outcome(Class::Negative, 0, "negative", format!("{number} around {point}; {error}"))
                }
                None => outcome(Class::Wrong, 0, "negative, but no such point found", error.to_string()),
            };
        }
        Err(VolumeError::UnderResolved { what, place, .. }) => {
            let why = match negative_point(body, &surface, &place).filter(|_| !upright) {
                Some((point, number)) => format!("{number} around {point}; {place}"),
                None => place.to_string(),
            };
            let refused = outcome(Class::UnderResolved, 0, &format!("under-resolved: {what}"), why);
            let missed = refused.immersed && has_all_sheets(body, &parameters(body, seed, 0));
            return Outcome { class: if missed { Class::Missed } else { refused.class }, ..refused };
        }
        Err(error) => return outcome(Class::Wrong, 0, "other error", error.to_string()),
    };
    let sheets = volume.windings.iter().copied().max().unwrap_or(0);
    let wrong = |kind: &str, fault: String| outcome(Class::Wrong, sheets, kind, fault);
    let checked = match check(&surface, &volume) {
        Ok(checked) => checked,
        Err(fault) => return wrong("check", fault),
    };
    if let Err(fault) = as_deep_as(body, &surface, &volume) {
        return wrong("depth", fault);
    }
    if !upright {
        return outcome(Class::Otherwise, sheets, "but meshed", format!("{:?}", checked.odd));
    }
    let unfolded = Unfolded::new(&body.solid, volume.mesh.grid());
    if let Err(fault) = equals_unfolded(&volume, &body.solid, &unfolded) {
        let note = format!("{} refinements: {fault}", volume.refinements);
        let differs = outcome(
            Class::Ambiguous,
            sheets,
            if volume.ambiguous { "ambiguous, differs" } else { "differs" },
            note,
        );
        // A body with a fold is not what the surface bounds, for the mesher.
        return match (volume.ambiguous, differs.immersed) {
            (true, _) => differs,
            (false, true) => Outcome { class: Class::Wrong, ..differs },
            (false, false) => Outcome { class: Class::Otherwise, ..differs },
        };
    }
    if let Err(fault) = stays_apart(body, &unfolded, &volume) {
        return wrong("distance", fault);
    }
    let kind = format!(
        "as unfolded, {} refinements{}{}{}",
        volume.refinements,
        if checked.odd.is_empty() { "" } else { ", too coarse for the characteristic" },
        if checked.forks > 0 { ", with forks" } else { "" },
        if volume.ambiguous { ", ambiguous" } else { "" },
    );
    outcome(Class::AsUnfolded, sheets, &kind, format!("{:?}, {} forks", checked.odd, checked.forks))
}

/// Whether the body's own hexahedra on a grid are as many on each cell as the body is deep at any of its corners.
fn has_all_sheets(body: &Body, parameters: &VolumeParameters) -> bool {
    let Resolution::Spacing(spacing) = parameters.resolution else { return false };
    let positions = &body.solid.positions;
    let [low, high] = [DVec3::min, DVec3::max].map(|f| positions.iter().copied().reduce(f).unwrap());
    let grid = Grid3::covering(low.to_array(), high.to_array(), spacing, 1).unwrap();
    let depths = body.solid.depths(&grid);
    let mut counts = vec![0; grid.cell_count()];
    Unfolded::new(&body.solid, &grid).cells.iter().for_each(|&cell| counts[cell] += 1);
    (0..counts.len()).all(|cell| {
        let at = grid.cell_at(cell);
        let corner = |c: u32| grid.node_index([0, 1, 2].map(|axis| at[axis] + (c >> axis & 1)));
        (0..8).all(|c| depths[corner(c)] <= counts[cell])
    })
}

/// Points tried in each tetrahedron.
const NEGATIVE_TRIES: usize = 40;

/// A point around which the surface winds a negative number of times: of a place that may be a line of the grid between crossings of the
/// surface, or else within a tetrahedron that is inside out.
fn negative_point(body: &Body, surface: &ClosedOrientedMesh, place: &Place) -> Option<(DVec3, i32)> {
    let numbers = WindingNumbers::new(surface);
    let random = &mut Random::new(1);
    let mut points = vec![place.min, place.max];
    let along = (place.max - place.min).max_element();
    if (place.max - place.min).element_sum() == along {
        // Between each crossing of the line and the next.
        let mut crossings = crossings(surface, place);
        crossings.sort_by(f64::total_cmp);
        points.extend(crossings.windows(2).map(|pair| place.min.lerp(place.max, 0.5 * (pair[0] + pair[1]))));
    }
    for corners in body.solid.inside_out() {
        points.extend((0..NEGATIVE_TRIES).map(|_| {
            let weights: [f64; 4] = std::array::from_fn(|_| random.between(0.01, 1.0));
            let sum = weights.iter().sum::<f64>();
            (0..4).map(|c| DVec3::from_array(corners[c]) * weights[c]).sum::<DVec3>() / sum
        }));
    }
    points.into_iter().find_map(|point| match numbers.at(point) {
        Winding::Number(number) if number < 0 => Some((point, number)),
        _ => None,
    })
}

/// Where the surface crosses the line from one corner of a place to the other, as shares of the way, with both ends.
fn crossings(surface: &ClosedOrientedMesh, place: &Place) -> Vec<f64> {
    let way = place.max - place.min;
    let mut found = vec![0.0, 1.0];
    for t in 0..surface.triangles().len() as u32 {
        let [a, b, c] = surface.corners(TriId(t));
        let normal = (b - a).cross(c - a);
        let at = (a - place.min).dot(normal) / way.dot(normal);
        let point = place.min + at * way;
        let within =
            [(a, b), (b, c), (c, a)].into_iter().all(|(p, q)| (q - p).cross(point - p).dot(normal) >= 0.0);
        if within && (0.0..=1.0).contains(&at) {
            found.push(at);
        }
    }
    found
}

/// Whether winding numbers, the body's tetrahedra and the mesh agree on how deep each node lies, as far as nodes away from the surface tell.
fn as_deep_as(body: &Body, surface: &ClosedOrientedMesh, volume: &VolumeMesh) -> Result<(), String> {
    let grid = volume.mesh.grid();
    let depths = body.solid.depths(grid);
    let winding = grid_winding_numbers(surface, grid, &Monitor::none()).map_err(|e| e.to_string())?;
    if let Some(node) = (0..depths.len()).find(|&node| depths[node] != winding.numbers()[node]) {
        let (number, p) = (winding.numbers()[node], grid.position(grid.node_at(node)));
        return Err(format!("winding number {number} at {p}, {} tetrahedra", depths[node]));
    }
    let mut counts = vec![0; grid.cell_count()];
    volume.mesh.cells().iter().for_each(|&cell| counts[cell as usize] += 1);
    let mut touched = vec![false; grid.cell_count()];
    volume
        .hosts
        .triangles
        .iter()
        .for_each(|&[h, _]| touched[volume.mesh.cells()[h as usize] as usize] = true);
    for cell in (0..counts.len()).filter(|&cell| !touched[cell]) {
        let depth = depths[grid.node_index(grid.cell_at(cell))];
        if counts[cell] != depth {
            return Err(format!("{} hexahedra on cell {:?}, {depth} deep", counts[cell], grid.cell_at(cell)));
        }
    }
    Ok(())
}

/// Each step through a side goes no further along the body than a hexahedron is long. So between two hexahedra on one cell the way
/// is at least as many steps as the way along them is longer than that.
fn stays_apart(body: &Body, unfolded: &Unfolded, volume: &VolumeMesh) -> Result<(), String> {
    let (solid, complex) = (&body.solid, Complex::of_mesh(&volume.mesh));
    let round = body.round;
    // The way along of each hexahedron that holds some surface, by the hexahedra of the unfolded body: from its first tetrahedron, how far on and back.
    let way = |a: f64, b: f64| match round {
        Some(length) => (b - a + 1.5 * length).rem_euclid(length) - 0.5 * length,
        None => b - a,
    };
    let mut range: Vec<Option<[f64; 3]>> = vec![None; unfolded.cells.len()];
    for (&(_, tet), &h) in unfolded.pairs.iter().zip(&unfolded.hexahedra) {
        for v in solid.tets[tet as usize] {
            let along = solid.along[v as usize];
            let [start, low, high] = range[h].unwrap_or([along, 0.0, 0.0]);
            let step = way(start, along);
            range[h] = Some([start, low.min(step), high.max(step)]);
        }
    }
    let longest = range.iter().flatten().map(|[_, low, high]| high - low).fold(0.0, f64::max);
    let mut of_mesh = vec![None; volume.mesh.len()];
    for &[h, t] in &volume.hosts.triangles {
        let cell = volume.mesh.cells()[h as usize] as usize;
        of_mesh[h as usize] = unfolded.hexahedron(cell, solid.tet_of[t as usize]);
    }
    let pairs = (1..volume.mesh.len()).filter(|&h| volume.mesh.cells()[h - 1] == volume.mesh.cells()[h]);
    for h in pairs.step_by(17).take(20) {
        let (Some(a), Some(b)) = (of_mesh[h - 1], of_mesh[h]) else { continue };
        let (Some([at, ..]), Some([there, ..])) = (range[a], range[b]) else { continue };
        // Both ends of the way may lie anywhere in their hexahedra.
        let least = (way(at, there).abs() / longest - 2.0).ceil();
        if let Some(steps) = complex.distances(h - 1)[h]
            && f64::from(steps) < least
        {
            return Err(format!(
                "hexahedra {} and {h} are {steps} steps apart, at least {least} are needed",
                h - 1
            ));
        }
    }
    Ok(())
}

/// Outcomes by kind.
#[derive(Default)]
pub(super) struct Tally {
    kinds: BTreeMap<(Class, String), Vec<(u64, String)>>,
    /// How many were of bodies without a tetrahedron inside out, and how many of these were meshed as unfolded.
    pub(super) immersed: usize,
    pub(super) as_unfolded: usize,
    /// How many of them were meshed as another volume with the same boundary.
    pub(super) ambiguous_immersed: usize,
    /// How many meshes had sheets over one another, of how many.
    pub(super) overlapping: usize,
    pub(super) meshed: usize,
}

impl Tally {
    pub(super) fn add(&mut self, seed: u64, outcome: Outcome) {
        let Outcome { class, immersed, sheets, kind, note } = outcome;
        if class == Class::Wrong {
            println!("{seed}: WRONG: {kind}: {note}");
        }
        self.immersed += usize::from(immersed);
        self.as_unfolded += usize::from(class == Class::AsUnfolded);
        self.ambiguous_immersed += usize::from(immersed && class == Class::Ambiguous);
        self.meshed += usize::from(sheets > 0);
        self.overlapping += usize::from(sheets > 1);
        self.kinds.entry((class, kind)).or_default().push((seed, note));
    }

    /// How many of a class.
    pub(super) fn count(&self, class: Class) -> usize {
        self.kinds.iter().filter(|((of, _), _)| *of == class).map(|(_, list)| list.len()).sum()
    }

    pub(super) fn any_wrong(&self) -> bool {
        self.count(Class::Wrong) > 0
    }

    pub(super) fn print(&self) {
        for ((class, kind), list) in &self.kinds {
            println!("{:5} {class:?}, {kind}", list.len());
            list.iter().take(8).for_each(|(seed, note)| println!("        seed {seed}: {note}"));
        }
        println!("{} of {} immersed bodies as unfolded", self.as_unfolded, self.immersed);
        println!("{} of {} meshes with sheets over one another", self.overlapping, self.meshed);
    }
}
