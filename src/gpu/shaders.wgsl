// Four things are drawn: surfaces, lines (as ribbons that face the viewer), balls, and pins over the picture.
// One uniform block serves all of them; it is rewritten for each of the two views.

struct View {
    // World to clip space.
    clip_from_world: mat4x4<f32>,
    // From the images' coordinates, the target's, to this view's: a rigid motion.
    world_from_image: mat4x4<f32>,
    // xyz: the camera's position.
    eye: vec4<f32>,
    // xyz: right and up on the screen.
    right: vec4<f32>,
    up: vec4<f32>,
    // xy: size of the view in pixels; z: surface style (-1 plain and a little behind, 0 plain, 1 a texture of the flat metric,
    // 2 colours of the place on the target, 3 a scale by vertex values, 4 solid pattern, 5 faint and hatched, 6 faces in their own
    // colours, a little in front, 7 a scale by texture coordinates, 8 the look of a mesh's file, 9 circles around
    // the vertices); w: half width of lines in pixels.
    size_and_style: vec4<f32>,
    // x: share of the way that every vertex has gone to its image; y: how strongly hollows are darkened;
    // z: opacity of lines behind the surface; w: which texture (0 checkerboard, 1 circles, 2 ribbons, 3 coordinates, 4 the picture).
    ways: vec4<f32>,
    // rgb: colour of the plain surface.
    surface: vec4<f32>,
    // rgb: colour of lines.
    line: vec4<f32>,
    // rgb: light and dark colour of patterns.
    pattern_light: vec4<f32>,
    pattern_dark: vec4<f32>,
    // rgb: the border of pins.
    rim: vec4<f32>,
    // x: from the left of the canvas to where the map's colours and lines begin, in pixels; before it the surface is plain;
    // y: length of a dash with its gap, in the world; z: share of the way from the first texture coordinate, a place on the scale of
    // factors, to the second.
    wipe: vec4<f32>,
    // From texture coordinates to cells of the texture: xy the axis of the first coordinate, zw where the origin lies.
    cells: vec4<f32>,
    // xyz: the weights of the bends of the way to the image at this moment; w: the length for which 1 stands in them.
    bends: vec4<f32>,
    // rgb: the colours of the scale.
    scale: array<vec4<f32>, 10>,
};

@group(0) @binding(0) var<uniform> view: View;
// What is laid on a surface in a look.
@group(1) @binding(0) var picture: texture_2d<f32>;
@group(1) @binding(1) var picture_sampler: sampler;

struct SurfaceOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    // The place on the scale, and how hollow the place is.
    @location(3) values: vec2<f32>,
    @location(4) image: vec3<f32>,
    // Colour as a screen shows it; w: whether the picture is laid on it.
    @location(5) tint: vec4<f32>,
};

// The largest turn that a vertex is told, in radians.
const TURN_RANGE: f32 = 12.5663706;

// A vector turned about an axis by an angle: together the turn (Rodrigues).
fn turned(v: vec3<f32>, turn: vec3<f32>) -> vec3<f32> {
    let angle = length(turn);
    let axis = turn / max(angle, 1e-6);
    return v * cos(angle) + cross(axis, v) * sin(angle) + axis * dot(axis, v) * (1.0 - cos(angle));
}

@vertex
fn surface_vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) scale_place: f32,
    @location(4) image: vec3<f32>,
    @location(5) image_normal: vec3<f32>,
    @location(6) hollow: f32,
    @location(7) tint: vec4<f32>,
    // xyz: how far the vertex is off its straight way at three moments; w: x, y and z of its turn over the whole way.
    @location(8) first_bend: vec4<f32>,
    @location(9) second_bend: vec4<f32>,
    @location(10) third_bend: vec4<f32>,
) -> SurfaceOut {
    let way = view.ways.x;
    let end = (view.world_from_image * vec4<f32>(image, 1.0)).xyz;
    let end_normal = (view.world_from_image * vec4<f32>(image_normal, 0.0)).xyz;
    var out: SurfaceOut;
    let weights = view.bends.w * view.bends.xyz;
    let bend = weights.x * first_bend.xyz + weights.y * second_bend.xyz + weights.z * third_bend.xyz;
    let turn = TURN_RANGE * vec3<f32>(first_bend.w, second_bend.w, third_bend.w);
    out.world = mix(position, end, way) + bend;
    if view.size_and_style.z > 5.5 && view.size_and_style.z < 6.5 {
        out.world = mix(out.world, view.eye.xyz, 0.0012);
    }
    out.clip = view.clip_from_world * vec4<f32>(out.world, 1.0);
    out.normal = mix(turned(normal, way * turn), turned(end_normal, (way - 1.0) * turn), way);
    out.uv = uv;
    out.values = vec2<f32>(scale_place, hollow);
    out.image = image;
    out.tint = tint;
    if view.size_and_style.z < -0.5 {
        out.clip.z += 0.004 * out.clip.w;
    }
    return out;
}

