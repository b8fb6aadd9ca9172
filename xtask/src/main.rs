//! Build helper of the project.
fn main() {}
