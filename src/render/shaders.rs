//! The shaders, in WGSL. The build of the page reads this file, too: it depends on nothing.

macro_rules! shader {
    ($($file:literal),+) => { concat!($(include_str!(concat!("shaders/", $file, ".wgsl")), "\n"),+) };
}

pub const SOLID: &str = shader!("common", "light", "solid");
pub const SHADOW: &str = shader!("common", "shadow");
pub const GROUND: &str = shader!("common", "light", "ground");
pub const LINE: &str = shader!("common", "line");
pub const MARKER: &str = shader!("common", "marker");
pub const BACKDROP: &str = shader!("common", "backdrop");
pub const BLIT: &str = shader!("blit");

/// Every shader by name, in WGSL: for the build, which translates them for WebGL.
pub const SHADERS: [(&str, &str); 7] = [
    ("solid", SOLID),
    ("shadow", SHADOW),
    ("ground", GROUND),
    ("line", LINE),
    ("marker", MARKER),
    ("backdrop", BACKDROP),
    ("blit", BLIT),
];
