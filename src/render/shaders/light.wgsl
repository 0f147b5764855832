// The shadow map and the studio's light.
@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;

// How much of the key light reaches a point, 0..1, averaged over a spiral of `taps` samples.
fn lit(position: vec3<f32>, softness: f32, taps: i32, pixel: vec2<f32>) -> f32 {
    if g.shadow.z < 0.5 {
        return 1.0;
    }
    let clip = g.light_from_scene * vec4<f32>(position, 1.0);
    let uv = clip.xy * vec2<f32>(0.5, -0.5) + 0.5;
    if any(uv < vec2<f32>(-softness)) || any(uv > vec2<f32>(1.0 + softness)) {
        return 1.0;
    }
    let depth = clamp(clip.z, 0.0, 1.0) - 0.0008;
    // Golden angle, started anew at each pixel, so that the steps of the spiral do not show.
    let start = 6.2831853 * noise(pixel);
    var direction = vec2<f32>(cos(start), sin(start));
    var sum = 0.0;
    for (var i = 0; i < taps; i++) {
        let reach = softness * sqrt((f32(i) + 0.5) / f32(taps));
        sum += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + direction * reach, depth);
        direction = vec2<f32>(
            -0.7373688 * direction.x - 0.6754903 * direction.y,
            0.6754903 * direction.x - 0.7373688 * direction.y,
        );
    }
    return sum / f32(taps);
}

// What polished metal sees in this direction: floor, ceiling and two soft boxes.
fn room(direction: vec3<f32>) -> vec3<f32> {
    let ceiling = smoothstep(-0.55, 0.45, direction.z);
    let ambient = mix(g.floor.rgb * 0.75, g.sky.rgb * 1.7, ceiling);
    let key = smoothstep(0.10, 0.85, dot(direction, g.key.xyz)) * g.key.w * 1.2;
    let fill = smoothstep(0.30, 0.95, dot(direction, g.fill.xyz)) * g.fill.w * 2.4;
    return ambient + vec3<f32>(key + fill);
}

// Light from a surface: albedo in linear colour, material as metal and roughness.
fn shade(albedo: vec3<f32>, metal: f32, rough: f32, normal: vec3<f32>, view: vec3<f32>, reach: f32) -> vec3<f32> {
    let n_v = clamp(dot(normal, view), 0.0, 1.0);
    let n_l = dot(normal, g.key.xyz);
    let direct = clamp(n_l, 0.0, 1.0) * mix(1.0, reach, g.sky.w);
    let fill = clamp(0.7 * dot(normal, g.fill.xyz) + 0.3, 0.0, 1.0);
    let around = mix(g.floor.rgb, g.sky.rgb, 0.5 + 0.5 * normal.z);
    // Where the key light does not come, less of the rest comes too.
    let occlusion = mix(0.82, 1.0, reach);
    let diffuse = albedo * (around * occlusion + vec3<f32>(g.key.w * direct + g.fill.w * fill));

    let half_way = normalize(g.key.xyz + view);
    let gloss = mix(90.0, 6.0, rough);
    let spark = pow(max(dot(normal, half_way), 0.0), gloss) * (1.0 - rough) * reach * step(0.0, n_l);
    let grazing = pow(1.0 - n_v, 4.0);
    let rim = g.rim.w * grazing * (0.5 + 0.5 * normal.z);

    let mirrored = room(reflect(-view, normal));
    // On a light background bright edges would be lost.
    let tint = mix(albedo, vec3<f32>(1.0), grazing * min(1.0, 2.5 * g.rim.w));
    let polished = mirrored * tint * mix(0.8, 1.0, reach) + vec3<f32>(spark * g.key.w * 0.8);
    let dull = diffuse + vec3<f32>(spark * g.key.w * 0.22) + mirrored * grazing * (1.0 - rough) * 0.22;
    let color = mix(dull, mix(diffuse, polished, 0.78), metal) + vec3<f32>(rim);
    // A soft shoulder instead of a hard white.
    let over = max(color - 0.75, vec3<f32>(0.0));
    return min(color, vec3<f32>(0.75)) + over / (1.0 + 2.2 * over);
}
