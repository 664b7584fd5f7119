//! Many pieces of work, spread over all processors.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Threads at most: a model a thread is enough memory.
const THREADS: usize = 8;

/// The results of `work` on every item, in the items' order: the same whatever the number of threads.
///
/// # Panics
/// Where `work` does.
pub fn in_order<T: Sync, R: Send>(items: &[T], work: impl Fn(&T) -> R + Sync) -> Vec<R> {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get()).min(THREADS).min(items.len());
    if threads <= 1 {
        return items.iter().map(work).collect();
    }
    let next = AtomicUsize::new(0);
    let mut done: Vec<(usize, R)> = std::thread::scope(|scope| {
        let worker = || {
            let mut mine = Vec::new();
            loop {
                let k = next.fetch_add(1, Ordering::Relaxed);
                let Some(item) = items.get(k) else { return mine };
                mine.push((k, work(item)));
            }
        };
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        let joined = workers.into_iter().map(|w| w.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)));
        joined.flatten().collect()
    });
    done.sort_by_key(|(k, _)| *k);
    done.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_worked_on_once_and_in_its_place() {
        for count in [0, 1, 2, 37] {
            let items: Vec<usize> = (0..count).collect();
            let calls = AtomicUsize::new(0);
            let results = in_order(&items, |k| {
                calls.fetch_add(1, Ordering::Relaxed);
                3 * k
            });
            assert_eq!(calls.into_inner(), count);
            assert_eq!(results, items.iter().map(|k| 3 * k).collect::<Vec<_>>());
        }
    }

    #[test]
    #[should_panic(expected = "the fifth")]
    fn a_panic_goes_on() {
        in_order(&(0..20).collect::<Vec<usize>>(), |&k| assert!(k != 5, "the fifth"));
    }
}
