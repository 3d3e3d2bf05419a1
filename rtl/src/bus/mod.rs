//! The broadcast bus of the VC-1, over which its processors get scenes, commands and large polygons (VC1-NET).

mod broadcast_bus;

pub use broadcast_bus::{BroadcastBus, BroadcastBusIn, BroadcastBusOut, BusWord};
