//! Integration tests: predicates.
