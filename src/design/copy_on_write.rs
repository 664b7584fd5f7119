//! A large part of a document that most copies of it have in common.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// Copies are one value until one of them is changed; it is copied then. Two that are one value are equal without a look at it.
///
/// Edits, undo and whoever asks whether something has changed copy and compare a document many times a frame, and its mesh hardly ever differs.
#[derive(Clone, Debug, Default)]
pub struct CopyOnWrite<T>(Arc<T>);

impl<T> From<T> for CopyOnWrite<T> {
    fn from(value: T) -> Self {
        Self(Arc::new(value))
    }
}

impl<T> Deref for CopyOnWrite<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Clone> DerefMut for CopyOnWrite<T> {
    fn deref_mut(&mut self) -> &mut T {
        Arc::make_mut(&mut self.0)
    }
}

impl<T: PartialEq> PartialEq for CopyOnWrite<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }
}

impl<T: Serialize> Serialize for CopyOnWrite<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for CopyOnWrite<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(Self::from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_copy_is_the_same_value_until_it_is_changed() {
        let first = CopyOnWrite::from(vec![1.0, 2.0]);
        let mut copy = first.clone();
        assert!(std::ptr::eq(&*first, &*copy) && first == copy);
        copy[1] = 3.0;
        assert!((&*first, &*copy) == (&vec![1.0, 2.0], &vec![1.0, 3.0]) && first != copy);
        // What is written alike is equal, wherever it lies.
        copy[1] = 2.0;
        assert!(!std::ptr::eq(&*first, &*copy) && first == copy);
    }

    #[test]
    fn a_value_without_an_order_of_its_own_is_equal_to_its_copy() {
        let first = CopyOnWrite::from(f64::NAN);
        assert!(first == first.clone() && first != CopyOnWrite::from(f64::NAN));
    }

    #[test]
    fn it_is_written_and_read_as_its_value() {
        let list = CopyOnWrite::from(vec![1, 2]);
        let text = ron::to_string(&list).unwrap();
        assert_eq!(text, "[1,2]");
        assert_eq!(ron::from_str::<CopyOnWrite<Vec<i32>>>(&text), Ok(list));
    }
}