// A soft key light from the upper left of the viewer, light from the sky above and a little from the ground, all fixed to the
// screen, so that a turned surface shows its shape; hollows get less of the light from around.
fn lit(colour: vec3<f32>, world: vec3<f32>, raw_normal: vec3<f32>, hollow: f32) -> vec3<f32> {
    let to_eye = normalize(view.eye.xyz - world);
    var normal = normalize(raw_normal);
    normal = select(-normal, normal, dot(normal, to_eye) > 0.0);
    let right = view.right.xyz;
    let up = view.up.xyz;
    let key = normalize(to_eye + 0.75 * up - 0.55 * right);
    // Light that wraps around the edge of the shadow.
    let diffuse = pow(max(0.3 + 0.7 * dot(normal, key), 0.0), 1.5);
    let sky = 0.5 + 0.5 * dot(normal, up);
    let around = mix(vec3<f32>(0.20, 0.19, 0.18), vec3<f32>(0.40, 0.42, 0.46), sky);
    let open = clamp(1.0 - view.ways.y * hollow, 0.35, 1.25);
    let half_way = normalize(key + to_eye);
    let gloss = pow(max(dot(normal, half_way), 0.0), 28.0) * 0.06;
    // Towards the outline the surface darkens, as clay does: the outline is seen on a light ground, too.
    let facing = max(dot(normal, to_eye), 0.0);
    let outline = mix(0.62, 1.0, smoothstep(0.0, 0.55, facing));
    return colour * (vec3<f32>(0.72, 0.70, 0.67) * diffuse * mix(1.0, open, 0.6) + around * open) * outline + vec3<f32>(gloss * open);
}

// The integral of a square wave of period 2 and height 1 over the footprint of the pixel (Quilez).
fn square_wave(x: f32) -> f32 {
    let w = max(fwidth(x), 1e-5);
    let wide = 2.0 * (abs(fract((x - 0.5 * w) * 0.5) - 0.5) - abs(fract((x + 0.5 * w) * 0.5) - 0.5)) / w;
    // Where a pixel sees many cells only their mean is left.
    return wide * clamp(2.0 - w, 0.0, 1.0);
}

// A checkerboard, 0 or 1.
fn checker(p: vec2<f32>) -> f32 {
    return 0.5 - 0.5 * square_wave(p.x) * square_wave(p.y);
}

// A checkerboard in space, 0 or 1. The axes are turned a little, as a flat part along an axis would flicker between two cells.
fn solid_checker(place: vec3<f32>) -> f32 {
    let turn = mat3x3<f32>(
        vec3<f32>(0.9386, 0.2409, -0.2470),
        vec3<f32>(-0.2049, 0.9652, 0.1628),
        vec3<f32>(0.2776, -0.1022, 0.9552),
    );
    let p = turn * place * 9.0 + vec3<f32>(0.37, 0.23, 0.41);
    return 0.5 - 0.5 * square_wave(p.x) * square_wave(p.y) * square_wave(p.z);
}

// Colours of the scale by a place from 0 to 1.
fn scale_colour(place: f32) -> vec3<f32> {
    let at = 9.0 * clamp(place, 0.0, 1.0);
    let below = min(i32(at), 8);
    return mix(view.scale[below].rgb, view.scale[below + 1].rgb, at - f32(below));
}

// Circles of diameter 1 packed as densely as the plane takes them: how much of a pixel lies in one.
fn circles(p: vec2<f32>) -> f32 {
    let row = vec2<f32>(1.0, 1.7320508);
    let near = p - row * round(p / row);
    let shifted = p - 0.5 * row;
    let distance = min(length(near), length(shifted - row * round(shifted / row)));
    let w = max(length(fwidth(p)), 1e-5);
    // Where a pixel sees many circles only their mean is left.
    return mix(0.77, clamp((0.46 - distance) / w + 0.5, 0.0, 1.0), clamp(2.0 - w, 0.0, 1.0));
}

