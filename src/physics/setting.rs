//! A choice from a catalogue with the values of its parameters, as designs and problems hold it.

use super::catalogue::{Ground, Kind, MaterialKind, Parameter, TermKind};
use super::energy::Energy;
use super::hyperelastic::Hyperelastic;
use serde::de::{DeserializeSeed, EnumAccess, Error, IgnoredAny, MapAccess, VariantAccess, Visitor};
use serde::ser::SerializeStructVariant;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// Most numbers that the parameters of one entry have together.
pub const MOST_VALUES: usize = 8;

/// An entry of a catalogue and the values of its parameters. In files it is `Name(parameter: value, ...)`.
pub struct Setting<K: Kind> {
    kind: &'static K,
    values: [f64; MOST_VALUES],
}

impl<K: Kind> Setting<K> {
    /// Panics where the number of values is not that of the parameters: a mistake of the caller.
    pub fn new(kind: &'static K, values: &[f64]) -> Self {
        assert_eq!(values.len(), count(kind), "values of {}", kind.name());
        let mut all = [0.0; MOST_VALUES];
        all[..values.len()].copy_from_slice(values);
        Self { kind, values: all }
    }

    /// All parameters at their defaults.
    pub fn default_of(kind: &'static K) -> Self {
        let values: Vec<f64> = kind.parameters().iter().flat_map(|p| p.default[..p.size].to_vec()).collect();
        Self::new(kind, &values)
    }

    pub fn kind(&self) -> &'static K {
        self.kind
    }

    /// The values of all parameters, in their order.
    pub fn values(&self) -> &[f64] {
        &self.values[..count(self.kind)]
    }

    /// Every parameter with its values.
    pub fn each(&self) -> impl Iterator<Item = (&'static Parameter, &[f64])> {
        let mut start = 0;
        self.kind.parameters().iter().map(move |parameter| {
            let range = start..start + parameter.size;
            start = range.end;
            (parameter, &self.values[range])
        })
    }

    /// Every parameter with its values, to be changed.
    pub fn each_mut(&mut self) -> impl Iterator<Item = (&'static Parameter, &mut [f64])> {
        let mut rest = self.values.as_mut_slice();
        self.kind.parameters().iter().map(move |parameter| {
            let (own, others) = std::mem::take(&mut rest).split_at_mut(parameter.size);
            rest = others;
            (parameter, own)
        })
    }

    /// The value of a parameter of one number. Panics where there is none of this name: a mistake of the caller.
    pub fn value(&self, name: &str) -> f64 {
        self.each().find(|(p, _)| p.name == name).expect("a parameter of this kind").1[0]
    }

    /// Sets a parameter of one number; panics as [`Self::value`].
    pub fn set(&mut self, name: &str, value: f64) {
        self.each_mut().find(|(p, _)| p.name == name).expect("a parameter of this kind").1[0] = value;
    }

    /// The other kind, with the values of the parameters that stand in the same places of both, and defaults for the others.
    pub fn turned_into(&self, kind: &'static K) -> Self {
        let mut other = Self::default_of(kind);
        for ((to, new), (from, old)) in other.each_mut().zip(self.each()) {
            if to.size == from.size && to.dimension == from.dimension {
                new.copy_from_slice(old);
            }
        }
        other
    }
}

impl Setting<MaterialKind> {
    pub fn build(&self) -> Box<dyn Hyperelastic> {
        (self.kind.build)(self.values())
    }

    /// The shear modulus at rest: the first parameter.
    pub fn shear_modulus(&self) -> f64 {
        self.values[0]
    }
}

impl Setting<TermKind> {
    pub fn build(&self, ground: &Ground) -> Box<dyn Energy> {
        (self.kind.build)(ground, self.values())
    }
}

fn count<K: Kind>(kind: &K) -> usize {
    kind.parameters().iter().map(|p| p.size).sum()
}

impl<K: Kind> Clone for Setting<K> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<K: Kind> Copy for Setting<K> {}

impl<K: Kind> PartialEq for Setting<K> {
    fn eq(&self, other: &Self) -> bool {
        self.kind.name() == other.kind.name() && self.values == other.values
    }
}

impl<K: Kind> fmt::Debug for Setting<K> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut out = f.debug_struct(self.kind.name());
        for (parameter, values) in self.each() {
            out.field(parameter.name, &values);
        }
        out.finish()
    }
}

/// The first of the catalogue with its defaults.
impl<K: Kind> Default for Setting<K> {
    fn default() -> Self {
        Self::default_of(K::all()[0])
    }
}

impl<K: Kind> Serialize for Setting<K> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let name = self.kind.name();
        let index = K::names().iter().position(|n| *n == name).unwrap_or_default() as u32;
        let mut out = serializer.serialize_struct_variant(K::OF, index, name, self.kind.parameters().len())?;
        for (parameter, values) in self.each() {
            match *values {
                [value] => out.serialize_field(parameter.name, &value)?,
                [x, y] => out.serialize_field(parameter.name, &[x, y])?,
                _ => {}
            }
        }
        out.end()
    }
}

impl<'de, K: Kind> Deserialize<'de> for Setting<K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_enum(K::OF, K::names(), OfKind(PhantomData))
    }
}

struct OfKind<K>(PhantomData<K>);

impl<'de, K: Kind> Visitor<'de> for OfKind<K> {
    type Value = Setting<K>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "enum {}", K::OF)
    }

    fn visit_enum<A: EnumAccess<'de>>(self, data: A) -> Result<Self::Value, A::Error> {
        let (index, variant) = data.variant_seed(OneOf(K::names().iter().copied()))?;
        let index = match index {
            Ok(index) => index,
            Err(name) => return Err(A::Error::unknown_variant(&name, K::names())),
        };
        variant.struct_variant(&[], Values(K::all()[index]))
    }
}

/// The values of one kind, by name, in any order.
struct Values<K: Kind>(&'static K);

impl<'de, K: Kind> Visitor<'de> for Values<K> {
    type Value = Setting<K>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "struct variant {}::{}", K::OF, self.0.name())
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let parameters = self.0.parameters();
        let mut found: Vec<Option<[f64; 2]>> = vec![None; parameters.len()];
        while let Some(key) = map.next_key_seed(OneOf(parameters.iter().map(|p| p.name)))? {
            let Ok(index) = key else {
                map.next_value::<IgnoredAny>()?;
                continue;
            };
            if found[index].is_some() {
                return Err(A::Error::duplicate_field(parameters[index].name));
            }
            found[index] = Some(if parameters[index].size == 1 {
                [map.next_value()?, 0.0]
            } else {
                map.next_value::<[f64; 2]>()?
            });
        }
        let mut out = Setting::default_of(self.0);
        for ((parameter, values), found) in out.each_mut().zip(found) {
            let found = found.ok_or_else(|| A::Error::missing_field(parameter.name))?;
            values.copy_from_slice(&found[..parameter.size]);
        }
        Ok(out)
    }
}

/// An identifier: its place in a list of names, or itself.
struct OneOf<I>(I);

impl<'de, I: Iterator<Item = &'static str>> DeserializeSeed<'de> for OneOf<I> {
    type Value = Result<usize, String>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl<'de, I: Iterator<Item = &'static str>> Visitor<'de> for OneOf<I> {
    type Value = Result<usize, String>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an identifier")
    }

    fn visit_str<E: Error>(mut self, name: &str) -> Result<Self::Value, E> {
        Ok(self.0.position(|known| known == name).ok_or_else(|| name.to_owned()))
    }
}
