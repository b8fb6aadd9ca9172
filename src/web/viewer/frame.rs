//! One frame of both views.

use super::super::view_side::{CoarseStage, Factors, Landmark, Side};
use super::canvas::{SurfaceStyle, Viewer};
use crate::gpu::{Clear, Mesh, Paint, Palette, ViewDraw};
use crate::landmarks::MeshSide;
use crate::scene::pins::Stand;
use crate::scene::{MarkerInstance, PinInstance, Pose};
use glam::Vec3;
use wasm_bindgen::prelude::*;

/// About the length of a dash with its gap, in pixels of the page.
const DASH: f32 = 15.0;

#[wasm_bindgen]
impl Viewer {
    /// Draws a frame at a time; whether another one is to follow, as a camera is on its way.
    pub fn render(&mut self, now: f64) -> bool {
        self.now = now;
        for side in &mut self.sides {
            side.glide = side.glide.filter(|glide| !glide.is_over(now));
        }
        let balls = MeshSide::BOTH.map(|view| self.balls(view));
        let pins = MeshSide::BOTH.map(|view| self.pins(view));
        let views =
            MeshSide::BOTH.map(|view| self.view(view, Marks { balls: &balls[view], pins: &pins[view] }));
        // Linear RGB, chosen by eye.
        let background = if self.style.dark { [0.011, 0.013, 0.018] } else { [0.84, 0.86, 0.88] };
        self.renderer.draw(Clear(background), &views);
        self.sides.iter().any(|side| side.glide.is_some())
    }
}

/// The marks in a view.
#[derive(Clone, Copy)]
struct Marks<'a> {
    balls: &'a [MarkerInstance],
    pins: &'a [PinInstance],
}

impl Viewer {
    /// The contents of a view that are drawn.
    fn view<'a>(&'a self, view: MeshSide, marks: Marks<'a>) -> ViewDraw<'a> {
        let shown = self.side_in(view);
        let (side, style): (&Side, _) = (&self.sides[shown], &self.style);
        let bare = || self.bare(view, shown, marks);
        if let Some(refused) = side.refused() {
            return ViewDraw { paint: Paint::Refused, surface: Some(refused), ..bare() };
        }
        if let Some(other) = self.compared().filter(|_| view == MeshSide::Target) {
            return self.compared_view(other, bare());
        }
        let own = side.mesh.as_ref().map(|m| &m.surface);
        if let Some(preview) = &self.sides[0].preview {
            let surface = if shown == MeshSide::Source { Some(&preview.mesh) } else { own };
            return ViewDraw { paint: Paint::Pattern, surface, ..bare() };
        }
        if let Some(stage) = side.stage.as_ref().filter(|_| !self.is_morphed(shown)) {
            return self.stage_view(stage, bare());
        }
        if let Some(factors) = &side.factors
            && !self.is_morphed(shown)
        {
            let lines = side.lines.as_ref().filter(|_| style.patch_lines);
            return ViewDraw { lines, ..self.factors_view(factors, bare()) };
        }
        if style.surface == SurfaceStyle::Look
            && let Some(in_look) = self.in_look(shown, bare())
        {
            return in_look;
        }
        // Without a look to show, surfaces are plain.
        let paint = style.paint();
        let paint = if paint == Paint::Look { Paint::Plain } else { paint };
        let morph = if shown == MeshSide::Source && side.overlay.is_some() { self.morph } else { 0.0 };
        let is_own_place = shown == MeshSide::Target && style.surface.is_of_places();
        let shows_own = morph == 0.0 && (paint == Paint::Plain || is_own_place);
        let overlay = side.overlay.as_ref().filter(|_| !shows_own);
        ViewDraw {
            paint: if overlay.is_some() || shows_own { paint } else { Paint::Plain },
            morph,
            wipe: style.wipe.filter(|_| shown == MeshSide::Source).unwrap_or(0.0),
            pictures: &self.texture,
            surface: overlay.or(own),
            under: own.filter(|_| style.holes && overlay.is_some() && morph == 0.0),
            tinted: side.lit.surface.as_ref().filter(|_| morph == 0.0),
            traced: self.traced(side).map(|lines| lines.filter(|_| morph == 0.0)),
            lines: side.lines.as_ref().filter(|_| style.patch_lines && morph == 0.0),
            ..bare()
        }
    }