// The colour of a ribbon by its number: six that follow one another, told apart also by the colour-blind.
fn ribbon_colour(number: f32) -> vec3<f32> {
    let colours = array<vec3<f32>, 6>(
        vec3<f32>(0.90, 0.35, 0.02),
        vec3<f32>(0.11, 0.46, 0.81),
        vec3<f32>(0.87, 0.77, 0.06),
        vec3<f32>(0.00, 0.17, 0.45),
        vec3<f32>(0.60, 0.19, 0.38),
        vec3<f32>(0.00, 0.34, 0.17),
    );
    return colours[i32(number - 6.0 * floor(number / 6.0)) % 6];
}

// Ribbons of width 1 across the first coordinate.
fn ribbons(x: f32) -> vec3<f32> {
    let w = max(fwidth(x), 1e-5);
    let next = clamp((fract(x) - 1.0 + w) / w, 0.0, 1.0);
    let sharp = mix(ribbon_colour(floor(x)), ribbon_colour(floor(x) + 1.0), next);
    return mix(vec3<f32>(0.41, 0.38, 0.32), sharp, clamp(2.0 - w, 0.0, 1.0));
}

// Red and green for the two coordinates, there and back over 36 cells, with a line around each cell.
fn coordinates(p: vec2<f32>) -> vec3<f32> {
    let way = abs(2.0 * fract(p / 72.0) - 1.0);
    let w = max(fwidth(p), vec2<f32>(1e-5));
    let line = clamp((0.04 - abs(p - round(p))) / w + 0.5, vec2<f32>(0.0), vec2<f32>(1.0));
    let share = max(line.x * clamp(1.5 - 2.0 * w.x, 0.0, 1.0), line.y * clamp(1.5 - 2.0 * w.y, 0.0, 1.0));
    return vec3<f32>(0.92 - 0.84 * way, 0.35) * (1.0 - 0.55 * share);
}

// A texture of the flat metric. The picture lies on 9 by 9 cells, again and again.
fn texture_colour(uv: vec2<f32>) -> vec3<f32> {
    let along = view.cells.xy;
    let p = vec2<f32>(along.x * uv.x - along.y * uv.y, along.y * uv.x + along.x * uv.y) + view.cells.zw;
    let light = view.pattern_light.rgb;
    let dark = view.pattern_dark.rgb;
    let kind = view.ways.w;
    if kind > 3.5 {
        return textureSample(picture, picture_sampler, vec2<f32>(p.x, -p.y) / 9.0).rgb;
    } else if kind > 2.5 {
        return coordinates(p);
    } else if kind > 1.5 {
        return ribbons(p.x);
    } else if kind > 0.5 {
        return mix(dark, light, circles(p));
    }
    return mix(dark, light, checker(p));
}

// One colour for every place of the target.
fn place_colour(image: vec3<f32>) -> vec3<f32> {
    return 0.06 + 0.8 * smoothstep(vec3<f32>(-0.75), vec3<f32>(0.75), image);
}

// How much of a pixel lies in a stripe, of lines at whole multiples of the pixels `period` that are `width` pixels wide.
fn stripe(at: f32, period: f32, width: f32) -> f32 {
    return cover(abs(at - period * round(at / period)) - 0.5 * width);
}

// How much of a pixel the filling of a painted face covers, by its number: falling stripes, a grid, points, level stripes. On the
// screen, so that it is as clear from afar; `unit` is the width of a line.
fn filling(kind: f32, at: vec2<f32>, unit: f32) -> f32 {
    let period = 5.0 * unit;
    if kind > 2.5 {
        return stripe(at.y, period, 1.6 * unit);
    } else if kind > 1.5 {
        let cell = at - period * round(at / period);
        return cover(length(cell) - 1.3 * unit);
    } else if kind > 0.5 {
        return max(stripe(at.x + at.y, 1.4142 * period, 1.2 * unit), stripe(at.x - at.y, 1.4142 * period, 1.2 * unit));
    }
    return stripe(at.x - at.y, 1.4142 * period, 2.6 * unit);
}

