//! The list of the demos.

/// A demo that can be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DemoInfo {
    /// The name in links and on the command line.
    pub id: &'static str,
    /// The name that people read.
    pub title: &'static str,
    /// A sentence that says what the demo shows.
    pub sentence: &'static str,
}

/// All demos. A new visitor of the page sees the first one; the last one is mapped quickest.
const DEMOS: [DemoInfo; 12] = [
    DemoInfo {
        id: "horse-camel",
        title: "Horse and camel",
        sentence: "Two animals with hooves; one has a hump and a bent neck",
    },
    DemoInfo {
        id: "wolf-cow",
        title: "Wolf and cow",
        sentence: "Paws and hooves, a bushy tail and a tuft, horns on one side",
    },
    DemoInfo { id: "cat-lion", title: "Cat and lion", sentence: "Two cats; one has a mane" },
    DemoInfo {
        id: "horse-gallop",
        title: "Galloping horse",
        sentence: "One horse standing and galloping, meshed twice",
    },
    DemoInfo {
        id: "horse-turning",
        title: "Turning horse",
        sentence: "One horse straight and bent to its side, meshed twice; the true map is known",
    },
    DemoInfo {
        id: "horse-rearing",
        title: "Rearing horse",
        sentence: "One horse grazing and on its hind legs, meshed twice",
    },
    DemoInfo {
        id: "figure-running",
        title: "Runner",
        sentence: "One figure standing and running, meshed twice",
    },
    DemoInfo { id: "hands", title: "Two hands", sentence: "One hand open and grasping, meshed twice" },
    DemoInfo {
        id: "ball-cone",
        title: "Ball and cone",
        sentence: "A ball and a rounded cone, with the boundary of the cone's texture on both",
    },
    DemoInfo {
        id: "horse-cat",
        title: "Horse and cat",
        sentence: "Two four-legged shapes of different build",
    },
    DemoInfo { id: "poses", title: "Two poses", sentence: "One figure standing and dancing, meshed twice" },
    DemoInfo {
        id: "sphere-tetrahedron",
        title: "Sphere and tetrahedron",
        sentence: "A ball and a rounded tetrahedron",
    },
];

/// All demos.
pub fn list() -> &'static [DemoInfo] {
    &DEMOS
}
