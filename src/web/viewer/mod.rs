//! The two views.

mod asking;
mod cameras;
mod canvas;
mod colours;
mod compared;
mod compared_map;
mod defects;
mod factors;
mod frame;
mod maps;
mod mirror;
mod patches;
mod preview;
mod reading;
mod stages;
