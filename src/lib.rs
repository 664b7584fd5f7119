//! Plushwright: design, animate and fabricate cable-driven plush robots.
//!
//! After Bern, Chang and Coros, *Interactive Design of Animated Plushies* (ACM TOG 36(4), 2017).
//!
//! # The rooms
//! Data flows one way, in the order below; no room imports from one further down.
//!
//! | room | holds |
//! | --- | --- |
//! | [`defaults`] | every default figure of the tool, with unit, source or reason |
//! | [`random`] | repeatable random numbers |
//! | [`threads`] | work spread over all processors, results in order |
//! | [`numbers`] | numbers as they are told: never `-0.0` |
//! | [`files`] | the one way to write files and folders; what they hold before and after |
//! | [`outline`] | a silhouette: reading, clean-up, polygons |
//! | [`mesh`] | outline to triangle mesh, points of the body, quality |
//! | [`physics`] | what a plushie is made of: energies, materials, contractile elements, pins, statics |
//! | [`sewing`] | rules that a hand with a needle can keep, and where routings break them |
//! | [`soft_ik`] | targets to contractions: objective, sensitivities, actuation, solvers |
//! | [`discovery`] | activation graph to winch-tendon network (Algorithm 2) |
//! | [`problem`] | the JSON question-and-answer interface of the numerical core |
//! | [`design`] | the document: design, poses, networks, keyframes, file format, edits, undo |
//! | [`engine`] | compiles a design into a physics model, poses both plushies, worker thread |
//! | [`rigging`] | finds winches and tendons: generators of candidates, criteria that judge them, the search |
//! | [`motion`] | what motors are told: trajectories of winches, families of controllers, programs |
//! | [`live`] | motors that are told live: serial ports, the player, simulated controllers |
//! | [`fabrication`] | the blueprint: products (patterns, routings, winches, tracks, programs, guide) and the writers of their files |
//! | [`picture`] | pictures of both plushies in layers, rasterised without a graphics adapter |
//! | [`operations`] | every use case once: new, remesh, reshape, pose, arrange, starch, propose, rig, explore, key, retime, check, export, render, film |
//! | [`bench`](mod@bench) | whole studies of the solvers, repeatable from a seed |
//! | [`commands`] | the headless commands |
//! | `studio` | the window (feature `studio`) |
//!
//! # Units
//! Lengths in mm, forces in N, time in s, angles in rad; 2-D moduli and spring stiffnesses in N/mm (thickness
//! multiplied in). Problem files alone are in SI (m, N, J); the physics itself only asks for consistent units.
//! Coordinates have y up and their origin at the lower left corner of the rest silhouette's box.
//!
#![doc = include_str!("../docs/glossary.md")]
//!
//! # Invariants
//! - The core never imports the window: `cargo build --no-default-features` builds everything but `studio`.
//! - Only `physics::cholesky` and `physics::indefinite` name the sparse linear algebra library.
//! - The same input gives the same bits; iteration order never depends on hashing or thread count.
//! - What is shown is finite, uninverted and within the actuation limits.

pub mod bench;
pub mod commands;
pub mod defaults;
pub mod design;
pub mod discovery;
pub mod engine;
pub mod fabrication;
pub mod files;
pub mod live;
pub mod mesh;
pub mod motion;
pub mod numbers;
pub mod operations;
pub mod outline;
pub mod physics;
pub mod picture;
pub mod problem;
pub mod random;
pub mod rigging;
pub mod sewing;
pub mod soft_ik;
#[cfg(feature = "studio")]
pub mod studio;
pub mod threads;