    /// A view of the mesh `shown` with its marks, and without a surface.
    fn bare<'a>(&'a self, view: MeshSide, shown: MeshSide, marks: Marks<'a>) -> ViewDraw<'a> {
        let side = &self.sides[shown];
        let pose = side.pose(self.now);
        let is_morphed = self.is_morphed(shown);
        let defects = side.defects.as_ref().filter(|_| !is_morphed);
        let mirror = side.mirror.as_ref().filter(|_| side.defects.is_none() && !is_morphed);
        ViewDraw {
            rectangle: self.sides[view].rectangle,
            pose,
            paint: Paint::Plain,
            palette: self.palette(),
            line_half_width: 0.9 * self.pixel_ratio,
            morph: 0.0,
            bend_range: self.way.as_ref().map_or(0.0, |way| way.range),
            world_from_image: self.source_from_target,
            wipe: 0.0,
            surface: None,
            under: None,
            painted: defects.and_then(|defects| defects.painted.as_ref()),
            tinted: None,
            traced: [None; 2],
            lines: None,
            marks: defects
                .and_then(|defects| defects.lines.as_ref())
                .or_else(|| mirror.and_then(|mirror| mirror.line.as_ref())),
            dash: self.dash(side, pose),
            balls: marks.balls,
            pins: marks.pins,
            pictures: &[],
        }
    }

