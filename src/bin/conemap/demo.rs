//! `conemap demo`.

use crate::arguments::DemoArguments;
use crate::input::Failure;
use crate::outputs;
use crate::told::{print, say};
use conemap::demo::{self, Demo};
use conemap::export::{self, vertex_image};
use conemap::io::landmark_file::{self, LandmarkFile, LandmarkPoint};

/// Writes the meshes and landmarks of a demo, or lists all demos.
pub fn run(arguments: &DemoArguments) -> Result<(), Failure> {
    let Some(id) = &arguments.id else {
        let line = |info: &demo::DemoInfo| format!("{:20} {}", info.id, info.sentence);
        return print(demo::list().iter().map(line).collect::<Vec<_>>().join("\n"));
    };
    if !demo::list().iter().any(|info| info.id == id) {
        return Err(format!("there is no demo “{id}”; `conemap demo` lists them").into());
    }
    let built = demo::build(id).ok_or_else(|| format!("the demo “{id}” is listed, but not built"))?;
    let files = files(id, &built);
    outputs::check([], files.iter().map(|(name, _)| arguments.out.join(name)))?;
    for (name, content) in files {
        let place = arguments.out.join(name);
        outputs::write(&place, &content)?;
        say(format_args!("{}", place.display()));
    }
    Ok(())
}

/// The files of a demo by their names: its meshes, its landmarks, and the true images of the source's vertices where they are known.
fn files(id: &str, demo: &Demo) -> Vec<(String, Vec<u8>)> {
    let meshes = [format!("{id}-source.obj"), format!("{id}-target.obj")];
    let landmarks = (format!("{id}.json"), pairs(demo, &meshes));
    let truth = demo.truth.as_ref().map(|truth| (format!("{id}-truth.csv"), vertex_image::places_csv(truth)));
    let [source, target] = meshes;
    [(source, export::obj::mesh(&demo.source)), (target, export::obj::mesh(&demo.target)), landmarks]
        .into_iter()
        .chain(truth)
        .collect()
}

/// The landmark file of a demo, which names its meshes.
fn pairs(demo: &Demo, [source, target]: &[String; 2]) -> Vec<u8> {
    landmark_file::write(&LandmarkFile {
        source: Some(source.clone()),
        target: Some(target.clone()),
        pairs: demo.landmarks.iter().map(|pair| pair.map(LandmarkPoint::Vertex)).collect(),
        labels: Some(demo.labels.clone()),
        ..LandmarkFile::default()
    })
}
