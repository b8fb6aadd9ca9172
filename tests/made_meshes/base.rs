//! Base domains by quadric error simplification, drawn on both meshes of the demos, in both directions.

use crate::fixtures;
use crate::theorems::simplified_base_is_drawn;

#[test]
fn every_simplified_base_domain_is_drawn() {
    let remeshed = [[1500, 3000], [8000, 5000]].map(|faces| fixtures::remeshed_demo("horse-cat", faces));
    for case in fixtures::demos().into_iter().chain(remeshed) {
        simplified_base_is_drawn(&case);
        simplified_base_is_drawn(&case.exchanged());
    }
}
