//! How far two pictures are apart.

use welter_fluids::volume_rendering::Picture;

/// Root mean square and 99th percentile of the differences in one plane.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Difference {
    pub(crate) root_mean_square: f64,
    pub(crate) percentile: f64,
}

impl Difference {
    /// Of some differences.
    fn of(mut differences: Vec<f64>) -> Self {
        differences.sort_by(f64::total_cmp);
        let count = differences.len().max(1);
        let squares: f64 = differences.iter().map(|d| d * d).sum();
        let at = (differences.len() * 99 / 100).min(differences.len().saturating_sub(1));
        Self {
            root_mean_square: (squares / count as f64).sqrt(),
            percentile: differences.get(at).copied().unwrap_or(0.0),
        }
    }
}

/// The differences of alpha, scatter and composite, over the pixels that a reference covers.
pub(crate) fn differences(picture: &Picture, reference: &Picture) -> [Difference; 3] {
    let covered: Vec<usize> =
        (0..reference.alpha.pixels().len()).filter(|&at| reference.alpha.pixels()[at] > 0.0).collect();
    let plane = |value: fn(&Picture, usize) -> f32| {
        let difference = |&at: &usize| f64::from(value(picture, at) - value(reference, at)).abs();
        Difference::of(covered.iter().map(difference).collect())
    };
    [
        plane(|p, at| p.alpha.pixels()[at]),
        plane(|p, at| p.scatter.pixels()[at]),
        // Everything is white or grey: the colors are equal.
        plane(|p, at| p.composite.pixels()[at][1]),
    ]
}
