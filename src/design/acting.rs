//! The networks that act, and those that are switched off.

use super::{Design, Network, Tendon};
use std::borrow::Cow;

impl Network {
    /// One that acts, in the colour of its number.
    pub fn new(name: impl Into<String>, tendons: Vec<Tendon>) -> Self {
        Self { name: name.into(), tendons, color: None, muted: false }
    }
}

impl Design {
    /// The design without the networks that are switched off, and without their activations in its keyframes.
    pub fn acting(&self) -> Cow<'_, Design> {
        if self.networks.iter().all(|network| !network.muted) {
            return Cow::Borrowed(self);
        }
        let mut acting = self.clone();
        acting.networks.retain(|network| !network.muted);
        for keyframe in &mut acting.keyframes {
            keyframe.activations_mm = self.of_acting(&keyframe.activations_mm);
        }
        Cow::Owned(acting)
    }

    /// The numbers of the networks that act.
    pub fn acting_numbers(&self) -> Vec<usize> {
        (0..self.networks.len()).filter(|&number| !self.networks[number].muted).collect()
    }

    /// Values of all networks without those of the ones that are switched off.
    pub fn of_acting(&self, all: &[f64]) -> Vec<f64> {
        let acts = |number: usize| self.networks.get(number).is_none_or(|network| !network.muted);
        all.iter().enumerate().filter(|(number, _)| acts(*number)).map(|(_, value)| *value).collect()
    }

    /// Values of the networks that act, with 0 for each that is switched off; those of networks that are to come follow.
    pub fn of_all(&self, acting: &[f64]) -> Vec<f64> {
        let mut values = acting.iter().copied();
        let mut all: Vec<f64> = self
            .networks
            .iter()
            .map(|network| if network.muted { 0.0 } else { values.next().unwrap_or_default() })
            .collect();
        all.extend(values);
        all
    }

    /// Names of the networks that are switched off.
    pub fn muted_names(&self) -> impl Iterator<Item = &str> {
        self.networks.iter().filter(|network| network.muted).map(|network| network.name.as_str())
    }
}

#[cfg(test)]
mod tests {
    use crate::design::testing;
    use std::borrow::Cow;

    #[test]
    fn what_is_switched_off_is_left_out_and_put_back() {
        let mut design = testing::sample();
        assert!(matches!(design.acting(), Cow::Borrowed(_)));
        design.networks[0].muted = true;
        let acting = design.acting();
        assert_eq!((acting.networks.len(), &acting.networks[0].name[..]), (1, "right"));
        assert_eq!(acting.keyframes[1].activations_mm, [3.0]);
        acting.validate().unwrap();
        assert_eq!((design.acting_numbers(), design.of_all(&[3.0, 5.0])), (vec![1], vec![0.0, 3.0, 5.0]));
        assert_eq!(design.of_acting(&[1.0, 2.0]), [2.0]);
        assert_eq!(design.muted_names().collect::<Vec<_>>(), ["left"]);
    }
}
