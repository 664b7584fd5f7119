// Plushies in the window: filled triangles with a fringe, and capsules (round lines, discs, rings).
// Coverage is computed here, so one sample a pixel gives smooth edges.

struct View {
    // Middle of the view, mm.
    center: vec2f,
    // Clip units per mm (y up).
    scale: vec2f,
    // Half the view, physical pixels.
    half_size: vec2f,
    // Physical pixels per logical pixel.
    pixels_per_point: f32,
    // 1 where the target converts from linear light by itself.
    linear_target: f32,
}

@group(0) @binding(0) var<uniform> view: View;

fn to_clip(p: vec2f) -> vec2f {
    return (p - view.center) * view.scale;
}

// Premultiplied, in the light the target wants.
fn shade(color: vec4f, coverage: f32) -> vec4f {
    let gamma = color.rgb;
    let linear = select(gamma / 12.92, pow((gamma + 0.055) / 1.055, vec3f(2.4)), gamma > vec3f(0.04045));
    let rgb = mix(gamma, linear, view.linear_target);
    let alpha = color.a * coverage;
    return vec4f(rgb * alpha, alpha);
}

struct Fill {
    @builtin(position) position: vec4f,
    @location(0) color: vec4f,
    @location(1) coverage: f32,
}

@vertex
fn fill_vertex(
    @location(0) position: vec2f,
    @location(1) outward: vec2f,
    @location(2) coverage: f32,
    @location(3) color: vec4f,
) -> Fill {
    return Fill(vec4f(to_clip(position) + outward / view.half_size, 0.0, 1.0), color, coverage);
}

@fragment
fn fill_fragment(in: Fill) -> @location(0) vec4f {
    return shade(in.color, in.coverage);
}

struct Capsule {
    @builtin(position) position: vec4f,
    // Along and across the segment, physical pixels from its start.
    @location(0) local: vec2f,
    @location(1) @interpolate(flat) length: f32,
    // Outer and inner radius, physical pixels.
    @location(2) @interpolate(flat) radii: vec2f,
    @location(3) @interpolate(flat) color: vec4f,
}

@vertex
fn capsule_vertex(
    @builtin(vertex_index) index: u32,
    @location(0) start: vec2f,
    @location(1) end: vec2f,
    @location(2) radius: f32,
    @location(3) inner: f32,
    @location(4) color: vec4f,
) -> Capsule {
    let a = to_clip(start) * view.half_size;
    let b = to_clip(end) * view.half_size;
    let length = distance(a, b);
    let along = select(vec2f(1.0, 0.0), (b - a) / max(length, 1e-6), length > 1e-6);
    let across = vec2f(-along.y, along.x);
    // Lines thinner than a pixel stay a pixel wide and fade instead.
    let wanted = radius * view.pixels_per_point;
    let outer = max(wanted, 0.5);
    let fade = min(wanted / outer, 1.0);
    let reach = outer + 1.0;
    let x = select(-reach, length + reach, (index & 1u) == 1u);
    let y = select(-reach, reach, (index & 2u) == 2u);
    let position = (a + along * x + across * y) / view.half_size;
    let radii = vec2f(outer, inner * view.pixels_per_point);
    return Capsule(vec4f(position, 0.0, 1.0), vec2f(x, y), length, radii, vec4f(color.rgb, color.a * fade));
}

@fragment
fn capsule_fragment(in: Capsule) -> @location(0) vec4f {
    let off = vec2f(in.local.x - clamp(in.local.x, 0.0, in.length), in.local.y);
    let d = length(off);
    var coverage = clamp(in.radii.x - d + 0.5, 0.0, 1.0);
    if in.radii.y > 0.0 {
        coverage *= clamp(d - in.radii.y + 0.5, 0.0, 1.0);
    }
    return shade(in.color, coverage);
}

@group(1) @binding(0) var skin: texture_2d<f32>;
@group(1) @binding(1) var skin_sampler: sampler;

struct Picture {
    @builtin(position) position: vec4f,
    // From the upper left corner of the texture, 0 to 1.
    @location(0) place: vec2f,
}

@vertex
fn picture_vertex(@location(0) position: vec2f, @location(1) place: vec2f) -> Picture {
    return Picture(vec4f(to_clip(position), 0.0, 1.0), place);
}

@fragment
fn picture_fragment(in: Picture) -> @location(0) vec4f {
    // Its colours are premultiplied.
    let color = textureSample(skin, skin_sampler, in.place);
    // Its outermost pixels do not go on beyond it.
    let inside = all(in.place >= vec2f(0.0)) && all(in.place <= vec2f(1.0));
    return shade(vec4f(color.rgb / max(color.a, 1e-6), color.a), select(0.0, 1.0, inside));
}
