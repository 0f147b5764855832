// Lays the finished picture over the target.
@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

@vertex
fn vs_blit(@builtin(vertex_index) index: u32) -> Corner {
    let uv = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    return Corner(vec4<f32>(uv * vec2<f32>(2.0, -2.0) + vec2<f32>(-1.0, 1.0), 0.0, 1.0), uv);
}

@fragment
fn fs_blit(in: Corner) -> @location(0) vec4<f32> {
    return textureSampleLevel(picture, picture_sampler, in.uv, 0.0);
}

// For a target that encodes by itself.
@fragment
fn fs_blit_srgb(in: Corner) -> @location(0) vec4<f32> {
    let c = textureSampleLevel(picture, picture_sampler, in.uv, 0.0);
    let straight = c.rgb / max(c.a, 1e-6);
    let low = straight / 12.92;
    let high = pow((straight + 0.055) / 1.055, vec3<f32>(2.4));
    return vec4<f32>(select(high, low, straight <= vec3<f32>(0.04045)) * c.a, c.a);
}
