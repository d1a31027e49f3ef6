//! Solids that overlap themselves: the mesh is exactly what their own connectivity says.

use std::collections::BTreeMap;

use welter_kit::mesher::bodies::{Body, body};
use welter_kit::mesher::{Complex, Unfolded, check, equals_unfolded};
use welter_meshing::Monitor;
use welter_meshing::volumetric::{Resolution, VolumeError, VolumeMesh, VolumeParameters, mesh_volume};

/// How many seeds: `WELTER_MESHER_SEEDS`, and from which: `WELTER_MESHER_FIRST`.
fn number_from(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().map_or(otherwise, |text| text.parse().expect("a number"))
}

/// What became of a seed.
struct Outcome {
    kind: String,
    note: String,
}

fn parameters(body: &Body, seed: u64, max_refinements: u32) -> VolumeParameters {
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

fn outcome(seed: u64) -> Outcome {
    let body = body(seed);
    let surface = body.solid.surface();
    let refinements = number_from("WELTER_MESHER_REFINEMENTS", 2) as u32;
    let parameters = parameters(&body, seed, refinements);
    let immersed = body.solid.inverted() == 0;
    let outcome =
        |kind: &str, note: String| Outcome { kind: kind.into(), note: format!("{}: {note}", body.name) };
    let volume = match mesh_volume(&surface, &parameters, &Monitor::none()) {
        Ok(volume) => volume,
        Err(error @ VolumeError::Negative { .. }) if immersed => {
            return outcome("WRONG: negative, but immersed", error.to_string());
        }
        Err(error @ VolumeError::Negative { .. }) => return outcome("negative", error.to_string()),
        Err(VolumeError::UnderResolved { what, place, .. }) => {
            let kind = format!("under-resolved ({}): {what}", if immersed { "immersed" } else { "inverted" });
            return outcome(&kind, place.to_string());
        }
        Err(error) => return outcome("WRONG: other error", error.to_string()),
    };
    let checked = match check(&surface, &volume) {
        Ok(checked) => checked,
        Err(fault) => return outcome(if immersed { "WRONG: check" } else { "inverted, check" }, fault),
    };
    if !immersed {
        return outcome("inverted tetrahedra, but meshed", format!("{:?}", checked.odd));
    }
    let unfolded = Unfolded::new(&body.solid, volume.mesh.grid());
    if let Err(fault) = equals_unfolded(&volume, &body.solid, &unfolded) {
        let kind = if volume.ambiguous { "ambiguous, differs" } else { "WRONG: differs" };
        return outcome(kind, format!("{} refinements: {fault}", volume.refinements));
    }
    if let Err(fault) = stays_apart(&body, &unfolded, &volume) {
        return outcome("WRONG: distance", fault);
    }
    let kind = format!(
        "as unfolded, {} refinements{}{}{}",
        volume.refinements,
        if checked.odd.is_empty() { "" } else { ", too coarse for the characteristic" },
        if checked.forks > 0 { ", with forks" } else { "" },
        if volume.ambiguous { ", ambiguous" } else { "" },
    );
    outcome(&kind, format!("{:?}, {} forks", checked.odd, checked.forks))
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

#[test]
fn solids_are_meshed_as_they_hang_together() {
    let first = number_from("WELTER_MESHER_FIRST", 0);
    let seeds: Vec<u64> = (first..first + number_from("WELTER_MESHER_SEEDS", 20)).collect();
    let mut kinds: BTreeMap<String, Vec<(u64, String)>> = BTreeMap::new();
    for seed in seeds {
        let Outcome { kind, note } = outcome(seed);
        if kind.starts_with("WRONG") {
            println!("{seed}: {kind}: {note}");
        }
        kinds.entry(kind).or_default().push((seed, note));
    }
    for (kind, list) in &kinds {
        println!("{:5} {kind}", list.len());
        list.iter().take(8).for_each(|(seed, note)| println!("        seed {seed}: {note}"));
    }
    assert!(!kinds.keys().any(|kind| kind.starts_with("WRONG")), "some meshes are wrong, see above");
}
