//! How the ports of a bundle follow each other, so that values can be handed to them without a look at their names.

use tilewright_hdl::{Bundle, Fields, Leaf, Visited, uneven};

use crate::testbench::port::Port;

/// What comes next in a bundle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Next {
    Port(Port),
    /// An output among the inputs, as the `ready` of a stream is.
    Back,
    /// So many elements.
    List(usize),
}

/// The ports of a bundle, in order.
#[derive(Debug, Clone)]
pub(crate) struct PortOrder(Vec<Next>);

impl PortOrder {
    /// That of the inputs.
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
    /// A list is not as long as that of the ports, which are given for the message.
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
                None => panic!("the values have not the shape of the inputs: give each input a value"),
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
