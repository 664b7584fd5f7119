//! The version of the file format.

/// Version of the file format that this program writes, and the newest it reads.
///
/// 1: tendons pass nodes of the mesh. 2: they pass any points of the body.
pub const FORMAT_VERSION: u32 = 2;
