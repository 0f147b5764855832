// Signs of constant size on the screen, drawn by their distance functions.
struct Sign {
    // Place, width in points.
    @location(0) place: vec4<f32>,
    @location(1) fill: vec4<f32>,
    @location(2) outline: vec4<f32>,
    // Width of the edge in points, opacity, pulse, opacity factor when hidden.
    @location(3) style: vec4<f32>,
    @location(4) lift: f32,
    @location(5) shape: u32,
}

struct Billboard {
    @builtin(position) clip: vec4<f32>,
    // Points from the middle, y up.
    @location(0) at: vec2<f32>,
    @location(1) fill: vec4<f32>,
    @location(2) outline: vec4<f32>,
    @location(3) style: vec4<f32>,
    @location(4) half_size: f32,
    @location(5) @interpolate(flat) shape: u32,
}

@vertex
fn vs_marker(@builtin(vertex_index) index: u32, in: Sign) -> Billboard {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let half_size = 0.5 * in.place.w;
    let pulsing = in.style.z > 0.0 && in.style.z < 1.0;
    let still = half_size * 1.2 + in.style.x;
    let reach = max(still, select(0.0, half_size * 3.0 + 3.0, pulsing)) + 1.5;
    let clip = lifted(in.place.xyz, in.lift);
    let shift = corner * reach * g.viewport.z * 2.0 / g.viewport.xy;
    return Billboard(
        vec4<f32>(clip.xy + shift * clip.w, clip.zw),
        corner * reach,
        in.fill,
        in.outline,
        in.style,
        half_size,
        in.shape,
    );
}

fn triangle(at: vec2<f32>, half_side: f32) -> f32 {
    let k = sqrt(3.0);
    var p = vec2<f32>(abs(at.x) - half_side, at.y + half_side / k);
    if p.x + k * p.y > 0.0 {
        p = vec2<f32>(p.x - k * p.y, -k * p.x - p.y) / 2.0;
    }
    p.x -= clamp(p.x, -2.0 * half_side, 0.0);
    return -length(p) * sign(p.y);
}

fn cross_of(at: vec2<f32>, half_size: f32) -> f32 {
    var p = abs(at);
    if p.y > p.x {
        p = p.yx;
    }
    let q = p - vec2<f32>(half_size, half_size * 0.3);
    let k = max(q.y, q.x);
    let w = select(vec2<f32>(half_size * 0.3 - p.x, -k), q, k > 0.0);
    return sign(k) * length(max(w, vec2<f32>(0.0)));
}

// Signed distance to the form, in points; negative inside.
fn form(shape: u32, at: vec2<f32>, half_size: f32) -> f32 {
    switch shape {
        case 1u: {
            let low = at + vec2<f32>(0.0, half_size * 0.12);
            return triangle(low, half_size * 1.02) - 0.06 * half_size;
        }
        case 2u: { return length(at) - 0.55 * half_size; }
        case 3u: { return cross_of(at, half_size); }
        case 4u: { return (abs(at.x) + abs(at.y) - 1.15 * half_size) * 0.70710678; }
        case 5u: {
            let stroke = max(0.9, 0.12 * half_size);
            return abs(length(at) - half_size + stroke) - stroke;
        }
        default: { return length(at) - half_size; }
    }
}

fn sign_color(in: Billboard) -> vec4<f32> {
    let scale = g.viewport.z;
    let away = form(in.shape, in.at, in.half_size) * scale;
    let inside = clamp(0.5 - away, 0.0, 1.0);
    let with_edge = clamp(0.5 - away + in.style.x * scale, 0.0, 1.0);
    let fill = inside * in.fill.a;
    let edge = (with_edge - inside) * in.outline.a;
    var color = vec4<f32>(in.fill.rgb * fill + in.outline.rgb * edge, fill + edge) * in.style.y;
    let pulse = in.style.z;
    if pulse > 0.0 && pulse < 1.0 {
        let out = 1.0 - (1.0 - pulse) * (1.0 - pulse);
        let radius = in.half_size * (1.1 + 1.7 * out);
        let stroke = mix(1.6, 0.5, pulse);
        let ring = clamp(0.5 - (abs(length(in.at) - radius) - stroke) * scale, 0.0, 1.0);
        let alpha = ring * (1.0 - pulse) * smoothstep(0.0, 0.12, pulse) * in.fill.a * in.style.y;
        color += vec4<f32>(in.fill.rgb * alpha, alpha) * (1.0 - color.a);
    }
    return color;
}

@fragment
fn fs_marker(in: Billboard) -> @location(0) vec4<f32> {
    return sign_color(in);
}

@fragment
fn fs_marker_hidden(in: Billboard) -> @location(0) vec4<f32> {
    return sign_color(in) * in.style.w;
}
