//! What a contact changes in the pose of the end disk.

/// How a contact holds the backbone, as a hypothesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A beam that clamps it: the part below keeps its shape.
    Clamp,
    /// A plane that touches it: the part below goes on changing shape.
    Plane,
}

impl Kind {
    /// All of them.
    pub const ALL: &'static [Self] = &[Self::Clamp, Self::Plane];

    /// As files have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Clamp => "clamp",
            Self::Plane => "plane",
        }
    }
}
