//! `conemap demo`.

use crate::arguments::DemoArguments;
use crate::input::Failure;
use crate::outputs;
use crate::told::{print, say};
use conemap::demo::{self, Demo};
use conemap::export;
use conemap::io::landmark_file::{self, LandmarkFile, LandmarkPoint};

/// Writes the meshes and landmarks of a demo, or lists all demos.
pub fn run(arguments: &DemoArguments) -> Result<(), Failure> {
    let Some(id) = &arguments.id else {
        let line = |info: &demo::DemoInfo| format!("{:20} {}", info.id, info.sentence);
        return print(demo::list().iter().map(line).collect::<Vec<_>>().join("\n"));
    };
    let names = [format!("{id}-source.obj"), format!("{id}-target.obj"), format!("{id}.json")];
    if !demo::list().iter().any(|info| info.id == id) {
        return Err(format!("there is no demo “{id}”; `conemap demo` lists them").into());
    }
    let places = names.each_ref().map(|name| arguments.out.join(name));
    outputs::check([], places.iter().cloned())?;
    let built = demo::build(id).ok_or_else(|| format!("the demo “{id}” is listed, but not built"))?;
    let contents =
        [export::obj::mesh(&built.source), export::obj::mesh(&built.target), pairs(&built, &names)];
    for (place, content) in places.iter().zip(&contents) {
        outputs::write(place, content)?;
        say(format_args!("{}", place.display()));
    }
    Ok(())
}

/// The landmark file of a demo, which names its meshes.
fn pairs(demo: &Demo, [source, target, _]: &[String; 3]) -> Vec<u8> {
    landmark_file::write(&LandmarkFile {
        source: Some(source.clone()),
        target: Some(target.clone()),
        pairs: demo.landmarks.iter().map(|pair| pair.map(LandmarkPoint::Vertex)).collect(),
        labels: Some(demo.labels.clone()),
        ..LandmarkFile::default()
    })
}
