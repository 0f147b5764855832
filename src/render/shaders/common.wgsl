// What every shader of the scene knows. The layout is `uniforms::Globals`.
struct Globals {
    clip_from_scene: mat4x4<f32>,
    light_from_scene: mat4x4<f32>,
    // Eye in the scene; w is how far, in m, a ghost yields to a body in the same place.
    eye: vec4<f32>,
    // Width and height in pixels, pixels per point, how far shadows are looked up off a surface.
    viewport: vec4<f32>,
    // Unit direction toward the light, strength.
    key: vec4<f32>,
    fill: vec4<f32>,
    // Unit direction toward the viewer, strength of the rim light.
    rim: vec4<f32>,
    // Linear colours; w of `sky` is the darkness of shadows on bodies.
    sky: vec4<f32>,
    floor: vec4<f32>,
    // sRGB, premultiplied.
    backdrop_inner: vec4<f32>,
    backdrop_outer: vec4<f32>,
    // Middle x, y, z and radius.
    ground: vec4<f32>,
    // Spacing, every how many lines a strong one, darkness of shadows, unused.
    grid: vec4<f32>,
    // sRGB, straight alpha.
    grid_color: vec4<f32>,
    glow: vec4<f32>,
    // Length of a shadow texel in the scene, softness on the ground in texture units, 1 when there is a map, softness on bodies.
    shadow: vec4<f32>,
    // Middle x, y, radius, darkness.
    contacts: array<vec4<f32>, 4>,
}

@group(0) @binding(0) var<uniform> g: Globals;

fn encode(linear: vec3<f32>) -> vec3<f32> {
    let c = clamp(linear, vec3<f32>(0.0), vec3<f32>(1.0));
    let low = c * 12.92;
    let high = 1.055 * pow(c, vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, low, c <= vec3<f32>(0.0031308));
}

fn decode(srgb: vec3<f32>) -> vec3<f32> {
    let low = srgb / 12.92;
    let high = pow((srgb + 0.055) / 1.055, vec3<f32>(2.4));
    return select(high, low, srgb <= vec3<f32>(0.04045));
}

// Even, unstructured noise in 0..1 for a pixel (Jimenez's interleaved gradient).
fn noise(pixel: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2<f32>(0.06711056, 0.00583715))));
}

// The clip position of a point, with the depth it would have `lift` nearer to the eye.
fn lifted(position: vec3<f32>, lift: f32) -> vec4<f32> {
    let clip = g.clip_from_scene * vec4<f32>(position, 1.0);
    let toward = g.eye.xyz - position;
    let away = length(toward);
    let nearer = position + toward * (min(lift, 0.5 * away) / max(away, 1e-9));
    let raised = g.clip_from_scene * vec4<f32>(nearer, 1.0);
    // Behind the eye nothing is to be seen, and the quotient would lie.
    if raised.w <= 0.0 || clip.w <= 0.0 {
        return clip;
    }
    return vec4<f32>(clip.xy, raised.z / raised.w * clip.w, clip.w);
}
