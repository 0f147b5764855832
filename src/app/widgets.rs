//! Widgets that egui lacks, or has in another shape.

pub mod button;
pub mod field;
pub mod finger;
pub mod focus;
pub mod icon;
pub mod rail;
pub mod segmented;
pub mod slider;
pub mod symbol;
pub mod text;
pub mod toggle;
