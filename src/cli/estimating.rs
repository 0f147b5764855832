//! Which contact is placed, and when.

use super::output::Failure;
use centrode_core::detect::Method;
use centrode_core::study::report::AFTER;
use clap::Args;

/// Flags of the commands that place a contact.
#[derive(Debug, Args)]
pub struct Estimating {
    /// Place the contact that the first alarm of this detector tells of; cusum by itself.
    #[arg(long, value_name = "KEY")]
    detector: Option<String>,
    /// Place it so long after the alarm, in seconds.
    #[arg(long, value_name = "SECONDS", value_delimiter = ',', allow_negative_numbers = true)]
    after: Vec<f64>,
}

impl Estimating {
    /// The name of the detector, where one is given.
    pub fn named(&self) -> Option<&str> {
        self.detector.as_deref()
    }

    /// The detector.
    pub fn detector(&self) -> Result<Method, Failure> {
        self.detector.as_ref().map_or(Ok(Method::Cusum), |name| method("--detector", name))
    }

    /// Whether any of them is given.
    pub fn is_given(&self) -> bool {
        self.detector.is_some() || !self.after.is_empty()
    }

    /// The times, s.
    pub fn after(&self) -> Result<Vec<f64>, Failure> {
        if let Some(wrong) = self.after.iter().find(|after| !(0.0..=f64::MAX).contains(*after)) {
            return Err(Failure::Input(format!("--after {wrong}: not allowed; allowed: seconds from 0 up")));
        }
        Ok(if self.after.is_empty() { AFTER.to_vec() } else { self.after.clone() })
    }
}

/// The detector that a flag names.
pub fn method(flag: &str, name: &str) -> Result<Method, Failure> {
    Method::ALL.iter().copied().find(|method| method.key() == name).ok_or_else(|| {
        let known = Method::KEYS.join(", ");
        Failure::Input(format!("{flag}: there is no detector called {name:?}; known are: {known}"))
    })
}
