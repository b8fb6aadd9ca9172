//! Base domains by quadric error simplification, drawn on both meshes of the demos, in both directions.

use crate::fixtures;
use crate::theorems::simplified_base_is_drawn;

#[test]
fn simplified_base_domains_are_drawn() {
    let remeshed = [[1500, 3000], [8000, 5000]].map(|faces| fixtures::remeshed_demo("horse-cat", faces));
    for case in fixtures::demos().into_iter().chain(remeshed) {
        for case in [case.exchanged(), case] {
            assert!(simplified_base_is_drawn(&case), "{}", case.name);
        }
    }
}
