//! Pose and Jacobian at any point of a circular arc (Eqs. 3–9, as corrected in `docs/MODEL.md`).

use super::special::Angle;
use super::{Configuration, Mat3, Rate, Twist, Vec3, centrode};

/// A frame's pose in {B}, or in the frame at the arc's start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Origin, in m.
    pub position: Vec3,
    /// Rotation `base_from_frame`.
    pub rotation: Mat3,
}

/// A circular arc: the primary backbone of a segment, or of the part above a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Arc length in m, not negative.
    pub length: f64,
    /// Shape; its bend is that of the whole arc.
    pub configuration: Configuration,
}

impl Arc {
    /// The share of the arc below `s`, exact at the tip even for an arc of no length.
    fn share(&self, s: f64) -> f64 {
        if s == self.length { 1.0 } else { s / self.length }
    }

    /// Pose of frame {S} at arc length `s` (m, within the arc), in the frame at the arc's start (Eqs. 3, 4).
    #[must_use]
    pub fn pose(&self, s: f64) -> Pose {
        self.pose_and_jacobian(s).0
    }

    /// Jacobian of frame {S} at arc length `s` (m, within the arc) with respect to (θL, δ) (Eqs. 7–9, corrected).
    #[must_use]
    pub fn jacobian(&self, s: f64) -> Jacobian {
        self.pose_and_jacobian(s).1
    }

    /// Both at once: they share every sine.
    #[must_use]
    pub fn pose_and_jacobian(&self, s: f64) -> (Pose, Jacobian) {
        let (sd, cd) = self.configuration.sin_cos_delta();
        let bend = self.configuration.bend();
        let share = self.share(s);
        let angle = Angle::new(bend * share);
        let (sin, cos, versine) = (angle.sine(), angle.cosine(), angle.versine());
        let versine_ratio = angle.value() * angle.versinc();
        let pose = Pose {
            position: Vec3::new(s * cd * versine_ratio, -s * sd * versine_ratio, s * angle.sinc()),
            rotation: Mat3::new(
                1.0 - versine * cd * cd,
                versine * sd * cd,
                sin * cd,
                versine * sd * cd,
                1.0 - versine * sd * sd,
                -sin * sd,
                -sin * cd,
                sin * sd,
                cos,
            ),
        };
        let along = -s * share * angle.versine_ratio_slope();
        let across = s * share * angle.versinc();
        let jacobian = Jacobian {
            theta_l: Twist {
                linear: Vec3::new(cd * along, -sd * along, s * share * angle.sinc_drop()),
                angular: Vec3::new(-share * sd, -share * cd, 0.0),
            },
            delta_per_bend: Twist {
                linear: Vec3::new(-sd * across, -cd * across, 0.0),
                angular: Vec3::new(share * angle.sinc() * cd, -share * angle.sinc() * sd, -share * versine_ratio),
            },
            bend,
        };
        (pose, jacobian)
    }
}

/// The Jacobian J_xψ of one frame, by columns.
///
/// The δ column vanishes with the bend, so it is kept divided by φ: what divides by the bend elsewhere
/// (the centrode's limit, the joint forces) takes [`Jacobian::delta_per_bend`] and stays exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jacobian {
    /// ∂/∂θL: m/rad and 1.
    pub theta_l: Twist,
    /// (∂/∂δ)/φ: m/rad² and 1/rad.
    pub delta_per_bend: Twist,
    /// φ in rad.
    pub bend: f64,
}

impl Jacobian {
    /// ∂/∂δ: m/rad and 1.
    #[must_use]
    pub fn delta(&self) -> Twist {
        self.delta_per_bend * self.bend
    }

    /// The twist for the configuration's velocity (Eq. 7): m/s and rad/s.
    #[must_use]
    pub fn twist(&self, rate: Rate) -> Twist {
        self.theta_l * rate.theta_l + self.delta() * rate.delta
    }

    /// The centrode of a frame at `position` that moves along `rate` (Eq. 17), in m.
    ///
    /// Only the direction of the rate matters, so the centrode is the same however slow the motion, and a
    /// motion in δ alone keeps its limit at the straight configuration. `None` when the rate is zero.
    #[must_use]
    pub fn centrode(&self, position: &Vec3, rate: Rate) -> Option<Vec3> {
        let across = rate.delta * self.bend;
        let size = rate.theta_l.abs().max(across.abs());
        let direction = if size > 0.0 {
            self.theta_l * (rate.theta_l / size) + self.delta_per_bend * (across / size)
        } else if rate.delta != 0.0 {
            self.delta_per_bend
        } else {
            return None;
        };
        centrode::centrode(position, &direction)
    }

    /// Rows as in the paper: linear above angular; columns θL, δ.
    #[must_use]
    pub fn to_rows(&self) -> [[f64; 2]; 6] {
        let (theta, delta) = (self.theta_l.to_array(), self.delta().to_array());
        std::array::from_fn(|row| [theta[row], delta[row]])
    }
}
