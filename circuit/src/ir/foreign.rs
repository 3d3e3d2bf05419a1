//! Modules of somebody else, which Verilog instantiates in place of their models.

use super::Attribute;
use crate::bits::Bits;
use crate::clock::Clock;
use crate::loc::Loc;

/// A module of somebody else, such as a PLL or a memory of a chip. A module that names it in
/// [`Module::foreign`](super::Module::foreign) is a model of it, with the same ports.
///
/// ```
/// # use tilewright_hdl::*;
/// # block! {
/// #     struct Buffer;
/// #     foreign = Foreign::module("BUF");
/// #     in BufferIn { word: bit() }
/// #     out BufferOut { same: bit() }
/// # }
/// # impl Buffer {
/// #     fn build(&self, _: Module, i: BufferIn) -> BufferOut {
/// #         BufferOut { same: i.word }
/// #     }
/// # }
/// let design = elaborate(&Buffer)?;
/// assert_eq!(design.top().foreign.as_ref().map(|foreign| &*foreign.module), Some("BUF"));
/// # Ok::<(), Problems>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Foreign {
    /// Its name in Verilog.
    pub module: String,
    /// The values of its parameters.
    pub parameters: Vec<(String, Parameter)>,
    /// The attributes of its instances.
    pub attributes: Vec<Attribute>,
    /// Whether its ports are in capitals.
    pub capitals: bool,
    /// The paths of the block's ports, and the names of these ports in the foreign module.
    pub ports: Vec<(String, String)>,
    /// The ports for clocks; `None` is the default clock.
    pub clocks: Vec<(Option<Clock>, String)>,
    /// The ports for the resets of clocks.
    pub resets: Vec<(Option<Clock>, String)>,
    /// The clocks that it makes, and its ports for them.
    pub makes: Vec<(Clock, String)>,
    /// The place in the description.
    pub loc: Loc,
}

/// The value of a parameter.
///
/// ```
/// # use tilewright_hdl::*;
/// use tilewright_hdl::ir::Parameter;
///
/// assert_eq!(Parameter::from(7u32), Parameter::Integer(7));
/// assert_eq!(Parameter::from("SIMPLE"), Parameter::Text("SIMPLE".to_owned()));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Parameter {
    /// An integer.
    Integer(i64),
    /// A constant of a certain width.
    Bits(Bits),
    /// A real number.
    Real(f64),
    /// A text.
    Text(String),
}

macro_rules! integers {
    ($($ty:ty)*) => {$(
        impl From<$ty> for Parameter {
            fn from(value: $ty) -> Parameter {
                Parameter::Integer(value.into())
            }
        }
    )*};
}
integers!(i8 i16 i32 i64 u8 u16 u32 bool);

impl From<Bits> for Parameter {
    fn from(value: Bits) -> Parameter {
        Parameter::Bits(value)
    }
}

impl From<f64> for Parameter {
    fn from(value: f64) -> Parameter {
        Parameter::Real(value)
    }
}

impl From<&str> for Parameter {
    fn from(value: &str) -> Parameter {
        Parameter::Text(value.to_owned())
    }
}

impl From<String> for Parameter {
    fn from(value: String) -> Parameter {
        Parameter::Text(value)
    }
}