// The light of a screen's number (sRGB).
fn light_of(colour: vec3<f32>) -> vec3<f32> {
    let above = pow((colour + 0.055) / 1.055, vec3<f32>(2.4));
    return select(above, colour / 12.92, colour <= vec3<f32>(0.04045));
}

@fragment
fn surface_fragment(in: SurfaceOut) -> @location(0) vec4<f32> {
    let style = view.size_and_style.z;
    let solid = solid_checker(in.image);
    let light = view.pattern_light.rgb;
    let dark = view.pattern_dark.rgb;
    var colour = view.surface.rgb;
    let unit = view.size_and_style.w / 0.9;
    if style > 8.5 {
        // The powers of the place with respect to the circles around the corners: below 0 inside, 0 on the circle.
        let powers = dot(in.uv, in.uv) + in.image;
        let change = max(fwidth(powers), vec3<f32>(1e-9));
        let rings = clamp(0.5 + 0.8 * unit - abs(powers) / change, vec3<f32>(0.0), vec3<f32>(1.0));
        let inside = select(0.0, 0.25, min(powers.x, min(powers.y, powers.z)) < 0.0);
        colour = mix(scale_colour(in.values.x), vec3<f32>(0.95), inside);
        colour = mix(colour, vec3<f32>(0.06), max(rings.x, max(rings.y, rings.z)));
    } else if style > 7.5 {
        let sampled = textureSample(picture, picture_sampler, in.uv).rgb;
        let own = light_of(in.tint.rgb) * mix(vec3<f32>(1.0), sampled, step(0.5, in.tint.w));
        colour = select(own, colour, in.clip.x < view.wipe.x);
    } else if style > 0.5 && style < 1.5 {
        // Before the wipe parts the pixels, as a texture looks at its neighbours.
        colour = select(texture_colour(in.uv), colour, in.clip.x < view.wipe.x);
    } else if style > 6.5 {
        colour = scale_colour(mix(in.uv.x, in.uv.y, view.wipe.z));
    } else if style > 5.5 {
        let stroke = filling(in.uv.x, in.clip.xy, 1.2 * unit);
        colour = mix(mix(in.image, vec3<f32>(0.75), 0.55), in.image, stroke);
    } else if style > 4.5 {
        let hatch = stripe(in.clip.x + in.clip.y, 9.0 * unit, 1.6 * unit);
        colour = mix(mix(colour, vec3<f32>(0.62), 0.6), vec3<f32>(0.30), 0.35 * hatch);
    } else if in.clip.x < view.wipe.x {
        // The mesh as it is by itself.
    } else if style > 3.5 {
        // A breath of the place's own colour tells far parts of the pattern apart.
        colour = mix(dark, light, solid) * mix(vec3<f32>(1.0), 0.45 + 1.1 * place_colour(in.image), 0.5);
    } else if style > 2.5 {
        colour = scale_colour(in.values.x);
    } else if style > 1.5 {
        colour = place_colour(in.image);
    }
    return vec4<f32>(lit(colour, in.world, in.normal, in.values.y), 1.0);
}

// A veil of the faces' own colours over the surface, which keeps its light.
@fragment
fn tint_fragment(in: SurfaceOut) -> @location(0) vec4<f32> {
    return vec4<f32>(in.image, 0.55);
}

struct LineOut {
    @builtin(position) clip: vec4<f32>,
    // From the middle of the line in pixels.
    @location(0) across: f32,
};

@vertex
fn line_vertex(
    @location(0) position: vec3<f32>,
    @location(1) other: vec3<f32>,
    @location(2) side: f32,
) -> LineOut {
    // Towards the viewer by some thousandths of the way, so that lines on the surface are not hidden by it.
    let here = view.clip_from_world * vec4<f32>(mix(position, view.eye.xyz, 0.003), 1.0);
    let there = view.clip_from_world * vec4<f32>(mix(other, view.eye.xyz, 0.003), 1.0);
    let size = view.size_and_style.xy;
    let along = (there.xy / there.w - here.xy / here.w) * size;
    let reach = max(length(along), 1e-6);
    let across = vec2<f32>(-along.y, along.x) / reach;
    // A pixel more than the line, where its edge fades.
    let reach_across = sign(side) * (view.size_and_style.w + 1.0);
    var out: LineOut;
    out.clip = here;
    let shift = across * reach_across * 2.0 / size;
    out.clip.x += shift.x * here.w;
    out.clip.y += shift.y * here.w;
    // At the end the direction is reversed: there the other sign means the same edge.
    out.across = select(reach_across, -reach_across, abs(side) > 1.5);
    return out;
}

