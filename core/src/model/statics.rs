//! Energy, its gradient, joint forces and the joint force deviation (Eqs. 10–16).

use super::joints::joint_jacobian_per_bend;
use super::{Arc, Configuration, Jacobian, Vec3, Wrench};
use libm::sqrt;

/// What one segment is made of.
///
/// ```
/// use centrode_core::model::{Configuration, Vec3};
/// use centrode_core::scenario::Scenario;
///
/// let segment = Scenario::default().robot.segment();
/// let bent = Configuration::new(1.0, 0.0);
/// // Load cells that read what the model expects leave no joint force deviation Θ (Eq. 12).
/// let tau: Vec3 = segment.forces_from_load(&bent, &segment.energy_gradient(&bent));
/// assert!(segment.residual(&bent, &tau) < 1e-12);
/// assert!(segment.residual(&bent, &(1.1 * tau)) > 1e-3, "N·m");
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Length L of the primary backbone, m.
    pub length: f64,
    /// Radius r of the pitch circle on which the secondary backbones stand, m.
    pub pitch_radius: f64,
    /// Bending stiffness E_P I_P of the primary backbone, N·m².
    pub ep_ip: f64,
    /// Bending stiffness E_S I_S of each secondary backbone, N·m².
    pub es_is: f64,
}

/// A generalised force on ψ = (θL, δ), in N·m; the δ part is kept divided by φ, like [`Jacobian`]'s column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Covector {
    /// θL part, N·m.
    pub theta_l: f64,
    /// δ part over φ, N·m/rad.
    pub delta_per_bend: f64,
    /// φ in rad.
    pub bend: f64,
}

impl Covector {
    /// δ part, N·m.
    #[must_use]
    pub fn delta(&self) -> f64 {
        self.delta_per_bend * self.bend
    }

    /// Euclidean length, N·m.
    #[must_use]
    pub fn norm(&self) -> f64 {
        sqrt(self.norm_squared())
    }

    /// Square of [`Covector::norm`], N²·m².
    #[must_use]
    pub fn norm_squared(&self) -> f64 {
        let delta = self.delta();
        self.theta_l * self.theta_l + delta * delta
    }

    /// `self − other`, both of one configuration.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        Self {
            theta_l: self.theta_l - other.theta_l,
            delta_per_bend: self.delta_per_bend - other.delta_per_bend,
            bend: self.bend,
        }
    }
}

impl Jacobian {
    /// J_xψᵀ W_e, N·m: what a wrench on the frame asks of ψ (Eq. 11).
    #[must_use]
    pub fn transposed_times(&self, wrench: &Wrench) -> Covector {
        Covector {
            theta_l: self.theta_l.power(wrench),
            delta_per_bend: self.delta_per_bend.power(wrench),
            bend: self.bend,
        }
    }
}

impl Segment {
    /// Bending stiffness EI of the whole segment, N·m²: of its primary and its three secondary backbones.
    #[must_use]
    pub fn bending_stiffness(&self) -> f64 {
        self.ep_ip + 3.0 * self.es_is
    }

    /// The primary backbone in a configuration.
    #[must_use]
    pub fn arc(&self, configuration: Configuration) -> Arc {
        Arc { length: self.length, configuration }
    }

    /// A segment of the same backbones, `length` m long: the part above a contact.
    #[must_use]
    pub fn shortened(&self, length: f64) -> Self {
        Self { length, ..*self }
    }

    /// Length of the shortest secondary backbone over every direction at this bend, m: L − r|φ|.
    ///
    /// The model holds while it is positive.
    #[must_use]
    pub fn shortest_backbone(&self, bend: f64) -> f64 {
        self.length - self.pitch_radius * bend.abs()
    }

    /// Elastic energy (Eq. 10), J.
    #[must_use]
    pub fn energy(&self, configuration: &Configuration) -> f64 {
        let bend = configuration.bend();
        let compliance = self.secondary_compliance(configuration);
        bend * bend / (2.0 * self.length) * (self.ep_ip + self.es_is * compliance.sum)
    }

    /// Gradient of the energy with respect to (θL, δ), terms through Lᵢ(θL, δ) included, N·m.
    #[must_use]
    pub fn energy_gradient(&self, configuration: &Configuration) -> Covector {
        let bend = configuration.bend();
        let compliance = self.secondary_compliance(configuration);
        let through_lengths = -self.pitch_radius / self.length * compliance.slope;
        let by_bend = bend / self.length * (self.ep_ip + self.es_is * (compliance.sum + 0.5 * bend * through_lengths));
        Covector {
            theta_l: -by_bend,
            delta_per_bend: bend / (2.0 * self.length) * self.es_is * compliance.slope_delta,
            bend,
        }
    }

