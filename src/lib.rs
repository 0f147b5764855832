//! Centrode.
