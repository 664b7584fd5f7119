//! Room soft_ik.
