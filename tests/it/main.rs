//! Integration tests.

#[cfg(feature = "app")]
mod gpu;
#[cfg(feature = "app")]
mod render;
#[cfg(feature = "app")]
mod shaders;
