//! Both parametrisations onto the cone surface, certified, and their composition, on the demos.

use crate::fixtures;
use crate::theorems::parametrisations_are_certified;

#[test]
fn demos_are_certified() {
    fixtures::demos().iter().for_each(parametrisations_are_certified);
}

#[test]
fn demos_of_other_sizes_and_rough_ones_are_certified() {
    parametrisations_are_certified(&fixtures::remeshed_demo("horse-cat", [1500, 8000]));
    parametrisations_are_certified(&fixtures::rough_demo("poses"));
}
