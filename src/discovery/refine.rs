//! Better tendons than the raw ones: straighter, shorter, longer reach.
