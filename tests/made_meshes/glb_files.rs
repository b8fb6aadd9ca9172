//! Tests that the pictures that an OBJ file names are in the GLB that the command line writes.

use crate::command_line::{conemap, errors, folder};
use crate::glb_look::{COAT, EYE, Glb, ball, egg, landmarks, pictured};
use conemap::export::obj;
use conemap::job::TargetImage;
use std::path::Path;

/// The files of the pictures in a GLB, in the order of its triangles.
fn pictures(path: &Path) -> Vec<Vec<u8>> {
    let glb = Glb::new(&std::fs::read(path).unwrap());
    let images = glb.primitives().iter().filter_map(|primitive| {
        let source = &glb.texture(primitive)["source"];
        (!source.is_null()).then(|| glb.image(source).to_vec())
    });
    images.collect()
}

#[test]
fn pictures_beside_the_target_are_carried_and_those_elsewhere_are_not_read() {
    let folder = folder("pictures_beside_the_target");
    let path = |name: &str| folder.join(name);
    let write = |name: &str, bytes: &[u8]| std::fs::write(path(name), bytes).unwrap();
    write("source.obj", &obj::mesh(&ball()));
    write("target.obj", &pictured(&egg()));
    write("pairs.json", &landmarks(TargetImage::AsGiven));
    write("egg.mtl", b"newmtl coat\nmap_Kd skins/coat.png\nnewmtl eye\nmap_Kd ../eye.jpg\n");
    std::fs::create_dir(path("skins")).unwrap();
    write("skins/coat.png", COAT);
    let run = |words: &[&str]| {
        let word = |word: &&str| {
            word.strip_prefix('@').map_or_else(|| (*word).into(), |name| path(name).into_os_string())
        };
        let output = conemap(words.iter().map(word));
        assert!(output.status.success(), "{}", errors(&output));
        errors(&output)
    };
    let meshes = ["@source.obj", "@target.obj"];
    let said = run(&[
        &["map"],
        &meshes[..],
        &["--landmarks", "@pairs.json", "--map", "@m.conemap", "--out", "@out"],
    ]
    .concat());
    assert!(said.contains("target.obj: the picture ../eye.jpg is missing"), "{said}");
    assert_eq!(pictures(&path("out/source-with-target-texture.glb")), [COAT]);
    // A picture is found by its bare name, too.
    write("eye.jpg", EYE);
    let said = run(&[&["export", "@m.conemap"], &meshes[..], &["--out", "@saved"]].concat());
    assert!(!said.contains("warning"), "{said}");
    assert_eq!(pictures(&path("saved/source-with-target-texture.glb")), [COAT, EYE]);
    run(&[&["transfer", "@m.conemap"], &meshes[..], &["--morph", "--out", "@morph.glb"]].concat());
    assert_eq!(pictures(&path("morph.glb")), [COAT, EYE]);
}
