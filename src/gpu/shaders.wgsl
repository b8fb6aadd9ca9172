// Three things are drawn: surfaces, lines (as ribbons that face the viewer) and balls.
// One uniform block serves all of them; it is rewritten for each of the two views.

struct View {
    // World to clip space.
    clip_from_world: mat4x4<f32>,
    // xyz: the camera's position.
    eye: vec4<f32>,
    // xy: size of the view in pixels; z: surface style (-1 plain and a little behind, 0 shaded, 1 checkerboard, 2 colours,
    // 3 distortion); w: half width of lines in pixels.
    size_and_style: vec4<f32>,
    // rgb: colour of the plain surface.
    surface: vec4<f32>,
    // rgb: colour of lines.
    line: vec4<f32>,
};

@group(0) @binding(0) var<uniform> view: View;

struct SurfaceOut {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) distortion: f32,
};

@vertex
fn surface_vertex(
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
    @location(3) distortion: f32,
) -> SurfaceOut {
    var out: SurfaceOut;
    out.clip = view.clip_from_world * vec4<f32>(position, 1.0);
    out.world = position;
    out.normal = normal;
    out.uv = uv;
    out.distortion = distortion;
    if view.size_and_style.z < -0.5 {
        out.clip.z += 0.004 * out.clip.w;
    }
    return out;
}

// A key light that follows the viewer, light from the sky, and a soft rim.
fn lit(colour: vec3<f32>, world: vec3<f32>, raw_normal: vec3<f32>) -> vec3<f32> {
    let to_eye = normalize(view.eye.xyz - world);
    var normal = normalize(raw_normal);
    normal = select(-normal, normal, dot(normal, to_eye) > 0.0);
    let right = normalize(cross(vec3<f32>(0.0, 1.0, 0.0), to_eye) + vec3<f32>(1e-5, 0.0, 0.0));
    let key = normalize(to_eye + 0.55 * vec3<f32>(0.0, 1.0, 0.0) - 0.45 * right);
    let diffuse = max(dot(normal, key), 0.0);
    let sky = 0.5 + 0.5 * normal.y;
    let half_way = normalize(key + to_eye);
    let gloss = pow(max(dot(normal, half_way), 0.0), 40.0) * 0.12;
    let rim = pow(1.0 - max(dot(normal, to_eye), 0.0), 3.0) * 0.18;
    return colour * (0.72 * diffuse + 0.16 + 0.22 * sky) + vec3<f32>(gloss + rim * 0.6);
}

// A checkerboard filtered over the footprint of the pixel: integral of the square wave (Quilez).
fn checker(p: vec2<f32>) -> f32 {
    let w = max(fwidth(p), vec2<f32>(1e-5));
    let i = 2.0 * (abs(fract((p - 0.5 * w) * 0.5) - 0.5) - abs(fract((p + 0.5 * w) * 0.5) - 0.5)) / w;
    return 0.5 - 0.5 * i.x * i.y;
}

// Distortion by its logarithm, from 1 (none) to 4 and more; the legend of the page has the same colours.
fn distortion_colour(value: f32) -> vec3<f32> {
    let stops = array<vec3<f32>, 5>(
        vec3<f32>(0.913, 0.888, 0.791),
        vec3<f32>(0.930, 0.624, 0.168),
        vec3<f32>(0.871, 0.254, 0.045),
        vec3<f32>(0.546, 0.044, 0.068),
        vec3<f32>(0.105, 0.010, 0.112),
    );
    let place = clamp(2.0 * log2(max(value, 1.0)), 0.0, 4.0);
    var colour = stops[0];
    for (var k = 1; k < 5; k++) {
        colour = mix(colour, stops[k], clamp(place - f32(k - 1), 0.0, 1.0));
    }
    return colour;
}

@fragment
fn surface_fragment(in: SurfaceOut) -> @location(0) vec4<f32> {
    let style = view.size_and_style.z;
    let board = checker(in.uv * 36.0);
    let dark = vec3<f32>(0.035, 0.125, 0.245);
    let light = vec3<f32>(0.86, 0.85, 0.80);
    let hue = vec3<f32>(0.5) + 0.42 * cos(6.2831853 * (in.uv.x * 1.1 + vec3<f32>(0.0, 0.33, 0.67)) + in.uv.y * 4.0);
    var colour = view.surface.rgb;
    if style > 2.5 {
        colour = distortion_colour(in.distortion);
    } else if style > 1.5 {
        colour = hue * mix(0.72, 1.0, board);
    } else if style > 0.5 {
        colour = mix(dark, light, board);
    }
    return vec4<f32>(lit(colour, in.world, in.normal), 1.0);
}

struct LineOut {
    @builtin(position) clip: vec4<f32>,
};

@vertex
fn line_vertex(
    @location(0) position: vec3<f32>,
    @location(1) other: vec3<f32>,
    @location(2) side: f32,
) -> LineOut {
    let here = view.clip_from_world * vec4<f32>(position, 1.0);
    let there = view.clip_from_world * vec4<f32>(other, 1.0);
    let size = view.size_and_style.xy;
    let along = (there.xy / there.w - here.xy / here.w) * size;
    let reach = max(length(along), 1e-6);
    let across = vec2<f32>(-along.y, along.x) / reach;
    var out: LineOut;
    out.clip = here;
    let shift = across * side * view.size_and_style.w * 2.0 / size;
    out.clip.x += shift.x * here.w;
    out.clip.y += shift.y * here.w;
    // Towards the viewer, so that lines on the surface are not hidden by it.
    out.clip.z -= 0.0012 * here.w;
    return out;
}

@fragment
fn line_fragment(in: LineOut) -> @location(0) vec4<f32> {
    return vec4<f32>(view.line.rgb, 1.0);
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
    return vec4<f32>(lit(in.colour, in.world, in.normal), 1.0);
}
