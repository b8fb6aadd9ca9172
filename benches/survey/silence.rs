//! How long a run asks its monitor nothing, by stage: on balls of 5,000 to 328,000 faces, and on pairs by name.

use crate::arguments::Arguments;
use crate::case::Case;
use crate::watch::Watch;
use conemap::mesh::SurfacePoint;
use conemap::mesh::VertexId;
use conemap::mesh::generators::icosphere;
use conemap::monitor::Stage;
use glam::DVec3;
use std::time::Instant;

/// The longest silence of each stage.
pub fn table(arguments: &Arguments) {
    let cases: Vec<Case> = if arguments.pairs.is_empty() {
        [4, 5, 6, 7].map(ball).into()
    } else {
        arguments.pairs.iter().map(|name| Case::of_pair(arguments, name)).collect()
    };
    for case in cases {
        let faces = case.meshes[0].face_count();
        let (begun, mut watch) = (Instant::now(), Watch::new());
        let outcome = case.run(&arguments.options, &mut watch).err().unwrap_or_else(|| "a map".into());
        watch.longest();
        println!("{} ({faces} faces): {outcome} in {:.1} s", case.name, begun.elapsed().as_secs_f64());
        for (stage, (silence, questions)) in &watch.by_stage {
            let stage = stage.map_or("before the first stage", Stage::sentence);
            println!("  {stage:44} {:8.0} ms, {questions} questions", 1000.0 * silence.as_secs_f64());
        }
    }
}

/// A ball onto a bent one, with 24 landmarks.
fn ball(levels: usize) -> Case {
    let source = icosphere(levels);
    let bend = |p: &DVec3| DVec3::new(1.3 * p.x, p.y + 0.2 * p.x * p.x, p.z * (1.0 + 0.2 * p.y));
    let target = source.with_positions(source.positions().iter().map(bend).collect());
    let points = [&source, &target]
        .map(|mesh| (0..24).map(|v| SurfacePoint::at_vertex(mesh, VertexId(v))).collect::<Vec<_>>());
    let name = format!("ball {levels}");
    Case { name, variant: String::new(), meshes: [source, target], points, truth: None }
}
