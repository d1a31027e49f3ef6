//! The predicates with the [`Stage`](crate::Stage) that settled each sign: for benchmarks, rate tests and tuning.
//!
//! They cost what the plain functions cost.
//!
//! ```
//! use welter_predicates::{Sign, Stage, staged};
//! let clear = staged::orient2d([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]);
//! assert_eq!(clear, (Sign::Positive, Stage::Filter));
//! ```

pub use crate::incircle::staged as incircle;
pub use crate::insphere::staged as insphere;
pub use crate::orient2d::staged as orient2d;
pub use crate::orient3d::staged as orient3d;
pub use crate::orient4d::staged as orient4d;
