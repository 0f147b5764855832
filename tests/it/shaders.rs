//! Every shader is valid WGSL and can be said in the GLSL of WebGL2.

use centrode::render::SHADERS;
use naga::{
    back::glsl,
    proc::BoundsCheckPolicies,
    valid::{Capabilities, ValidationFlags, Validator},
};

fn checked(name: &str, source: &str) -> (naga::Module, naga::valid::ModuleInfo) {
    let module =
        naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(source)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(source)));
    (module, info)
}

#[test]
fn every_shader_is_valid_and_translates_to_webgl2() {
    let options =
        glsl::Options { version: glsl::Version::Embedded { version: 300, is_webgl: true }, ..Default::default() };
    for (name, source) in SHADERS {
        let (module, info) = checked(name, source);
        assert!(!module.entry_points.is_empty(), "{name}");
        for entry in &module.entry_points {
            let pipeline =
                glsl::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.clone(), multiview: None };
            let mut text = String::new();
            glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, BoundsCheckPolicies::default())
                .and_then(|mut writer| writer.write())
                .unwrap_or_else(|e| panic!("{name}/{}: {e}", entry.name));
            assert!(text.starts_with("#version 300 es"), "{name}");
        }
    }
}

#[test]
fn no_shader_needs_what_webgl2_has_not() {
    for (name, source) in SHADERS {
        let (module, _) = checked(name, source);
        for (_, variable) in module.global_variables.iter() {
            let storage = matches!(variable.space, naga::AddressSpace::Storage { .. });
            assert!(!storage, "{name}: a storage buffer");
        }
    }
}
