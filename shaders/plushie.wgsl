// Plushies in the window: filled triangles with a fringe, and capsules (round lines, discs, rings; three vertices each).
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
}

@group(0) @binding(0) var<uniform> view: View;

fn to_clip(p: vec2f) -> vec2f {
    return (p - view.center) * view.scale;
}

// Premultiplied, in the light the target wants. `LINEAR_TARGET`, from the renderer: it converts from linear light by itself.
fn shade(color: vec4f, coverage: f32) -> vec4f {
    var rgb = color.rgb;
    if LINEAR_TARGET {
        rgb = select(rgb / 12.92, pow((rgb + 0.055) / 1.055, vec3f(2.4)), rgb > vec3f(0.04045));
    }
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
    // Length, outer and inner radius, physical pixels.
    @location(1) @interpolate(flat) size: vec3f,
    @location(2) @interpolate(flat) color: vec4f,
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
    // A right triangle around the box of what is covered at all: twice as long and as wide, in the same corner.
    let reach = outer + 0.5;
    let corner = index % 3u;
    let x = select(-reach, 2.0 * length + 3.0 * reach, corner == 1u);
    let y = select(-reach, 3.0 * reach, corner == 2u);
    let position = (a + along * x + across * y) / view.half_size;
    let size = vec3f(length, outer, inner * view.pixels_per_point);
    return Capsule(vec4f(position, 0.0, 1.0), vec2f(x, y), size, vec4f(color.rgb, color.a * fade));
}

@fragment
fn capsule_fragment(in: Capsule) -> @location(0) vec4f {
    let off = vec2f(in.local.x - clamp(in.local.x, 0.0, in.size.x), in.local.y);
    let d = length(off);
    var coverage = clamp(in.size.y - d + 0.5, 0.0, 1.0);
    if in.size.z > 0.0 {
        coverage *= clamp(d - in.size.z + 0.5, 0.0, 1.0);
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

// Stuffed felt: `src/picture/plush.rs` says the same for pictures without a graphics adapter, and puts its constants before this file.

struct Felt {
    @builtin(position) position: vec4f,
    // At rest, mm.
    @location(0) rest: vec2f,
    // Of half the square of the height, mm.
    @location(1) slope: vec2f,
    // From the upper left corner of the texture, 0 to 1.
    @location(2) place: vec2f,
    // Half the square of the height, mm^2.
    @location(3) height: f32,
    @location(4) color: vec4f,
}

@vertex
fn felt_vertex(
    @location(0) position: vec2f,
    @location(1) rest: vec2f,
    @location(2) slope: vec2f,
    @location(3) place: vec2f,
    @location(4) height: f32,
    @location(5) color: vec4f,
) -> Felt {
    return Felt(vec4f(to_clip(position), 0.0, 1.0), rest, slope, place, height, color);
}

// Random values at whole places, 0 to 1.
fn knot(i: vec2i) -> f32 {
    let u = bitcast<vec2u>(i);
    var h = (u.x * 0x9E3779B1u) ^ (u.y * 0x85EBCA77u);
    h = (h ^ (h >> 15u)) * 0x2C1B3C6Du;
    return f32((h ^ (h >> 13u)) & 0xFFFFu) / 65535.0;
}

fn noise(p: vec2f) -> f32 {
    let low = floor(p);
    let f = p - low;
    let s = f * f * (3.0 - 2.0 * f);
    let i = vec2i(low);
    let near = mix(knot(i), knot(i + vec2i(1, 0)), s.x);
    let far = mix(knot(i + vec2i(0, 1)), knot(i + vec2i(1, 1)), s.x);
    return mix(near, far, s.y);
}

// Bundles of fibres across each other, -1 to 1.
fn grain(place_mm: vec2f) -> f32 {
    let p = place_mm / BUNDLE_MM;
    let along = noise(vec2f(0.42 * (0.8 * p.x + 0.6 * p.y), 1.3 * (0.8 * p.y - 0.6 * p.x)));
    let across = noise(vec2f(1.3 * (0.9 * p.x - 0.44 * p.y) + 57.0, 0.42 * (0.9 * p.y + 0.44 * p.x) + 31.0));
    return along + across - 1.0;
}

fn felt_tone(in: Felt, base: vec3f) -> vec4f {
    let n = normalize(vec3f(-PUFF * in.slope, sqrt(2.0 * max(in.height, 0.0)) + 1e-3));
    let lit = (dot(n, LIGHT) + WRAP) / (1.0 + WRAP);
    let pixel_mm = 1.0 / (view.scale.x * view.half_size.x);
    let seen = clamp(1.15 - pixel_mm / BUNDLE_MM, 0.0, 1.0);
    var tone = AMBIENT + DIRECT * max(lit, 0.0);
    // The same for all of a view: where pixels are too coarse for the grain, it costs nothing.
    if seen > 0.0 {
        tone *= 1.0 + GRAIN * seen * grain(in.rest);
    }
    let tilt = 1.0 - n.z;
    let sheen = SHEEN * tilt * tilt * tilt;
    return shade(vec4f(clamp(base * tone + sheen, vec3f(0.0), vec3f(1.0)), 1.0), 1.0);
}

@fragment
fn felt_fragment(in: Felt) -> @location(0) vec4f {
    return felt_tone(in, in.color.rgb);
}

@fragment
fn felt_picture_fragment(in: Felt) -> @location(0) vec4f {
    let color = textureSample(skin, skin_sampler, in.place);
    let inside = all(in.place >= vec2f(0.0)) && all(in.place <= vec2f(1.0));
    let over = select(vec4f(0.0), color, inside);
    return felt_tone(in, over.rgb + (1.0 - over.a) * in.color.rgb);
}
