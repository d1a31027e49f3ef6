//! The five determinant predicates in one shape, so that one test body serves all of them.

use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};
use proptest::{prop_assert_eq, strategy::Strategy};
use std::fmt::Debug;
use welter_kit::exact;
use welter_predicates as wp;
use welter_predicates::Sign;

/// A predicate of `N` points of `D` dimensions with its oracle.
pub(crate) struct Predicate<const D: usize, const N: usize> {
    pub(crate) name: &'static str,
    pub(crate) sign: fn(&[[f64; D]; N]) -> Sign,
    pub(crate) sign_f32: fn(&[[f32; D]; N]) -> Sign,
    pub(crate) oracle: fn(&[[f64; D]]) -> i32,
    /// Property-test cases for each kind of input; fewer where the oracle is slow.
    pub(crate) cases: u32,
}

pub(crate) const ORIENT2D: Predicate<2, 3> = Predicate {
    name: "orient2d",
    sign: |[a, b, c]| wp::orient2d(a, b, c),
    sign_f32: |[a, b, c]| wp::orient2d(a, b, c),
    oracle: exact::orient,
    cases: 2000,
};
pub(crate) const ORIENT3D: Predicate<3, 4> = Predicate {
    name: "orient3d",
    sign: |[a, b, c, d]| wp::orient3d(a, b, c, d),
    sign_f32: |[a, b, c, d]| wp::orient3d(a, b, c, d),
    oracle: exact::orient,
    cases: 1000,
};
pub(crate) const ORIENT4D: Predicate<4, 5> = Predicate {
    name: "orient4d",
    sign: |[a, b, c, d, e]| wp::orient4d(a, b, c, d, e),
    sign_f32: |[a, b, c, d, e]| wp::orient4d(a, b, c, d, e),
    oracle: exact::orient,
    cases: 400,
};
pub(crate) const INCIRCLE: Predicate<2, 4> = Predicate {
    name: "incircle",
    sign: |[a, b, c, d]| wp::incircle(a, b, c, d),
    sign_f32: |[a, b, c, d]| wp::incircle(a, b, c, d),
    oracle: exact::in_sphere,
    cases: 1000,
};
pub(crate) const INSPHERE: Predicate<3, 5> = Predicate {
    name: "insphere",
    sign: |[a, b, c, d, e]| wp::insphere(a, b, c, d, e),
    sign_f32: |[a, b, c, d, e]| wp::insphere(a, b, c, d, e),
    oracle: exact::in_sphere,
    cases: 400,
};

/// Runs a generic test body on each of the five predicates.
macro_rules! for_each_predicate {
    ($($body:ident)+) => {$(
        mod $body {
            use crate::family;
            #[test]
            fn orient2d() {
                super::$body(&family::ORIENT2D);
            }
            #[test]
            fn orient3d() {
                super::$body(&family::ORIENT3D);
            }
            #[test]
            fn orient4d() {
                super::$body(&family::ORIENT4D);
            }
            #[test]
            fn incircle() {
                super::$body(&family::INCIRCLE);
            }
            #[test]
            fn insphere() {
                super::$body(&family::INSPHERE);
            }
        }
    )+};
}
pub(crate) use for_each_predicate;

/// Runs a property on `cases` inputs of a fixed sequence (the same in every run); `WELTER_CASES` multiplies their
/// number.
pub(crate) fn check<S: Strategy>(
    what: impl Debug,
    cases: u32,
    inputs: &S,
    property: impl Fn(S::Value) -> Result<(), TestCaseError>,
) {
    let factor = std::env::var("WELTER_CASES").ok().and_then(|value| value.parse().ok()).unwrap_or(1);
    let config = Config { cases: cases * factor, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    if let Err(error) = TestRunner::new_with_rng(config, rng).run(inputs, property) {
        panic!("{what:?}: {error}");
    }
}

/// The property that a sign is as an oracle says.
pub(crate) fn same(sign: Sign, expected: i32) -> Result<(), TestCaseError> {
    prop_assert_eq!(i32::from(sign as i8), expected);
    Ok(())
}