// How much of a pixel is covered by what begins at distance 0 and lies at negative distances.
fn cover(distance: f32) -> f32 {
    return clamp(0.5 - distance, 0.0, 1.0);
}

// How much of a pixel a line covers, beyond the wipe.
fn line_cover(in: LineOut) -> f32 {
    return select(cover(abs(in.across) - view.size_and_style.w), 0.0, in.clip.x < view.wipe.x);
}

@fragment
fn line_fragment(in: LineOut) -> @location(0) vec4<f32> {
    return vec4<f32>(view.line.rgb, line_cover(in));
}

@fragment
fn hidden_line_fragment(in: LineOut) -> @location(0) vec4<f32> {
    return vec4<f32>(view.line.rgb, view.ways.z * line_cover(in));
}

struct MarkOut {
    @builtin(position) clip: vec4<f32>,
    // From the middle of the line in pixels, and the line's length up to here in dashes.
    @location(0) at: vec2<f32>,
    @location(1) colour: vec3<f32>,
    @location(2) stroke: f32,
};

@vertex
fn mark_vertex(
    @location(0) position: vec3<f32>,
    @location(1) other: vec3<f32>,
    @location(2) side: f32,
    @location(3) colour: vec3<f32>,
    @location(4) stroke: f32,
    @location(5) along: f32,
) -> MarkOut {
    let here = view.clip_from_world * vec4<f32>(mix(position, view.eye.xyz, 0.004), 1.0);
    let there = view.clip_from_world * vec4<f32>(mix(other, view.eye.xyz, 0.004), 1.0);
    let size = view.size_and_style.xy;
    let way = (there.xy / there.w - here.xy / here.w) * size;
    let across = vec2<f32>(-way.y, way.x) / max(length(way), 1e-6);
    let reach = sign(side) * (4.0 * view.size_and_style.w + 1.0);
    var out: MarkOut;
    out.clip = here;
    let shift = across * reach * 2.0 / size;
    out.clip.x += shift.x * here.w;
    out.clip.y += shift.y * here.w;
    out.at = vec2<f32>(select(reach, -reach, abs(side) > 1.5), along / view.wipe.y);
    out.colour = colour;
    out.stroke = stroke;
    return out;
}

// How much of a pixel a stroke covers: solid, dashed, dotted, dashes with points, double, fine.
fn stroke_cover(in: MarkOut) -> f32 {
    let half = view.size_and_style.w;
    let place = fract(in.at.y);
    let body = cover(abs(in.at.x) - 2.0 * half);
    if in.stroke > 4.5 {
        return 0.7 * cover(abs(in.at.x) - 0.6 * half);
    } else if in.stroke > 3.5 {
        return cover(abs(abs(in.at.x) - 2.4 * half) - 1.1 * half);
    } else if in.stroke > 2.5 {
        return select(0.0, body, place < 0.5 || (place > 0.68 && place < 0.82));
    } else if in.stroke > 1.5 {
        return select(0.0, body, fract(3.0 * in.at.y) < 0.45);
    } else if in.stroke > 0.5 {
        return select(0.0, body, place < 0.6);
    }
    return body;
}

@fragment
fn mark_fragment(in: MarkOut) -> @location(0) vec4<f32> {
    return vec4<f32>(in.colour, stroke_cover(in));
}

@fragment
fn hidden_mark_fragment(in: MarkOut) -> @location(0) vec4<f32> {
    return vec4<f32>(in.colour, 0.3 * stroke_cover(in));
}

struct BallOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) colour: vec3<f32>,
};

@vertex
fn ball_vertex(
    @location(0) position: vec3<f32>,
    @location(1) centre: vec3<f32>,
    @location(2) radius: f32,
    @location(3) colour: vec3<f32>,
) -> BallOut {
    var out: BallOut;
    out.world = centre + radius * position;
    out.clip = view.clip_from_world * vec4<f32>(out.world, 1.0);
    out.normal = position;
    out.colour = colour;
    return out;
}

@fragment
fn ball_fragment(in: BallOut) -> @location(0) vec4<f32> {
    return vec4<f32>(lit(in.colour, in.world, in.normal, 0.0), 1.0);
}