    /// A view of a mesh on its way to its landmarks, with its edges.
    fn stage_view<'a>(&'a self, stage: &'a CoarseStage, bare: ViewDraw<'a>) -> ViewDraw<'a> {
        ViewDraw {
            palette: Palette { line: [0.03, 0.03, 0.03], ..self.palette() },
            line_half_width: 0.55 * self.pixel_ratio,
            surface: Some(&stage.surface),
            lines: stage.edges.as_ref(),
            traced: [stage.trail.as_ref(), None],
            ..bare
        }
    }

    /// A view of a mesh in colours of factors of length, or of the circles of its packing.
    fn factors_view<'a>(&self, factors: &'a Factors, bare: ViewDraw<'a>) -> ViewDraw<'a> {
        let paint =
            if factors.circles.is_some() { Paint::Circles } else { Paint::Factors(self.factor_share) };
        ViewDraw { paint, surface: Some(factors.circles.as_ref().unwrap_or(&factors.mesh)), ..bare }
    }

    /// A view in the look of the giving side, which the map carries, or in its own where there is no map; `None` where there is no look.
    fn in_look<'a>(&'a self, shown: MeshSide, bare: ViewDraw<'a>) -> Option<ViewDraw<'a>> {
        let side = &self.sides[shown];
        let own = side.mesh.as_ref().and_then(|mesh| mesh.dressed.as_ref());
        let giver = self.look_giver.filter(|_| side.carried.is_some());
        let morph = if shown == MeshSide::Source && giver.is_some() { self.morph } else { 0.0 };
        let surface = if giver.is_some() { side.carried.as_ref() } else { own };
        let is_still = morph == 0.0;
        Some(ViewDraw {
            paint: Paint::Look,
            morph,
            wipe: self.style.wipe.filter(|_| shown == MeshSide::Source).unwrap_or(0.0),
            surface: Some(surface?),
            pictures: &self.sides[giver.unwrap_or(shown)].pictures,
            tinted: side.lit.surface.as_ref().filter(|_| is_still),
            traced: self.traced(side).map(|lines| lines.filter(|_| is_still)),
            lines: side.lines.as_ref().filter(|_| self.style.patch_lines && is_still),
            ..bare
        })
    }

    /// The lines of a side that have colours of their own: where the texture is cut, and what is lit up.
    fn traced<'a>(&self, side: &'a Side) -> [Option<&'a Mesh>; 2] {
        [side.seams.as_ref().filter(|_| self.style.texture_boundary), side.lit.lines.as_ref()]
    }

    /// The length of a dash with its gap in scene units: about as long on the screen whatever the distance, and the same while the
    /// camera only turns.
    fn dash(&self, side: &Side, pose: Pose) -> f32 {
        let pixel = pose.height_at(pose.target, side.aspect()) / side.rectangle[3].max(1.0);
        (DASH * self.pixel_ratio * pixel).max(1e-9).log2().round().exp2()
    }

    /// The place of the ring of a view, on the surface as it is shown.
    fn ring(&self, side: MeshSide) -> Option<Vec3> {
        let place = self.sides[side].probe?;
        if !self.is_morphed(side) {
            return Some(place);
        }
        let image = self.source_from_target.transform_point3(self.sides[1].probe?);
        let bend = self.way.as_ref().zip(self.probed);
        let bend = bend.map_or(Vec3::ZERO, |(way, (corners, share))| way.bend(corners, share, self.morph));
        Some(place.lerp(image, self.morph) + bend)
    }

    /// Linear RGB, chosen by eye.
    fn palette(&self) -> Palette {
        let light = Palette {
            surface: [0.60, 0.56, 0.50],
            under: [0.26, 0.27, 0.29],
            line: [0.62, 0.16, 0.01],
            pattern: [[0.80, 0.76, 0.68], [0.10, 0.19, 0.32]],
            rim: [1.0, 1.0, 1.0],
        };
        let dark = Palette {
            surface: [0.50, 0.47, 0.42],
            line: [0.95, 0.42, 0.05],
            rim: [0.93, 0.93, 0.93],
            ..light
        };
        if self.style.dark { dark } else { light }
    }

    /// The pins of a view, hidden ones below and raised ones on top, then the rings of a place that is asked for.
    fn pins(&self, view: MeshSide) -> Vec<PinInstance> {
        let shown = self.side_in(view);
        let side = &self.sides[shown];
        let pose = side.pose(self.now);
        // In another shape nothing lies at its usual place.
        let still = !self.shows_another_shape(shown);
        let is_shown = |mark: &&Landmark| still && (self.style.markers || mark.pin.stand == Stand::Ghost);
        let marks = side.landmarks.iter().flatten().filter(is_shown);
        let mut pins: Vec<(bool, f32, PinInstance)> = marks
            .map(|Landmark { pin, .. }| {
                let hidden = side.is_hidden(pin.base, pose);
                let nearness = (pin.base - pose.eye()).dot(pose.back());
                let drawn =
                    if hidden { pin.outline(self.pixel_ratio) } else { pin.instance(self.pixel_ratio) };
                (hidden, nearness, drawn)
            })
            .collect();
        pins.sort_by(|a, b| {
            let rank = |p: &(bool, f32, PinInstance)| (!p.0, p.2.radius.to_bits());
            rank(a).cmp(&rank(b)).then(a.1.total_cmp(&b.1))
        });
        let ring = self.ring(shown).map(|place| PinInstance {
            base: place.to_array(),
            colour: [0.02, 0.02, 0.02],
            radius: 8.0 * self.pixel_ratio,
            stem: 0.0,
            kind: 2.0,
        });
        let signs =
            side.defects.iter().filter(|_| !self.is_morphed(shown)).flat_map(|defects| &defects.signs);
        let sign = |sign: &PinInstance| PinInstance { radius: sign.radius * self.pixel_ratio, ..*sign };
        signs.map(sign).chain(pins.into_iter().map(|(_, _, pin)| pin)).chain(ring).collect()
    }

    /// The cones as balls, red for positive and blue for negative curvature.
    fn balls(&self, view: MeshSide) -> Vec<MarkerInstance> {
        let shown = self.side_in(view);
        let ball = |Landmark { pin, cone }: &Landmark| {
            let curvature = *cone.as_ref()?;
            // A ball has a radius of 0.012 to 0.03 of the surface's, which grows with the root of the curvature.
            let size = (curvature.abs() as f32 / std::f32::consts::TAU).min(1.0).sqrt();
            let colour = if curvature >= 0.0 { [0.78, 0.04, 0.03] } else { [0.03, 0.16, 0.80] };
            Some(MarkerInstance { centre: pin.base.to_array(), radius: 0.012 + 0.018 * size, colour })
        };
        let is_shown = self.style.cones && !self.shows_another_shape(shown);
        self.sides[shown].landmarks.iter().flatten().filter(|_| is_shown).filter_map(ball).collect()
    }
}
