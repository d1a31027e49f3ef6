//! Generated inputs of the predicates' benchmark: fixed seed, thousands of distinct tuples of points each.
//!
//! * uniform: coordinates uniform in [-1, 1).
//! * nearly degenerate: points on a random line, plane, hyperplane, circle or sphere, rounded to `f64`, then
//!   moved by up to 3 ulp in each coordinate.
//! * degenerate grid: points of an integer grid that are exactly collinear, coplanar, cocircular, cospherical.
//! * degenerate mixed: corners of one box about the origin (cocircular, cospherical) or of one face of it
//!   (coplanar), points on one line through the origin; exponents as in mixed.
//! * mixed exponents: random sign, mantissa and, for each coordinate its own, binary exponent.

/// SplitMix64.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [-1, 1).
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Uniform in `low..=high`.
    fn integer(&mut self, low: i64, high: i64) -> i64 {
        low + (self.bits() % (high - low + 1) as u64) as i64
    }

    fn vector<const N: usize>(&mut self) -> [f64; N] {
        std::array::from_fn(|_| self.unit())
    }

    fn few_ulps(&mut self, x: f64) -> f64 {
        let steps = self.integer(-3, 3);
        (0..steps.abs()).fold(x, |x, _| if steps > 0 { x.next_up() } else { x.next_down() })
    }

    fn mixed(&mut self, exponents: i64) -> f64 {
        (1.5 + self.unit() / 2.0)
            * 2f64.powi(self.integer(-exponents, exponents) as i32)
            * if self.bits() & 1 == 0 { 1.0 } else { -1.0 }
    }
}

/// The curved surface on which nearly or exactly degenerate points lie.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Surface {
    Flat,
    Round,
}

#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Class {
    Uniform,
    NearlyDegenerate,
    Grid,
    Mixed { exponents: i64 },
    DegenerateMixed { exponents: i64 },
}

impl Class {
    pub(crate) const ALL: [Self; 6] = [
        Self::Uniform,
        Self::NearlyDegenerate,
        Self::Grid,
        Self::DegenerateMixed { exponents: 60 },
        Self::Mixed { exponents: 60 },
        Self::Mixed { exponents: 1000 },
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::NearlyDegenerate => "nearly degenerate",
            Self::Grid => "degenerate grid",
            Self::Mixed { exponents: 60 } => "mixed 2^+-60",
            Self::DegenerateMixed { .. } => "degenerate 2^+-60",
            Self::Mixed { .. } => "mixed 2^+-1000",
        }
    }
}

/// `count` tuples of `P` points.
pub(crate) fn tuples<const N: usize, const P: usize>(
    class: Class,
    surface: Surface,
    count: usize,
) -> Vec<[[f64; N]; P]> {
    let mut random = Random(0x5eed ^ ((N * 16 + P) as u64) << 32);
    let spheres = integer_points_on_spheres::<N>();
    (0..count)
        .map(|_| match (class, surface) {
            (Class::Uniform, _) => std::array::from_fn(|_| random.vector()),
            (Class::NearlyDegenerate, Surface::Flat) => near_flat(&mut random),
            (Class::NearlyDegenerate, Surface::Round) => near_round(&mut random),
            (Class::Grid, Surface::Flat) => grid_flat(&mut random),
            (Class::Grid, Surface::Round) => grid_round(&mut random, &spheres),
            (Class::DegenerateMixed { exponents }, surface) => {
                degenerate_mixed(&mut random, surface, exponents)
            }
            (Class::Mixed { exponents }, _) => {
                std::array::from_fn(|_| std::array::from_fn(|_| random.mixed(exponents)))
            }
        })
        .collect()
}

fn near_flat<const N: usize, const P: usize>(random: &mut Random) -> [[f64; N]; P] {
    let origin: [f64; N] = random.vector();
    let directions: [[f64; N]; N] = std::array::from_fn(|_| random.vector());
    std::array::from_fn(|_| {
        let mut point = origin;
        for direction in &directions[1..] {
            let t = random.unit();
            point = std::array::from_fn(|j| point[j] + t * direction[j]);
        }
        point.map(|x| random.few_ulps(x))
    })
}

