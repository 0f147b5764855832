//! Every shader of the page in the GLSL of WebGL2, for browsers without WebGPU (`web/webgl.js`): translated here rather than by the program,
//! for whom the translator would be a tenth of what a visitor loads.

use super::linked::Part;
use anyhow::{Context, Result, ensure};
use naga::back::glsl;
use naga::proc::BoundsCheckPolicies;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga::{Handle, ResourceBinding, ShaderStage};
use serde_json::{Map, Value, json};
use std::fs;

#[path = "../../../src/render/shaders.rs"]
mod scene;

/// Its name among the parts.
pub const NAME: &str = "shaders.js";
/// The package that draws the interface, and its shaders.
const INTERFACE: (&str, &str) = ("egui-wgpu", "src/egui.wgsl");

/// The module with all of them, by entry point.
pub fn module(parts: &[Part]) -> Result<Vec<u8>> {
    let (package, path) = INTERFACE;
    let part = parts.iter().find(|part| part.package.name == package).with_context(|| package.to_owned())?;
    let path = part.package.folder.join(path);
    let interface = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    let shaders = translated(scene::SHADERS.into_iter().chain([(package, interface.as_str())]))?;
    Ok(format!("// Made by the build.\nexport const SHADERS = {};\n", Value::Object(shaders)).into_bytes())
}

fn translated<'a>(sources: impl Iterator<Item = (&'a str, &'a str)>) -> Result<Map<String, Value>> {
    let mut shaders = Map::new();
    for (name, source) in sources {
        let module = naga::front::wgsl::parse_str(source)
            .map_err(|error| anyhow::anyhow!("{name}: {}", error.emit_to_string(source)))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .map_err(|error| anyhow::anyhow!("{name}: {}", error.emit_to_string(source)))?;
        for entry in &module.entry_points {
            let shader =
                entry_point(&module, &info, entry, sum(source)).with_context(|| format!("{name}: {}", entry.name))?;
            ensure!(shaders.insert(entry.name.clone(), shader).is_none(), "two shaders are called {}", entry.name);
        }
    }
    Ok(shaders)
}

/// An entry point, and where what it reads is bound.
fn entry_point(module: &naga::Module, info: &ModuleInfo, entry: &naga::EntryPoint, sum: u32) -> Result<Value> {
    // Rows from the top and depths from 0, as in WebGPU.
    let options = glsl::Options {
        version: glsl::Version::Embedded { version: 300, is_webgl: true },
        writer_flags: glsl::WriterFlags::ADJUST_COORDINATE_SPACE,
        ..Default::default()
    };
    let pipeline =
        glsl::PipelineOptions { shader_stage: entry.stage, entry_point: entry.name.clone(), multiview: None };
    let mut text = String::new();
    let reflection =
        glsl::Writer::new(&mut text, module, info, &options, &pipeline, BoundsCheckPolicies::default())?.write()?;
    let place = |handle: Handle<naga::GlobalVariable>| {
        let ResourceBinding { group, binding } = module.global_variables[handle].binding.context("bound nowhere")?;
        anyhow::Ok(json!({ "group": group, "binding": binding }))
    };
    let named = |name: &String, mut place: Value| {
        place["name"] = json!(name);
        place
    };
    // In one order, whichever way the translator keeps them: two builds of one commit are the same.
    let mut uniforms: Vec<_> = reflection.uniforms.iter().collect();
    uniforms.sort_by_key(|uniform| uniform.1);
    let uniforms = uniforms.into_iter().map(|(&handle, name)| Ok(named(name, place(handle)?)));
    let mut textures: Vec<_> = reflection.texture_mapping.iter().collect();
    textures.sort_by_key(|texture| texture.0);
    let textures = textures.into_iter().map(|(name, mapping)| {
        let mut texture = named(name, place(mapping.texture)?);
        texture["sampler"] = mapping.sampler.map(place).transpose()?.into();
        Ok(texture)
    });
    let stage = if entry.stage == ShaderStage::Vertex { "vertex" } else { "fragment" };
    Ok(json!({
        "stage": stage,
        "sum": sum,
        "glsl": text,
        "uniforms": uniforms.collect::<Result<Vec<_>>>()?,
        "textures": textures.collect::<Result<Vec<_>>>()?,
    }))
}

/// As `sum` of `web/webgl-pipelines.js`: FNV-1a of the units of a text.
fn sum(text: &str) -> u32 {
    text.encode_utf16().fold(0x811c_9dc5, |sum, unit| (sum ^ u32::from(unit)).wrapping_mul(0x0100_0193))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_point_says_where_what_it_reads_is_bound() {
        let shaders = translated(scene::SHADERS.into_iter()).unwrap();
        let mut names: Vec<_> = shaders.keys().map(String::as_str).collect();
        names.sort_unstable();
        let vertex = ["vs_backdrop", "vs_blit", "vs_ground", "vs_line", "vs_marker", "vs_shadow", "vs_solid"];
        let fragment =
            ["fs_backdrop", "fs_blit", "fs_blit_srgb", "fs_ground", "fs_line", "fs_line_hidden", "fs_marker"];
        assert_eq!(names, [&fragment[..], &["fs_marker_hidden", "fs_solid"], &vertex].concat());
        let solid = &shaders["fs_solid"];
        assert_eq!(solid["stage"], "fragment");
        assert!(solid["glsl"].as_str().unwrap().starts_with("#version 300 es"));
        assert_eq!((&solid["uniforms"][0]["group"], &solid["uniforms"][0]["binding"]), (&json!(0), &json!(0)));
        let shadow = &solid["textures"][0];
        assert_eq!((&shadow["group"], &shadow["binding"]), (&json!(1), &json!(0)));
        assert_eq!(shadow["sampler"], json!({ "group": 1, "binding": 1 }));
        assert!(shaders["vs_shadow"]["textures"].as_array().unwrap().is_empty());
    }

    #[test]
    fn a_name_is_taken_once_and_what_cannot_be_read_is_named() {
        let shader = "@vertex fn vs() -> @builtin(position) vec4<f32> { return vec4<f32>(); }";
        let twice = translated([("one", shader), ("other", shader)].into_iter()).unwrap_err().to_string();
        assert_eq!(twice, "two shaders are called vs");
        assert!(translated([("broken", "fn")].into_iter()).unwrap_err().to_string().starts_with("broken: "));
    }

    #[test]
    fn a_text_has_the_sum_that_the_page_computes() {
        assert_eq!(sum(""), 0x811c_9dc5);
        assert_eq!(sum("a"), 0xe40c_292c);
    }
}
