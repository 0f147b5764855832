// The background: a soft pool of light behind the middle.
struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
}

@vertex
fn vs_backdrop(@builtin(vertex_index) index: u32) -> Corner {
    let at = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0;
    return Corner(vec4<f32>(at, 0.0, 1.0), at);
}

@fragment
fn fs_backdrop(in: Corner) -> @location(0) vec4<f32> {
    let away = length((in.at - vec2<f32>(0.0, 0.1)) * vec2<f32>(0.8, 0.9));
    let color = mix(g.backdrop_inner, g.backdrop_outer, smoothstep(0.15, 1.25, away));
    // Half a step of noise keeps a dark gradient free of bands.
    let grain = (noise(in.clip.xy) - 0.5) / 255.0;
    return vec4<f32>(clamp(color.rgb + grain, vec3<f32>(0.0), vec3<f32>(color.a)), color.a);
}
