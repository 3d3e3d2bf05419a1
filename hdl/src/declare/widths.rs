//! The widths of a block's ports.

use crate::bundle::join;
use crate::fields::Fields;
use crate::limits::MOST_PORTS;
use crate::stream::backwards;
use crate::width::Width;
use tilewright_circuit::Mistake;

/// A list of identical ports.
#[doc(hidden)]
#[track_caller]
pub fn list<W: Clone>(widths: W, count: impl crate::Integer) -> Vec<W> {
    let count = crate::integers::count(count);
    if count > MOST_PORTS {
        let help = "lanes are one port: `bits(8).of(row(lanes))`";
        crate::elaboration::mistake(
            Mistake::TooManyPorts,
            format!("a list of {count} ports, more than {MOST_PORTS}"),
            help,
        );
    }
    vec![widths; count as usize]
}

/// The declared widths of an output, each with its path.
#[doc(hidden)]
pub fn declared(port: &str, widths: &impl Fields<Width>) -> Vec<(String, Width)> {
    // A port may be a raw identifier; the empty name means all ports of a bundle.
    let port = if port.is_empty() { String::new() } else { join("", port) };
    let path = |path: String| if path.is_empty() { port.clone() } else { join(&port, &path) };
    // A leaf that runs backwards, as the `ready` of a stream, is no output.
    let outputs = widths.leaves().into_iter().zip(backwards(widths)).filter(|(_, back)| !back);
    outputs.map(|((inner, width), _)| (path(inner), width)).collect()
}
