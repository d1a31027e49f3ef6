//! Collision: times of impact, minimum separation, closest points.

mod approach;
mod closest;
mod impact;
mod impact_laws;
mod named;
mod pairs;
mod referee;
