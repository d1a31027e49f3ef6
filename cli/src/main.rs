//! The command `welter`.

mod render;

fn main() {}
