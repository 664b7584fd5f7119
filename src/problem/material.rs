//! The material of a problem file: `{"mu": ..., "kappa": ...}` is neo-Hookean; `"law"` names another one of the catalogue.

use crate::physics::{Kind, MaterialKind, NeoHookean, Setting};
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::{Deref, DerefMut};

/// A material of the catalogue ([`crate::physics::materials`]) with its parameters in SI.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MaterialData(pub Setting<MaterialKind>);

/// Names the material where it is not the first of the catalogue.
const LAW: &str = "law";

impl MaterialData {
    /// In a frame with these units of modulus and length.
    pub(super) fn scaled(&self, modulus: f64, length: f64) -> Self {
        let mut scaled = self.0;
        for (parameter, values) in scaled.each_mut() {
            values.iter_mut().for_each(|value| *value /= parameter.dimension.unit(modulus, length));
        }
        Self(scaled)
    }
}

impl From<NeoHookean> for MaterialData {
    fn from(material: NeoHookean) -> Self {
        Self(material.into())
    }
}

impl Deref for MaterialData {
    type Target = Setting<MaterialKind>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl DerefMut for MaterialData {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.0
    }
}

impl Serialize for MaterialData {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        if self.kind().name != MaterialKind::names()[0] {
            map.serialize_entry(LAW, self.kind().name)?;
        }
        for (parameter, values) in self.each() {
            map.serialize_entry(parameter.name, &values[0])?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for MaterialData {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Keys)
    }
}

struct Keys;

impl<'de> Visitor<'de> for Keys {
    type Value = MaterialData;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a material")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<MaterialData, A::Error> {
        // Which parameters there are is known once the whole is read.
        let mut found: BTreeMap<String, Value> = BTreeMap::new();
        while let Some((key, value)) = map.next_entry::<String, Value>()? {
            if found.insert(key, value).is_some() {
                return Err(A::Error::custom("the same key twice"));
            }
        }
        let kind = match found.get(LAW) {
            None => MaterialKind::all()[0],
            Some(law) => {
                let known = MaterialKind::names().iter().position(|name| law.as_str() == Some(name));
                let unknown = || A::Error::unknown_variant(&law.to_string(), MaterialKind::names());
                MaterialKind::all()[known.ok_or_else(unknown)?]
            }
        };
        let mut setting = Setting::default_of(kind);
        for (parameter, values) in setting.each_mut() {
            let value = found.get(parameter.name).ok_or_else(|| A::Error::missing_field(parameter.name))?;
            values[0] = f64::deserialize(value).map_err(A::Error::custom)?;
        }
        Ok(MaterialData(setting))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_reads_back_and_the_first_needs_no_name() {
        for kind in MaterialKind::all() {
            let material = MaterialData(Setting::default_of(kind));
            let text = serde_json::to_string(&material).unwrap();
            assert_eq!(serde_json::from_str::<MaterialData>(&text).unwrap(), material, "{text}");
        }
        let plain: MaterialData = serde_json::from_str(r#"{"mu": 2, "kappa": 0.1, "note": []}"#).unwrap();
        assert_eq!(plain, NeoHookean { mu: 2.0, kappa: 0.1 }.into());
        assert_eq!(serde_json::to_string(&plain).unwrap(), r#"{"mu":2.0,"kappa":0.1}"#);
        let missing = serde_json::from_value::<MaterialData>(serde_json::json!({"mu": 1})).unwrap_err();
        assert_eq!(missing.to_string(), "missing field `kappa`");
        let unknown: Result<MaterialData, _> = serde_json::from_value(Value::from_iter([(LAW, "Jelly")]));
        assert!(unknown.unwrap_err().to_string().contains("NeoHookean"));
    }
}
