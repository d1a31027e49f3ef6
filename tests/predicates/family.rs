//! The five determinant predicates in one shape, so that one test body serves all of them.

use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestRng, TestRunner};
use proptest::{prop_assert_eq, strategy::Strategy};
use std::fmt::Debug;
use welter_kit::entropy::Entropy;
use welter_kit::exact;
use welter_kit::generate::graded;
use welter_predicates as wp;
use welter_predicates::{NonFinite, Sign, Stage};

/// A predicate of `N` points of `D` dimensions with its variants and its oracle.
pub(crate) struct Predicate<const D: usize, const N: usize> {
    pub(crate) name: &'static str,
    pub(crate) sign: fn(&[[f64; D]; N]) -> Sign,
    pub(crate) sign_f32: fn(&[[f32; D]; N]) -> Sign,
    pub(crate) value: fn(&[[f64; D]; N]) -> f64,
    pub(crate) checked: fn(&[[f64; D]; N]) -> Result<Sign, NonFinite>,
    pub(crate) staged: fn(&[[f64; D]; N]) -> (Sign, Stage),
    pub(crate) oracle: fn(&[[f64; D]]) -> i32,
    pub(crate) determinant: fn(&[[f64; D]]) -> f64,
    /// Inputs at a distance of about two to the minus so many bits from degenerate.
    pub(crate) graded: fn(Option<i32>, &mut Entropy<'_>) -> [[f64; D]; N],
    /// To how many bits from degenerate the filter, and the double-double stage, settle half of the signs (`rates`).
    pub(crate) filter_reach: i32,
    pub(crate) double_double_reach: i32,
    /// Percent of input of any exponents that filter and double-double stage settle at least.
    pub(crate) early_on_exponents: f64,
    /// Property-test cases for each kind of input; fewer where the oracle is slow.
    pub(crate) cases: u32,
}

/// Writes out the variants of one predicate, which differ in their names alone.
macro_rules! predicate {
    ($constant:ident, $d:literal, $n:literal, [$($p:ident)+], $sign:ident $value:ident $checked:ident,
     $oracle:ident $determinant:ident $graded:ident, reach $filter:literal $double:literal, early $early:literal, $cases:literal) => {
        pub(crate) const $constant: Predicate<$d, $n> = Predicate {
            name: stringify!($sign),
            sign: |[$($p),+]| wp::$sign($($p),+),
            sign_f32: |[$($p),+]| wp::$sign($($p),+),
            value: |[$($p),+]| wp::$value($($p),+),
            checked: |[$($p),+]| wp::$checked($($p),+),
            staged: |[$($p),+]| wp::staged::$sign($($p),+),
            oracle: exact::$oracle,
            determinant: exact::$determinant,
            graded: graded::$graded,
            filter_reach: $filter,
            double_double_reach: $double,
            early_on_exponents: $early,
            cases: $cases,
        };
    };
}

predicate!(ORIENT2D, 2, 3, [a b c], orient2d orient2d_value try_orient2d, orient orient_value near_hyperplane, reach 49 102, early 88.0, 4000);
predicate!(ORIENT3D, 3, 4, [a b c d], orient3d orient3d_value try_orient3d, orient orient_value near_hyperplane, reach 45 101, early 64.0, 4000);
predicate!(ORIENT4D, 4, 5, [a b c d e], orient4d orient4d_value try_orient4d, orient orient_value near_hyperplane, reach 45 99, early 39.0, 1500);
predicate!(INCIRCLE, 2, 4, [a b c d], incircle incircle_value try_incircle, in_sphere in_sphere_value near_sphere, reach 43 97, early 45.0, 4000);
predicate!(INSPHERE, 3, 5, [a b c d e], insphere insphere_value try_insphere, in_sphere in_sphere_value near_sphere, reach 39 95, early 29.0, 1500);

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
