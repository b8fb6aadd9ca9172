//! The two views.

mod asking;
mod cameras;
mod canvas;
mod colours;
mod defects;
mod frame;
mod maps;
mod preview;
mod reading;
