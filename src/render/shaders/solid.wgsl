// Tubes, disks and blocks.
struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec4<f32>,
    // Metal, roughness, ghost, unused.
    @location(3) material: vec4<f32>,
}

struct Surface {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec4<f32>,
    @location(3) material: vec4<f32>,
}

@vertex
fn vs_solid(in: Vertex) -> Surface {
    return Surface(
        lifted(in.position, -g.eye.w * in.material.z),
        in.position,
        in.normal,
        in.color,
        in.material,
    );
}

@fragment
fn fs_solid(in: Surface) -> @location(0) vec4<f32> {
    let normal = normalize(in.normal);
    let view = normalize(g.eye.xyz - in.position);
    let facing = clamp(dot(normal, view), 0.0, 1.0);
    let edge = (1.0 - facing) * (1.0 - facing);
    if in.material.z > 0.5 {
        let alpha = in.color.a * mix(0.45, 1.0, edge);
        return vec4<f32>(in.color.rgb * alpha, alpha);
    }
    let raised = in.position + normal * g.viewport.w;
    let reach = lit(raised, g.shadow.w, 6, in.clip.xy);
    let linear = shade(decode(in.color.rgb), in.material.x, in.material.y, normal, view, reach);
    // A plate seen from the side is thicker to the eye.
    let alpha = mix(in.color.a, 1.0, 0.7 * edge * step(in.color.a, 0.999));
    return vec4<f32>(encode(linear) * alpha, alpha);
}
