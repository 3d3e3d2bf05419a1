//! The Waveform Control Protocol, by which Surfer and other viewers of waveforms are led and tell what their user does.
//!
//! A message is a JSON object with a NUL behind it. Both sides begin with a greeting. Times are in the unit of the waveform
//! that the viewer shows, which is a picosecond in ours. The protocol is that of version 0, as `surfer-wcp` of Surfer has it.

mod connection;
mod message;
#[cfg(test)]
mod tests;

pub use connection::Viewer;
pub use message::Event;

use crate::number::number;
use clap::Args;
use std::net::{Ipv4Addr, SocketAddr, ToSocketAddrs};

/// The port that Surfer listens on, unless its configuration has another one.
const PORT: &str = "54321";

/// The viewer to go along with.
#[derive(Args)]
#[command(next_help_heading = "Viewer")]
pub struct ViewerOptions {
    /// Go along with a viewer that listens there, by the Waveform Control Protocol: its cursor follows the clock. In Surfer, `wcp_server_start` makes it listen
    #[arg(long, value_name = "ADDRESS", value_parser = address, num_args = 0..=1, default_missing_value = PORT)]
    wcp: Option<SocketAddr>,
    /// Wait on this port for a viewer to go along with, such as `surfer --wcp-initiate 5000`
    #[arg(long, value_name = "PORT", value_parser = number(1_u16..=u16::MAX), conflicts_with = "wcp")]
    wcp_wait: Option<u16>,
}

/// A port of this computer, or an address with one.
fn address(text: &str) -> Result<SocketAddr, String> {
    let port = text.parse().ok().filter(|port| *port > 0);
    let here = port.map(|port| SocketAddr::from((Ipv4Addr::LOCALHOST, port)));
    let found = here.or_else(|| text.to_socket_addrs().ok()?.next());
    found.ok_or_else(|| format!("give a port, or an address such as 127.0.0.1:{PORT}"))
}
