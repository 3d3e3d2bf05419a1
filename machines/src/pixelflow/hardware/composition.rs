//! The time of the network, counted in simulation.

use tilewright_rtl::pixelflow::TRANSFER;
use tilewright_rtl::pixelflow::compositor::Mode;
use tilewright_rtl::pixelflow::network::Network;
use tilewright_rtl::pixelflow::network_port::NetworkPort;
use tilewright_sim::Simulation;

use crate::error::Error;
use crate::pixelflow::costs::Ticks;

/// Ticks from the first to the last byte at the last node of a network, for words one after another. The first node loads them, and all nodes
/// between compose (PFL-TCB).
///
/// ```
/// use tilewright_machines::pixelflow::composition_time;
/// use tilewright_rtl::pixelflow::network_port::NetworkPort;
///
/// // A byte of 256 pixels: 1.28 us.
/// let port = NetworkPort { chips: 2, pixels: 256, width: 8 };
/// assert_eq!(composition_time(3, port, 1, 1)?, 256);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Error::Simulation`].
///
/// # Panics
/// There are fewer than two nodes, or no bytes or words.
pub fn composition_time(nodes: u32, port: NetworkPort, words: u64, bytes: u64) -> Result<Ticks, Error> {
    assert!(nodes >= 2 && words > 0 && bytes > 0, "a word goes from a node to another one");
    let pixels = u64::from(port.pixels);
    let mut sim = Simulation::at(&Network { nodes, port }, TRANSFER)?;
    let (last, ports) = (nodes as usize - 1, sim.i.nodes.clone());
    for (number, node) in ports.iter().enumerate() {
        let mode = if number == 0 {
            Mode::Load
        } else if number == last {
            Mode::Unload
        } else {
            Mode::Composite
        };
        sim.set(node.mode, mode as u64);
        sim.set(node.first, false);
        sim.set(node.sends, false);
    }
    sim.try_reset()?;
    let target = sim.o.nodes[last];
    let (word, all) = (bytes * pixels, words * bytes * pixels);
    let (mut first, mut got, mut tick) = (None, 0, 0);
    while got < all {
        assert!(tick <= all + u64::from(nodes), "the network has lost a byte");
        sim.set(ports[0].sends, tick < all);
        sim.set(ports[0].first, tick % word < pixels);
        if sim.get_u64(target.unloaded) == 1 {
            first = first.or(Some(tick));
            got += 1;
        }
        sim.try_step()?;
        tick += 1;
    }
    Ok(tick - first.unwrap_or(tick))
}
