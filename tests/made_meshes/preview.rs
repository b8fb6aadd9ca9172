//! Tests of the previews of a map that is being made.

use conemap::demo;
use conemap::landmarks::{Landmarks, MeshSide};
use conemap::monitor::{Cancelled, MapPreview, Monitor, Silent, Stage, Step};
use conemap::pipeline::{MapInput, PipelineOptions, run};
use glam::DVec3;

/// A monitor that looks at every preview.
#[derive(Default)]
struct Looker {
    stage: Option<Stage>,
    previews: Vec<(Option<Stage>, Vec<DVec3>)>,
}

impl Monitor for Looker {
    fn enter(&mut self, stage: Stage) {
        self.stage = Some(stage);
    }

    fn preview(&mut self, preview: &dyn MapPreview) {
        let images = preview.images(MeshSide::Source).expect("every preview can be told");
        assert!(preview.images(MeshSide::Target).is_some());
        self.previews.push((self.stage, images));
    }

    fn step(&mut self, _step: Step) -> Result<(), Cancelled> {
        Ok(())
    }
}

/// Previews come with the first coarse map and with each level, approach the map, and do not change it; also where the computation
/// exchanges the meshes.
#[test]
#[ignore = "long: run by `cargo xtask test --all`"]
fn previews_come_near_the_map_and_do_not_change_it() {
    let demo = demo::build("horse-cat").expect("the demo is there");
    let given = [&demo.source, &demo.target];
    for swapped in [false, true] {
        let [source, target] = if swapped { [given[1], given[0]] } else { given };
        let pairs: Vec<_> =
            demo.landmarks.iter().map(|&[s, t]| if swapped { [t, s] } else { [s, t] }).collect();
        let landmarks = Landmarks::from_vertices(source, target, &pairs).expect("the demo's landmarks fit");
        let input = MapInput::new(source, target, &landmarks);
        let mut looker = Looker::default();
        let options = PipelineOptions::default();
        let result = run(input, &options, &mut looker).expect("the demo is mapped");
        let images: Vec<DVec3> = result
            .target_from_source
            .iter()
            .map(|point| point.expect("every vertex has its image").position(target))
            .collect();
        let unit = target.area().sqrt();
        let mean_error = |preview: &[DVec3]| {
            assert_eq!(preview.len(), source.vertex_count());
            let sum: f64 = preview.iter().zip(&images).map(|(a, b)| a.distance(*b)).sum();
            sum / images.len() as f64 / unit
        };
        let errors: Vec<f64> = looker.previews.iter().map(|(_, preview)| mean_error(preview)).collect();
        let [first, .., last] = errors[..] else { panic!("{errors:?}") };
        assert_eq!(looker.previews[0].0, Some(Stage::ClassSearch));
        assert_eq!(looker.previews.last().and_then(|(stage, _)| *stage), Some(Stage::Relaxation));
        assert!(first < 0.15 && last < 0.03 && last < first, "{errors:?}");

        if !swapped {
            let unseen = run(input, &options, &mut Silent).expect("the demo is mapped");
            let reports = [&result, &unseen].map(|result| serde_json::to_string(&result.report).unwrap());
            assert_eq!(reports[0], reports[1]);
        }
    }
}
