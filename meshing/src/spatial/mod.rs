//! Spatial queries: bounding volume hierarchy, self-intersections, winding numbers.
