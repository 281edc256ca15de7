//! Curves, errors and cost.
