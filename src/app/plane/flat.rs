//! The bending plane's coordinates: what lies outside it is projected.

use crate::model::{Configuration, Pose, Vec3};

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

/// The marks that are at least `least` (mm) from the one kept before: a locus that hardly moves is not a blot.
#[must_use]
pub fn thinned(marks: &[Mark], least: f64) -> Vec<Mark> {
    let mut kept: Vec<Mark> = Vec::new();
    for mark in marks {
        let away = |last: &Mark| (mark.at[0] - last.at[0]).hypot(mark.at[1] - last.at[1]);
        if kept.last().is_none_or(|last| away(last) >= least) {
            kept.push(*mark);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_leaves_the_plane_is_projected() {
        let projection = Projection::of(Configuration::new(0.3, 0.0));
        assert_eq!(projection.point(&Vec3::new(0.001, 0.5, 0.002)), [1.0, 2.0]);
    }

    #[test]
    fn thinning_keeps_marks_apart() {
        let marks: Vec<Mark> = (0..100).map(|k| Mark { time: f64::from(k), at: [0.1 * f64::from(k), 0.0] }).collect();
        let kept = thinned(&marks, 1.0);
        assert!((9..=11).contains(&kept.len()) && kept[0] == marks[0]);
        assert!(kept.windows(2).all(|pair| pair[1].at[0] - pair[0].at[0] >= 1.0));
    }
}