fn near_round<const N: usize, const P: usize>(random: &mut Random) -> [[f64; N]; P] {
    let center: [f64; N] = random.vector();
    let radius = random.unit().abs() + 0.1;
    std::array::from_fn(|_| {
        let direction: [f64; N] = loop {
            let v: [f64; N] = random.vector();
            let square: f64 = v.iter().map(|x| x * x).sum();
            if (0.01..1.0).contains(&square) {
                break v.map(|x| x / square.sqrt());
            }
        };
        std::array::from_fn(|j| random.few_ulps(center[j] + radius * direction[j]))
    })
}

/// Coordinates of up to 30 bits on a flat through a grid point, spanned by grid vectors.
fn grid_flat<const N: usize, const P: usize>(random: &mut Random) -> [[f64; N]; P] {
    let mut vector = |r: i64| -> [i64; N] { std::array::from_fn(|_| random.integer(-r, r)) };
    let origin = vector(1 << 20);
    let directions: [[i64; N]; N] = std::array::from_fn(|_| vector(1 << 10));
    std::array::from_fn(|_| {
        let mut point = origin;
        for direction in &directions[1..] {
            let t = random.integer(-1000, 1000);
            point = std::array::from_fn(|j| point[j] + t * direction[j]);
        }
        point.map(|x| x as f64)
    })
}

/// A translated sphere of the grid.
fn grid_round<const N: usize, const P: usize>(
    random: &mut Random,
    spheres: &[Vec<[i64; N]>],
) -> [[f64; N]; P] {
    let sphere = &spheres[random.integer(0, spheres.len() as i64 - 1) as usize];
    let origin: [i64; N] = std::array::from_fn(|_| random.integer(-(1 << 20), 1 << 20));
    std::array::from_fn(|_| {
        let point = sphere[random.integer(0, sphere.len() as i64 - 1) as usize];
        std::array::from_fn(|j| (origin[j] + point[j]) as f64)
    })
}

fn degenerate_mixed<const N: usize, const P: usize>(
    random: &mut Random,
    surface: Surface,
    exponents: i64,
) -> [[f64; N]; P] {
    let corner: [f64; N] = std::array::from_fn(|_| random.mixed(exponents));
    std::array::from_fn(|_| {
        let scale = 2f64.powi(random.integer(-20, 20) as i32);
        std::array::from_fn(|j| match (surface, N) {
            (Surface::Flat, 2) => scale * corner[j],
            (Surface::Flat, _) if j == 0 => corner[0],
            (Surface::Flat, _) => random.mixed(exponents),
            (Surface::Round, _) if random.bits() & 1 == 0 => corner[j],
            (Surface::Round, _) => -corner[j],
        })
    })
}

/// The integer points at a few distances from the origin that many points have.
fn integer_points_on_spheres<const N: usize>() -> Vec<Vec<[i64; N]>> {
    let squares: &[i64] = if N == 2 { &[5525, 27625, 71825, 160_225] } else { &[1449, 2001, 2741, 3389] };
    squares.iter().map(|&square| points_of_norm(square)).collect()
}

fn points_of_norm<const N: usize>(square: i64) -> Vec<[i64; N]> {
    if N > 3 {
        return Vec::new();
    }
    let r = square.isqrt();
    let mut points = Vec::new();
    let mut point = [0; N];
    for x in -r..=r {
        point[0] = x;
        if N == 2 {
            push_last(&mut points, point, square - x * x);
        } else {
            for y in -r..=r {
                point[1] = y;
                push_last(&mut points, point, square - x * x - y * y);
            }
        }
    }
    points
}

fn push_last<const N: usize>(points: &mut Vec<[i64; N]>, mut point: [i64; N], rest: i64) {
    if rest >= 0 && rest.isqrt().pow(2) == rest {
        point[N - 1] = rest.isqrt();
        points.push(point);
        point[N - 1] = -rest.isqrt();
        points.push(point);
    }
}
