//! Demos: pairs of procedural closed shapes of genus 0, with different connectivity and with landmarks.
//!
//! Animals, a figure and hands are soft parts around a skeleton (`body`, `tube`), whose skin is meshed (`skin`). Three older demos, pairs of
//! tubes and of balls (`implicit`, `polygonise`), stay the same to the last bit, since the numbers of their vertices are in use elsewhere.

mod animal;
mod ball_cone;
mod bend;
mod body;
mod catalogue;
mod clawed;
mod eye;
mod figure;
mod hand;
mod hoofed;
mod human;
mod implicit;
mod limbs;
mod marching;
mod pairs;
mod polygonise;
mod quadruped;
mod round;
mod rounded_cone;
mod shape;
mod skin;
mod tube;

pub use catalogue::{DemoInfo, list};
pub use limbs::{Joint, skin_of_limbs};
pub use pairs::{Demo, build, true_map};