    /// Σ L/Lᵢ and its slopes.
    ///
    /// With `a = −rφ/L` and `Lᵢ = L(1 + a cos δᵢ)`, the three `cos δᵢ` are the roots of `4c³ − 3c = cos 3δ`, so
    /// the sums have closed forms in which the cancellations of the plain sums are already done.
    fn secondary_compliance(&self, configuration: &Configuration) -> Compliance {
        let (s, c) = configuration.sin_cos_delta();
        let a = -self.pitch_radius * configuration.bend() / self.length;
        let cos_3 = c * (4.0 * c * c - 3.0);
        let sin_3 = s * (3.0 - 4.0 * s * s);
        let top = 3.0 - 0.75 * a * a;
        let product = 1.0 + a * a * (-0.75 + 0.25 * a * cos_3);
        let square = product * product;
        Compliance {
            sum: top / product,
            slope: a * (-1.5 * product + top * (1.5 - 0.75 * a * cos_3)) / square,
            slope_delta: 0.75 * a * a * a * sin_3 * top / square,
        }
    }

    /// Joint forces τ that hold the configuration against its energy and a tip wrench (Eq. 11), N.
    ///
    /// Two equations for three forces: the least-norm solution, plus `preload` (N) on each backbone, which
    /// spans the null space of J_qψᵀ. The second equation vanishes with the bend; its solution keeps its limit.
    /// `jacobian` is that of the tip.
    #[must_use]
    pub fn joint_forces(
        &self,
        configuration: &Configuration,
        jacobian: &Jacobian,
        wrench: &Wrench,
        preload: f64,
    ) -> Vec3 {
        let load = self.energy_gradient(configuration).minus(&jacobian.transposed_times(wrench));
        self.forces_from_load(configuration, &load).add_scalar(preload)
    }

    /// The least-norm τ with J_qψᵀ τ = `load`, N.
    #[must_use]
    pub fn forces_from_load(&self, configuration: &Configuration, load: &Covector) -> Vec3 {
        let (theta, delta_per_bend) = joint_jacobian_per_bend(self.pitch_radius, configuration);
        let scale = 2.0 / (3.0 * self.pitch_radius * self.pitch_radius);
        (theta * load.theta_l + delta_per_bend * load.delta_per_bend) * scale
    }

    /// J_qψᵀ τ, N·m: the generalised force of the joint forces `tau` (N).
    #[must_use]
    pub fn generalised_force(&self, configuration: &Configuration, tau: &Vec3) -> Covector {
        let (theta, delta_per_bend) = joint_jacobian_per_bend(self.pitch_radius, configuration);
        Covector { theta_l: theta.dot(tau), delta_per_bend: delta_per_bend.dot(tau), bend: configuration.bend() }
    }

    /// The joint force deviation Θ = ‖J_qψᵀ τ_lc − ∇E‖ (Eq. 12, with J_qψᵀ for the misprint), N·m.
    #[must_use]
    pub fn residual(&self, configuration: &Configuration, tau_lc: &Vec3) -> f64 {
        self.generalised_force(configuration, tau_lc).minus(&self.energy_gradient(configuration)).norm()
    }

    /// The detectability bound ε_c = ε_τ ‖J_qψᵀ τ_lc‖ (Eq. 16), N·m: exact when all cells share one relative error.
    #[must_use]
    pub fn common_error_bound(&self, configuration: &Configuration, tau_lc: &Vec3, epsilon_tau: f64) -> f64 {
        epsilon_tau * self.generalised_force(configuration, tau_lc).norm()
    }

    /// ε_c(θL) = ε_τ/(1 − ε_τ) ‖∇E‖, N·m: [`Segment::common_error_bound`] of the free segment, whose cells all read
    /// τ/(1 − ε_τ). It depends on the shape alone, and vanishes as the segment straightens.
    #[must_use]
    pub fn shape_bound(&self, configuration: &Configuration, epsilon_tau: f64) -> f64 {
        epsilon_tau / (1.0 - epsilon_tau) * self.energy_gradient(configuration).norm()
    }

    /// The bound for independent cell errors |εᵢ| ≤ ε_τ: the largest ‖J_qψᵀ diag(±ε_τ) τ_lc‖ over the sign choices, N·m.
    ///
    /// Never below [`Segment::common_error_bound`]; unlike it, it grows with the preload.
    #[must_use]
    pub fn independent_error_bound(&self, configuration: &Configuration, tau_lc: &Vec3, epsilon_tau: f64) -> f64 {
        let (theta, delta_per_bend) = joint_jacobian_per_bend(self.pitch_radius, configuration);
        let (x, y) = (theta.component_mul(tau_lc), delta_per_bend.component_mul(tau_lc));
        // A sign choice and its opposite have one norm: four of the eight suffice.
        let largest = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
            .map(|(b, c)| {
                let theta_l = x.x + b * x.y + c * x.z;
                let delta = (y.x + b * y.y + c * y.z) * configuration.bend();
                theta_l * theta_l + delta * delta
            })
            .into_iter()
            .fold(0.0, f64::max);
        epsilon_tau * sqrt(largest)
    }
}

struct Compliance {
    /// Σ L/Lᵢ.
    sum: f64,
    /// Its derivative by `a`.
    slope: f64,
    /// Its derivative by δ.
    slope_delta: f64,
}
