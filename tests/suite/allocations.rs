//! A warm frame under the hand allocates nothing. Its allocator serves the whole suite and counts nothing for other tests.

use crate::support::scenes::{Parts, Scene};
use crate::support::{self, bodies};
use plushwright::design::Pin;
use plushwright::physics::HessianForm;
use plushwright::soft_ik::Quality;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

/// The system's allocator; counts what the present thread asks for while it is told to.
struct Counting;

thread_local! {
    // Constants without destructors: reading them allocates nothing itself.
    static COUNTED: Cell<bool> = const { Cell::new(false) };
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
    static LARGEST: Cell<usize> = const { Cell::new(0) };
}

fn count(size: usize) {
    if COUNTED.get() {
        ALLOCATIONS.set(ALLOCATIONS.get() + 1);
        LARGEST.set(LARGEST.get().max(size));
    }
}

// SAFETY: passes every call on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        unsafe { System.dealloc(block, layout) }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size);
        unsafe { System.realloc(block, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Allocations of `work` on this thread, and the largest of them in bytes.
fn allocations<T>(work: impl FnOnce() -> T) -> (T, usize, usize) {
    ALLOCATIONS.set(0);
    LARGEST.set(0);
    COUNTED.set(true);
    let answer = work();
    COUNTED.set(false);
    (answer, ALLOCATIONS.get(), LARGEST.get())
}

/// Frames before the count begins.
const WARMING: usize = 5;
/// Frames counted: in the first of them the targets move; then they rest until nothing moves any more, this long at most.
const MOVING: usize = 30;
const RESTING: usize = 150;

fn check(parts: Parts, quality: Quality) {
    let mut design = support::rigged();
    let corner = design.mesh.node_point(28).expect("node 28 is used");
    design.pins.push(Pin::at_rest(corner, 20.0));
    let mut scene = Scene::of(design, parts);
    let mut tracker = scene.tracker();
    for k in 0..WARMING {
        scene.drag(k, WARMING + MOVING);
        scene.frame(&mut tracker, quality);
    }
    let (mut iterations, mut converged) = ([0, 0], false);
    for k in WARMING..WARMING + MOVING + RESTING {
        let resting = k >= WARMING + MOVING;
        scene.drag(k, WARMING + MOVING - 1);
        let (frame, count, largest) = allocations(|| scene.frame(&mut tracker, quality));
        assert_eq!(count, 0, "{parts:?}, {quality:?}, frame {k}: {count} allocations, up to {largest} bytes");
        iterations[resting as usize] += frame.iterations;
        converged = resting && frame.converged;
        if converged {
            break;
        }
    }
    // Converged at rest: the challenger has run to its end.
    assert!(iterations[0] > MOVING && iterations[1] > 0 && converged, "{parts:?}, {quality:?}: {iterations:?}");
}

#[test]
fn the_count_counts() {
    let (_, count, largest) = allocations(|| vec![0_u8; 1000]);
    assert_eq!((count, largest), (1, 1000));
    let (_, count, _) = allocations(|| std::hint::black_box([0.0; 100]));
    assert_eq!(count, 0);
}

#[test]
fn fibres_under_the_hand_allocate_nothing() {
    for quality in [Quality::Draft, Quality::Balanced] {
        check(Parts::default(), quality);
        check(Parts { stiff: true, ..Parts::default() }, quality);
    }
}

#[test]
fn fibres_beside_winches_that_turn_allocate_nothing() {
    for quality in [Quality::Draft, Quality::Balanced] {
        check(Parts { tendons: true, ..Parts::default() }, quality);
    }
}

#[test]
fn gravity_allocates_nothing() {
    for quality in [Quality::Draft, Quality::Balanced] {
        check(Parts { gravity: true, ..Parts::default() }, quality);
        check(Parts { gravity: true, tendons: true, stiff: false }, quality);
    }
}

/// Tendons of any length that a mesh of ten thousand fibres has room for.
#[test]
fn a_long_tendon_allocates_nothing() {
    let mesh = bodies::bar(10.0, 0.1, 200, 1);
    let there_and_back: Vec<usize> = (0..=200).chain((0..200).rev()).collect();
    let tendon = mesh.element(&there_and_back, 5.0, 1e-3);
    let mut model = mesh.model(bodies::neo_hookean(), vec![tendon], mesh.left_pins(10.0), Vec::new());
    model.contractile.set_contractions(&[0.1]);
    let (x, mut forces) = (mesh.flat(), vec![0.0; mesh.flat().len()]);
    let mut step = || {
        model.gradient(&x, &mut forces);
        assert_eq!(model.factorize_for_descent(&x), Ok(HessianForm::Exact));
        model.solve(&mut forces);
    };
    // The kernels of the factorisation keep some memory for every thread.
    step();
    let (_, count, largest) = allocations(step);
    assert_eq!(count, 0, "{count} allocations, up to {largest} bytes");
}
