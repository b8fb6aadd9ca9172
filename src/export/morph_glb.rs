//! A mesh on its way to another shape as binary glTF 2.0: morph targets, and an animation of their weights.
//!
//! The first morph target is the straight way, whose weight is the time from 0 to 1. The others are the bends at the keys
//! ([`crate::math::bends`]), whose weights are the polynomials of the time that mix them. The animation tells all weights at moments so
//! close to each other that what lies between them is straight.

use super::glb::{NodePlace, difference, flat};
use super::glb_document::GlbDocument;
use super::skin::Skin;
use crate::math::bends::{KEYS, weights};
use crate::math::rigid3::turned_by;
use crate::mesh::FileFrame;
use glam::DVec3;
use serde_json::{Value, json};

/// The number of moments at which the animation tells the weights.
const MOMENTS: usize = 33;
/// The length of the animation, in seconds.
const DURATION: f64 = 3.0;

/// A mesh and its way, point by point.
#[derive(Clone, Copy, Debug)]
pub struct MorphingMesh<'a> {
    /// The places of the points at the beginning and at the end.
    pub positions: [&'a [DVec3]; 2],
    /// The unit normals of the points at the beginning and at the end.
    pub normals: [&'a [DVec3]; 2],
    /// The offsets of points from the straight line at each key.
    pub bends: &'a [[DVec3; KEYS.len()]],
    /// The turn of each point's surroundings over the whole way: its direction is the axis, its length the angle in radians.
    pub turns: &'a [DVec3],
}

impl MorphingMesh<'_> {
    /// The offsets of the normals at a key from the straight mix of both ends: both are turned there with their surroundings.
    fn normal_bends(&self, time: f64) -> Vec<DVec3> {
        let [begins, ends] = self.normals;
        let bend = |k: usize| {
            let turn = self.turns[k];
            let there = [turned_by(turn * time) * begins[k], turned_by(turn * (time - 1.0)) * ends[k]];
            there[0].lerp(there[1], time).normalize_or(begins[k]) - begins[k].lerp(ends[k], time)
        };
        (0..begins.len()).map(bend).collect()
    }
}

impl GlbDocument {
    /// The straight way and the bends, places and normals of each.
    fn targets(&mut self, mesh: &MorphingMesh<'_>, ends: [&[DVec3]; 2], begins: [&[f32]; 2]) -> Vec<Value> {
        let mut pairs = vec![[0, 1].map(|k| difference(ends[k], begins[k]))];
        for (k, &time) in KEYS.iter().enumerate() {
            let bends: Vec<DVec3> = mesh.bends.iter().map(|bends| bends[k]).collect();
            pairs.push([flat(&bends), flat(&mesh.normal_bends(time))]);
        }
        let target = |[places, normals]: &[Vec<f32>; 2]| json!({ "POSITION": self.places(places), "NORMAL": self.attribute(normals, "VEC3", 3) });
        pairs.iter().map(target).collect()
    }

    /// The weights of the way, moment by moment.
    fn animation(&mut self) -> Value {
        let times: Vec<f64> = (0..MOMENTS).map(|k| k as f64 / (MOMENTS - 1) as f64).collect();
        let seconds: Vec<f32> = times.iter().map(|time| (time * DURATION) as f32).collect();
        let all = |time: &f64| std::iter::once(*time).chain(weights(*time)).map(|weight| weight as f32);
        let weights: Vec<f32> = times.iter().flat_map(all).collect();
        let (input, output) = (self.numbers(&seconds), self.numbers(&weights));
        json!({
            "name": "source to target",
            "samplers": [{ "input": input, "output": output, "interpolation": "LINEAR" }],
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }]
        })
    }
}

