// The floor: light, shadow and grid in one layer that fades out.
struct Floor {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
}

@vertex
fn vs_ground(@builtin(vertex_index) index: u32) -> Floor {
    let corner = vec2<f32>(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let position = vec3<f32>(g.ground.xy + corner * g.ground.w, g.ground.z);
    return Floor(g.clip_from_scene * vec4<f32>(position, 1.0), position);
}

// Coverage of lines one pixel wide at whole numbers; none where they would lie closer than two pixels.
fn rules(at: vec2<f32>, step_per_pixel: vec2<f32>, width: f32) -> f32 {
    let away = abs(fract(at - 0.5) - 0.5) / max(step_per_pixel, vec2<f32>(1e-9));
    let covered = clamp(vec2<f32>(0.5 * width + 0.5) - away, vec2<f32>(0.0), vec2<f32>(1.0));
    let kept = covered * (1.0 - smoothstep(vec2<f32>(0.2), vec2<f32>(0.5), step_per_pixel));
    return max(kept.x, kept.y);
}

fn over(below: vec4<f32>, rgb: vec3<f32>, alpha: f32) -> vec4<f32> {
    return vec4<f32>(rgb * alpha, alpha) + below * (1.0 - alpha);
}

@fragment
fn fs_ground(in: Floor) -> @location(0) vec4<f32> {
    let spacing = max(g.grid.x, 1e-9);
    let fine = in.position.xy / spacing;
    let coarse = fine / max(g.grid.y, 1.0);
    let width = max(1.0, g.viewport.z);
    let line = max(
        0.45 * rules(fine, fwidth(fine), width),
        rules(coarse, fwidth(coarse), width),
    ) * step(1e-8, g.grid.x);

    let from_middle = distance(in.position.xy, g.ground.xy) / max(g.ground.w, 1e-9);
    let fade = 1.0 - smoothstep(0.15, 1.0, from_middle);
    // From below one looks through the floor.
    let side = select(0.25, 1.0, g.eye.z > in.position.z);

    var dark = 1.0 - lit(in.position, g.shadow.y, 20, in.clip.xy);
    dark *= g.grid.z;
    for (var i = 0; i < 4; i++) {
        let spot = g.contacts[i];
        let off = distance(in.position.xy, spot.xy) / max(spot.z, 1e-9);
        let soft = exp(-2.5 * off * off) * spot.w;
        dark = 1.0 - (1.0 - dark) * (1.0 - soft);
    }

    var layer = vec4<f32>(0.0);
    layer = over(layer, g.glow.rgb, g.glow.a * fade * fade);
    layer = over(layer, g.grid_color.rgb, g.grid_color.a * line * fade);
    layer = over(layer, vec3<f32>(0.02, 0.03, 0.05), dark * sqrt(fade));
    layer *= side;
    // Half a step of noise keeps the soft edges free of bands.
    let grain = (noise(in.clip.xy) - 0.5) / 255.0;
    return clamp(layer + vec4<f32>(0.0, 0.0, 0.0, grain * step(0.004, layer.a)), vec4<f32>(0.0), vec4<f32>(1.0));
}
