#![doc = include_str!("../../docs/deferred.md")]

mod appearance;
mod arithmetic;
mod constants;
mod mapping;
mod packet;
mod project;
mod samples;
mod shader;

pub use appearance::{APPEARANCE_BYTES, Appearance, Parameters};
pub use arithmetic::{
    MOST_COSINE, MOST_SQUARINGS, UNIT_BITS, between, brightness_at, coordinate, cosine, level_at, logarithm, power,
    product, saturated, unit_normal,
};
pub use mapping::MOST_REPEATS;
pub use packet::{AppearancePacket, AppearanceVertex, set_up_appearance};
pub use project::{Deferred, Pass, project_deferred};
pub use samples::{SECOND_SHIFT, Samples, Shading};
pub use shader::{MOST_LIGHTS, Shader, ShaderLight, ShaderMaterial};
