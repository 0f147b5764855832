//! Centrode: see and tune contact detection on a continuum robot.
