//! Changes of winches and their tendons.

use super::{EditError, item, trimmed, unused_name};
use crate::design::{Design, Network, validate};

/// Adds a network, slack in every keyframe so far; its index. A name that is taken gets a number.
///
/// # Errors
/// A network that is unsound on this mesh.
pub fn accept_network(design: &mut Design, mut network: Network) -> Result<usize, EditError> {
    validate::network(&format!("networks[{}]", design.networks.len()), &design.mesh, &network)?;
    let wanted = if network.name.trim().is_empty() { "winch 1" } else { network.name.trim() };
    network.name = unused_name(wanted, |name| design.networks.iter().any(|n| n.name == name));
    design.networks.push(network);
    for keyframe in &mut design.keyframes {
        keyframe.activations_mm.push(0.0);
    }
    Ok(design.networks.len() - 1)
}

/// Removes a network, and its activation from every keyframe.
///
/// # Errors
/// No such network.
pub fn remove_network(design: &mut Design, index: usize) -> Result<Network, EditError> {
    item(&mut design.networks, "network", index)?;
    for keyframe in &mut design.keyframes {
        keyframe.activations_mm.remove(index);
    }
    Ok(design.networks.remove(index))
}

/// Gives a network another name.
///
/// # Errors
/// No such network; a name that is empty or taken.
pub fn rename_network(design: &mut Design, index: usize, name: &str) -> Result<(), EditError> {
    let name = trimmed("network", name)?;
    item(&mut design.networks, "network", index)?;
    if design.networks.iter().enumerate().any(|(i, n)| i != index && n.name == name) {
        return Err(EditError::NameTaken { what: "network", name });
    }
    design.networks[index].name = name;
    Ok(())
}

/// Replaces a network by one that keeps its name: other tendons, other places. Keyframes keep its activation.
///
/// # Errors
/// No such network, or one that is unsound on this mesh; the design stays as it was.
pub fn set_network(design: &mut Design, index: usize, network: Network) -> Result<(), EditError> {
    validate::network(&format!("networks[{index}]"), &design.mesh, &network)?;
    let place = item(&mut design.networks, "network", index)?;
    *place = Network { name: std::mem::take(&mut place.name), ..network };
    Ok(())
}

/// Gives a network a colour of its own, or takes it away.
///
/// # Errors
/// No such network.
pub fn color_network(design: &mut Design, index: usize, color: Option<[u8; 3]>) -> Result<(), EditError> {
    item(&mut design.networks, "network", index)?.color = color;
    Ok(())
}

/// Switches a network off, or on again. Its activations in keyframes stay.
///
/// # Errors
/// No such network.
pub fn mute_network(design: &mut Design, index: usize, muted: bool) -> Result<(), EditError> {
    item(&mut design.networks, "network", index)?.muted = muted;
    Ok(())
}

/// Moves a network to another place in the list, and its activation in every keyframe.
///
/// # Errors
/// No such network or place.
pub fn move_network(design: &mut Design, from: usize, to: usize) -> Result<(), EditError> {
    item(&mut design.networks, "network", from)?;
    item(&mut design.networks, "network", to)?;
    let network = design.networks.remove(from);
    design.networks.insert(to, network);
    for keyframe in &mut design.keyframes {
        let activation = keyframe.activations_mm.remove(from);
        keyframe.activations_mm.insert(to, activation);
    }
    Ok(())
}
