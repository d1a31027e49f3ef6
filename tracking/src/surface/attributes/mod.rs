//! Named arrays of values at vertices, edges and triangles, and the rules by which they pass through changes.
//!
//! | rule | what an element gets | kept by it |
//! | --- | --- | --- |
//! | [`Rule::Interpolate`] | mean of its sources | functions linear in position, where it splits edges |
//! | [`Rule::Copy`] | the value of its foremost source | the set of values |
//! | [`Rule::Conserve`] | its shares of the sources | the sum over all elements |
//! | [`Rule::Reset`] | its own value if it is old, else zero | |
//! | [`Rule::Custom`] | what a function of the sources says | |
//!
//! Each operation tells the sources of each element that it makes or alters, with two weights ([`Inherited`]).

mod column;
mod rule;
mod set;
pub(crate) mod transfer;

pub use rule::{AttributeValue, CustomRule, Inherited, Rule};
pub use set::{Attribute, AttributeError, AttributeSet};
