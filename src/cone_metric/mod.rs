//! Target curvature and the discrete Ricci flow.
