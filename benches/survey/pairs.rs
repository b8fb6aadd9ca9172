//! Maps of the pairs of the data folder as they are, and of the demos.

use crate::arguments::Arguments;
use crate::case::{Case, Make, map_all};
use crate::shrec07;
use crate::table::{header, sum_up};
use conemap::mesh::VertexId;

/// Maps each pair as its file gives it.
pub fn as_they_are(arguments: &Arguments) {
    each(arguments, |case| case);
}

/// Maps each pair with source and target exchanged; where the truth is known, the inverse of the true map takes its place.
pub fn exchanged(arguments: &Arguments) {
    each(arguments, |mut case| {
        let place = |v: usize| case.meshes[0].positions()[VertexId::from(v)];
        case.truth = case.truth.map(|truth| (0..truth.len()).map(place).collect());
        case.meshes.reverse();
        case.points.reverse();
        case.variant = "exchanged".into();
        case
    });
}

/// Maps each demo with its landmarks (`--pairs NAME,...`: only the demos whose names begin so).
pub fn demos(arguments: &Arguments) {
    header();
    let ids = arguments.demos().into_iter();
    let cases: Vec<Make<'_>> = ids.map(|id| Box::new(move || Case::of_demo(id)) as Make<'_>).collect();
    sum_up("demos", &map_all(cases, arguments).iter().collect::<Vec<_>>());
}

fn each(arguments: &Arguments, change: fn(Case) -> Case) {
    header();
    let mut cases: Vec<Make<'_>> = Vec::new();
    for name in arguments.names() {
        cases.push(Box::new(move || change(Case::of_pair(arguments, &name))));
    }
    let outcomes = map_all(cases, arguments);
    let of = |is: bool| outcomes.iter().filter(|o| shrec07::is_of(&o.name) == is).collect::<Vec<_>>();
    sum_up("shrec07", &of(true));
    sum_up("others", &of(false));
}
