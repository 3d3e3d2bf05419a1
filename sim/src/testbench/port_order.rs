//! The sequence of a bundle's ports, so that values can be assigned to them without their names.

use tilewright_hdl::{Bundle, Fields, Leaf, Visited, uneven};

use crate::testbench::port::Port;

/// The next item of a bundle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    Port(Port),
    /// An output among the inputs, as the `ready` of a stream.
    Back,
    /// A list of this length.
    List(usize),
}

/// The ports of a bundle, in sequence.
#[derive(Debug, Clone)]
pub(crate) struct PortOrder(Vec<Next>);

impl PortOrder {
    /// The sequence of the inputs.
    pub fn of<I: Bundle>(ports: &I::Of<Port>) -> PortOrder {
        let mut parts = Vec::new();
        ports.visit(&mut |part| {
            parts.push(match part {
                Visited::Leaf(port) => Next::Port(*port),
                Visited::Back(_) => Next::Back,
                Visited::List(length) => Next::List(length),
            });
        });
        PortOrder(parts)
    }

    /// Calls `set` with each port and its value.
    ///
    /// # Panics
    ///
    /// A list is not as long as that of the ports; `ports` are for the message.
    #[track_caller]
    pub fn pair<I: Bundle, V: Leaf>(&self, ports: &I::Of<Port>, values: &I::Of<V>, mut set: impl FnMut(Port, &V)) {
        let mut parts = self.0.iter();
        let mut same = true;
        values.visit(&mut |part| {
            same &= match (parts.next(), part) {
                (Some(Next::List(length)), Visited::List(given)) => *length == given,
                (Some(Next::Port(_)), Visited::Leaf(_)) | (Some(Next::Back), Visited::Back(_)) => true,
                _ => false,
            };
        });
        if !same || parts.next().is_some() {
            match uneven(&values.leaves(), &ports.leaves()) {
                Some(uneven) => {
                    panic!("input{uneven} is a list of {}, but is set to a list of {}", uneven.needs, uneven.has)
                }
                None => panic!("the values do not have the shape of the inputs: give each input a value"),
            }
        }
        let mut parts = self.0.iter();
        values.visit(&mut |part| {
            if let (Some(Next::Port(port)), Visited::Leaf(value)) = (parts.next(), part) {
                set(*port, value);
            }
        });
    }
}
