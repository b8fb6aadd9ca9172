//! Edge-length geometry on a Delta-complex: flips, tracing, correspondence.
