//! The interface's colours, one per meaning.

use egui::Color32;

/// Colours for the current background.
#[derive(Debug, Clone, Copy)]
pub struct Theme {
    /// Whether the background is dark.
    pub dark: bool,
    /// The model without constraint.
    pub model: Color32,
    /// The model with the constraint.
    pub constrained: Color32,
    /// What the sensor says.
    pub sensor: Color32,
    /// A detection.
    pub detection: Color32,
    /// The robot.
    pub robot: Color32,
    /// The beam.
    pub obstacle: Color32,
    /// Text.
    pub ink: Color32,
    /// Secondary text.
    pub dim: Color32,
    /// Lines that should hardly be seen.
    pub faint: Color32,
    /// Background of the page.
    pub surface: Color32,
    /// Background of a panel.
    pub panel: Color32,
    /// What can be moved.
    pub accent: Color32,
}

impl Theme {
    /// The colours for the visuals in force.
    #[must_use]
    pub fn of(ui: &egui::Ui) -> Self {
        let hex = |rgb: u32| Color32::from_rgb((rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8);
        if ui.visuals().dark_mode {
            Self {
                dark: true,
                model: hex(0x0056_A9DE),
                constrained: hex(0x00F0_B03A),
                sensor: hex(0x002B_C495),
                detection: hex(0x00FF_7F3A),
                robot: hex(0x00D3_DAE2),
                obstacle: hex(0x008C_8477),
                ink: hex(0x00E6_EBF0),
                dim: hex(0x0093_A0AE),
                faint: hex(0x002E_3641),
                surface: hex(0x0014_181D),
                panel: hex(0x001B_2027),
                accent: hex(0x0056_A9DE),
            }
        } else {
            Self {
                dark: false,
                model: hex(0x0000_72B2),
                constrained: hex(0x00E6_9F00),
                sensor: hex(0x0000_9E73),
                detection: hex(0x00D5_5E00),
                robot: hex(0x0066_7280),
                obstacle: hex(0x005D_5850),
                ink: hex(0x001D_232B),
                dim: hex(0x0066_707C),
                faint: hex(0x00DD_E2E8),
                surface: hex(0x00F4_F6F8),
                panel: hex(0x00FF_FFFF),
                accent: hex(0x0000_72B2),
            }
        }
    }
}
