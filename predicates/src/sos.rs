//! Symbolic perturbation: orientations that are never zero.
