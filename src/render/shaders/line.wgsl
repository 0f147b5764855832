// Polylines of constant width on the screen: one strip of four corners for each piece, mitred with its neighbours.
struct Piece {
    // Ends of the piece and its neighbours' far ends; w of `a` and `b` is the length along the line.
    @location(0) before: vec3<f32>,
    @location(1) a: vec4<f32>,
    @location(2) b: vec4<f32>,
    @location(3) after: vec3<f32>,
    @location(4) color: vec4<f32>,
    // Width in points, dash period, drawn part of it, opacity factor when hidden.
    @location(5) style: vec4<f32>,
    @location(6) lift: f32,
}

struct Stroke {
    @builtin(position) clip: vec4<f32>,
    @location(0) color: vec4<f32>,
    // Pixels from the middle, half width in pixels, length along the line in dash periods, drawn part (0: no dashes).
    @location(1) shape: vec4<f32>,
    @location(2) through: f32,
}

fn pixel_of(clip: vec4<f32>) -> vec2<f32> {
    return clip.xy / clip.w * 0.5 * g.viewport.xy;
}

// The part of a–b in front of the near plane: where a goes, and how far along it lies.
fn clipped(a: vec4<f32>, b: vec4<f32>) -> vec2<f32> {
    if a.z >= 0.0 || b.z <= a.z {
        return vec2<f32>(0.0, 0.0);
    }
    return vec2<f32>(clamp(-a.z / (b.z - a.z) + 1e-5, 0.0, 1.0), 1.0);
}

@vertex
fn vs_line(@builtin(vertex_index) index: u32, in: Piece) -> Stroke {
    let clip_a = lifted(in.a.xyz, in.lift);
    let clip_b = lifted(in.b.xyz, in.lift);
    let cut_a = clipped(clip_a, clip_b);
    let cut_b = clipped(clip_b, clip_a);
    let seen_a = mix(clip_a, clip_b, cut_a.x);
    let seen_b = mix(clip_b, clip_a, cut_b.x);

    let pixel_a = pixel_of(seen_a);
    let pixel_b = pixel_of(seen_b);
    var along = pixel_b - pixel_a;
    along = select(vec2<f32>(1.0, 0.0), along / max(length(along), 1e-6), length(along) > 1e-6);

    let at_b = (index & 1u) == 1u;
    let side = select(-1.0, 1.0, (index & 2u) == 2u);
    let neighbour = lifted(select(in.before, in.after, at_b), in.lift);
    let here = select(pixel_a, pixel_b, at_b);
    var normal = vec2<f32>(-along.y, along.x);
    let cut = select(cut_a.y, cut_b.y, at_b);
    if cut < 0.5 && neighbour.z > 0.0 && neighbour.w > 0.0 {
        let next = select(here - pixel_of(neighbour), pixel_of(neighbour) - here, at_b);
        let far = length(next);
        if far > 1e-3 {
            let turned = next / far;
            // Beyond about 120° a mitre grows too long; the corner is cut instead.
            if dot(turned, along) > -0.5 {
                let middle = normalize(along + turned);
                let mitre = vec2<f32>(-middle.y, middle.x);
                normal = mitre / max(dot(mitre, normal), 0.5);
            }
        }
    }

    let half_width = max(0.5 * in.style.x * g.viewport.z, 0.35);
    let reach = half_width + 1.0;
    var clip = select(seen_a, seen_b, at_b);
    clip = vec4<f32>(clip.xy + normal * side * reach * 2.0 / g.viewport.xy * clip.w, clip.zw);

    let length_a = mix(in.a.w, in.b.w, cut_a.x);
    let length_b = mix(in.b.w, in.a.w, cut_b.x);
    let dashed = in.style.y > 0.0;
    let periods = select(0.0, select(length_a, length_b, at_b) / max(in.style.y, 1e-9), dashed);
    return Stroke(
        clip,
        in.color,
        vec4<f32>(side * reach, half_width, periods, select(0.0, in.style.z, dashed)),
        in.style.w,
    );
}

fn stroke(in: Stroke) -> vec4<f32> {
    let per_pixel = max(fwidth(in.shape.z), 1e-6);
    var covered = clamp(in.shape.y + 0.5 - abs(in.shape.x), 0.0, 1.0);
    if in.shape.w > 0.0 {
        let filled = in.shape.w;
        let off = abs(fract(in.shape.z - 0.5 * filled + 0.5) - 0.5) - 0.5 * filled;
        // Dashes too small to be seen become an even tone.
        let dash = clamp(0.5 - off / per_pixel, 0.0, 1.0);
        covered *= mix(dash, filled, smoothstep(0.25, 0.6, per_pixel));
    }
    let alpha = in.color.a * covered;
    return vec4<f32>(in.color.rgb * alpha, alpha);
}

@fragment
fn fs_line(in: Stroke) -> @location(0) vec4<f32> {
    return stroke(in);
}

@fragment
fn fs_line_hidden(in: Stroke) -> @location(0) vec4<f32> {
    return stroke(in) * in.through;
}
