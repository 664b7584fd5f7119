//! The version of the file format.

/// Version of the file format that this program writes, and the newest it reads.
pub const FORMAT_VERSION: u32 = 1;
