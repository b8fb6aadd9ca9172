//! The native half of the test that the same input gives the same result natively and in the page. It writes the files of its maps to
//! Cargo's folder for temporary test files; `tests/unit/agreement.test.ts` makes the same maps with the page's own wasm module and
//! compares.

use crate::job::{Files, run};
use conemap::job::{MapFiles, OpenMap, OutputKind};
use conemap::monitor::Silent;
use conemap::pipeline::{Choices, PipelineOptions};
use std::path::Path;

#[test]
fn maps_of_demos_are_left_for_the_page_to_compare() {
    for id in ["sphere-tetrahedron", "horse-cat"] {
        let files = Files::of_demo(id, usize::MAX);
        let (job, result) = run(&files, &PipelineOptions::default(), &mut Silent);
        assert!(result.report.certificate.as_ref().is_some_and(|certificate| certificate.bijective), "{id}");

        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("agreement").join(id);
        std::fs::create_dir_all(&folder).unwrap();
        let leave = |name: &str, bytes: &[u8]| std::fs::write(folder.join(name), bytes).unwrap();
        leave("source.obj", &files.source);
        leave("target.obj", &files.target);
        leave("landmarks.json", &files.landmarks);
        leave("report.json", serde_json::to_string_pretty(&result.report).unwrap().as_bytes());
        let map = job.map_file(&result, &Choices::default()).unwrap();
        let map = job.taken(&map).output(OutputKind::Map).unwrap();
        // The page makes its files from the map file, after reading it again.
        let open =
            OpenMap::read(MapFiles { map: &map, source: &files.source, target: &files.target }).unwrap();
        for kind in open.taken().kinds() {
            leave(kind.file_name(), &open.taken().output(kind).unwrap());
        }
    }
}