struct PinOut {
    @builtin(position) clip: vec4<f32>,
    // From the place in pixels, y up.
    @location(0) at: vec2<f32>,
    @location(1) colour: vec3<f32>,
    // Radius of the head, length of the stem, kind.
    @location(2) shape: vec3<f32>,
};

@vertex
fn pin_vertex(
    @builtin(vertex_index) corner: u32,
    @location(0) base: vec3<f32>,
    @location(1) colour: vec3<f32>,
    @location(2) radius: f32,
    @location(3) stem: f32,
    @location(4) kind: f32,
) -> PinOut {
    // Two triangles: corners 0, 1, 2 and 2, 1, 3 of the box around the pin.
    let corners = array<u32, 6>(0u, 1u, 2u, 2u, 1u, 3u);
    let c = corners[corner];
    let is_right = f32(c & 1u);
    let is_top = f32(c >> 1u);
    let margin = radius + 3.0;
    let at = vec2<f32>(mix(-margin, margin, is_right), mix(-margin, stem + margin, is_top));
    var out: PinOut;
    out.clip = view.clip_from_world * vec4<f32>(base, 1.0);
    let shift = at * 2.0 / view.size_and_style.xy * out.clip.w;
    out.clip.x += shift.x;
    out.clip.y += shift.y;
    // Over everything.
    out.clip.z = 0.0;
    out.at = at;
    out.colour = colour;
    out.shape = vec3<f32>(radius, stem, kind);
    return out;
}

// One colour with an opacity laid over another.
fn over(upper: vec4<f32>, lower: vec4<f32>) -> vec4<f32> {
    let alpha = upper.a + lower.a * (1.0 - upper.a);
    let colour = (upper.rgb * upper.a + lower.rgb * lower.a * (1.0 - upper.a)) / max(alpha, 1e-4);
    return vec4<f32>(colour, alpha);
}

@fragment
fn pin_fragment(in: PinOut) -> @location(0) vec4<f32> {
    let radius = in.shape.x;
    let stem = in.shape.y;
    let head = length(in.at - vec2<f32>(0.0, stem)) - radius;
    let needle = length(in.at - vec2<f32>(0.0, clamp(in.at.y, 0.0, max(stem - radius, 0.0))));
    let rim = view.rim.rgb;
    if in.shape.z > 3.5 {
        var shape = abs(in.at.x) + abs(in.at.y) - radius;
        if in.shape.z > 4.5 {
            let turned = vec2<f32>(in.at.x + in.at.y, in.at.x - in.at.y) * 0.7071;
            let bar = 0.28 * radius;
            shape = min(max(abs(turned.x) - radius, abs(turned.y) - bar), max(abs(turned.y) - radius, abs(turned.x) - bar));
        }
        return over(vec4<f32>(in.colour, cover(shape + 0.5)), vec4<f32>(0.02, 0.02, 0.02, 0.8 * cover(shape - 1.0)));
    }
    if in.shape.z > 2.5 {
        // Proposed: the place shows through the head.
        let hoop = max(cover(abs(head + 1.0) - 1.0), cover(needle - 0.7) * cover(-head));
        let body = over(vec4<f32>(in.colour, hoop), vec4<f32>(in.colour, 0.3 * cover(head)));
        return over(body, vec4<f32>(rim, 0.8 * max(cover(abs(head) - 1.0), cover(needle - 1.7) * cover(-head))));
    }
    if in.shape.z > 1.5 {
        // A ring with a dot in its middle.
        let ring = abs(head) - 1.25;
        let dot_ = needle - 1.5;
        let inner = vec4<f32>(in.colour, max(cover(ring), cover(dot_)));
        return over(inner, vec4<f32>(rim, 0.8 * max(cover(ring - 1.0), cover(dot_ - 1.0))));
    }
    if in.shape.z > 0.5 {
        // Behind the body: an outline.
        let outline = max(cover(abs(head) - 0.75), cover(needle - 0.5) * cover(-head));
        return vec4<f32>(in.colour, 0.5 * outline);
    }
    let stem_line = over(vec4<f32>(in.colour, cover(needle - 0.9)), vec4<f32>(rim, 0.7 * cover(needle - 1.9)));
    let full = over(vec4<f32>(in.colour, cover(head + 1.25)), vec4<f32>(rim, cover(head)));
    return over(full, stem_line);
}
