//! The bending plane's coordinates: what lies outside it is projected.

use centrode_core::model::{Configuration, Pose, Vec3};

/// Millimetres per metre.
pub const MM: f64 = 1e3;

/// A point of the plane: along `(cos δ, −sin δ, 0)` and along z, mm.
pub type Flat = [f64; 2];

/// The plane through z in which the segment bends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Projection {
    sin: f64,
    cos: f64,
}

impl Projection {
    /// The bending plane of a configuration.
    #[must_use]
    pub fn of(configuration: Configuration) -> Self {
        let (sin, cos) = configuration.sin_cos_delta();
        Self { sin, cos }
    }

    /// A point of {B} (m), projected (mm).
    #[must_use]
    pub fn point(&self, p: &Vec3) -> Flat {
        [(p.x * self.cos - p.y * self.sin) * MM, p.z * MM]
    }

    /// The direction across the backbone at a frame, toward the side that positive bend turns to.
    #[must_use]
    pub fn across(&self, pose: &Pose) -> Flat {
        let tangent = pose.rotation.column(2).into_owned();
        let [u, v] = self.point(&tangent).map(|x| x / MM);
        [v, -u]
    }
}

/// A point `distance` (mm) from `at` along `direction`.
#[must_use]
pub fn shifted(at: Flat, direction: Flat, distance: f64) -> Flat {
    [at[0] + distance * direction[0], at[1] + distance * direction[1]]
}

/// Where something was at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark {
    /// s.
    pub time: f64,
    /// mm.
    pub at: Flat,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_leaves_the_plane_is_projected() {
        let projection = Projection::of(Configuration::new(0.3, 0.0));
        assert_eq!(projection.point(&Vec3::new(0.001, 0.5, 0.002)), [1.0, 2.0]);
    }
}
