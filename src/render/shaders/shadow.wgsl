// Depth as the key light sees it.
@vertex
fn vs_shadow(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return g.light_from_scene * vec4<f32>(position, 1.0);
}
