//! Built-in surfaces of any resolution.