/// The mesh at its begin in a skin of its points, morph targets that lead it to its end, and an animation that plays the way. `frame` is
/// that of the mesh's file.
pub fn morphing_source(points: &MorphingMesh<'_>, frame: FileFrame, skin: &Skin) -> Vec<u8> {
    let node = NodePlace::of(points.positions[0], frame);
    let [places, ends] = points.positions.map(|positions| skin.gathered(&node.local(positions)));
    let normals = points.normals.map(|normals| skin.gathered(normals));
    let mesh = MorphingMesh {
        positions: [&places, &ends],
        normals: normals.each_ref().map(Vec::as_slice),
        bends: &skin.gathered(points.bends),
        turns: &skin.gathered(points.turns),
    };
    let begins = [flat(&places), flat(&normals[0])];
    let mut document = GlbDocument::default();
    let attributes = json!({
        "POSITION": document.places(&begins[0]),
        "NORMAL": document.attribute(&begins[1], "VEC3", 3)
    });
    let targets = document.targets(&mesh, [&ends, &normals[1]], [&begins[0], &begins[1]]);
    let names: Vec<String> =
        std::iter::once("target".to_owned()).chain(KEYS.iter().map(|key| format!("bend at {key}"))).collect();
    let animation = document.animation();
    let mesh = json!({
        "primitives": document.primitives(skin, &attributes, &json!(targets)),
        "weights": vec![0.0; 1 + KEYS.len()],
        "extras": { "targetNames": names }
    });
    document.into_glb(node.json(), mesh, Some(animation))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::read_mesh;
    use crate::mesh::generators::icosphere;
    use crate::surface_map::measures::transfer::CommonMesh;
    use glam::DVec2;

    /// The JSON of a GLB, and its binary chunk.
    fn document(bytes: &[u8]) -> (Value, &[u8]) {
        let length = u32::from_le_bytes([bytes[12], bytes[13], bytes[14], bytes[15]]) as usize;
        (serde_json::from_slice(&bytes[20..20 + length]).unwrap(), &bytes[28 + length..])
    }

    fn values((document, binary): &(Value, &[u8]), accessor: &Value) -> Vec<f64> {
        let accessor = &document["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let [begin, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().unwrap() as usize);
        let numbers = binary[begin..begin + length].as_chunks::<4>().0;
        numbers.iter().map(|b| f64::from(f32::from_le_bytes(*b))).collect()
    }

    #[test]
    fn the_animation_plays_the_way() {
        let mesh = icosphere(1);
        let turn = DVec3::new(0.3, 2.0, -0.5);
        let places: Vec<DVec3> = mesh.positions().iter().map(|p| *p + DVec3::X * 1.5).collect();
        let turned =
            |time: f64| -> Vec<DVec3> { places.iter().map(|p| turned_by(turn * time) * *p).collect() };
        let normals = mesh.positions().raw.to_vec();
        let [ends, end_normals] = [turned(1.0), normals.iter().map(|n| turned_by(turn) * *n).collect()];
        let bend = |k: usize| KEYS.map(|key| turned(key)[k] - places[k].lerp(ends[k], key));
        let bends: Vec<_> = (0..places.len()).map(bend).collect();
        let triangles: Vec<[u32; 3]> = mesh.triangles().iter().map(|t| t.map(|v| v.0)).collect();
        let morphing = MorphingMesh {
            positions: [&places, &ends],
            normals: [&normals, &end_normals],
            bends: &bends,
            turns: &vec![turn; places.len()],
        };
        let common = CommonMesh { uvs: vec![DVec2::ZERO; places.len()], triangles, ..CommonMesh::default() };
        let skin = Skin::checkerboard(&common).unwrap();
        let bytes = morphing_source(&morphing, FileFrame::default(), &skin);
        assert_eq!(read_mesh(&bytes).unwrap().polygons.len(), 80);
        let glb = document(&bytes);
        let primitive = &glb.0["meshes"][0]["primitives"][0];
        let sampler = &glb.0["animations"][0]["samplers"][0];
        let [seconds, weights] = ["input", "output"].map(|key| values(&glb, &sampler[key]));
        let targets = primitive["targets"].as_array().unwrap();
        assert_eq!([seconds.len(), weights.len(), targets.len()], [MOMENTS, MOMENTS * 4, 4]);
        let read = |name: &str| {
            let parts: Vec<Vec<f64>> = targets.iter().map(|target| values(&glb, &target[name])).collect();
            (values(&glb, &primitive["attributes"][name]), parts)
        };
        for (name, at) in [("POSITION", &places), ("NORMAL", &normals)] {
            let (base, parts) = read(name);
            for (moment, weights) in weights.chunks_exact(4).enumerate() {
                let time = seconds[moment] / DURATION;
                let value = |i: usize| base[i] + (0..4).map(|k| weights[k] * parts[k][i]).sum::<f64>();
                for (k, p) in at.iter().enumerate() {
                    let there = DVec3::new(value(3 * k), value(3 * k + 1), value(3 * k + 2));
                    // Three keys follow a third of a turn to a thousandth.
                    let off = there.distance(turned_by(turn * time) * *p) / p.length();
                    assert!(off < 2e-3, "{name} at {time}: {off}");
                }
            }
        }
    }
}
