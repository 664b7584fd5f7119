//! A network file is answered or refused.
#![no_main]

use libfuzzer_sys::fuzz_target;
use plushwright::problem::network;

fuzz_target!(|text: &str| {
    let _ = network::answer(text);
});
