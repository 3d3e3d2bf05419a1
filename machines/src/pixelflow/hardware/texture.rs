//! The simulated texture unit, beside the array whose registers it serves.

use tilewright_rtl::parameter::ParameterError;
use tilewright_rtl::pixelflow::ARRAY;
use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_rtl::pixelflow::registers::PortAccess;
use tilewright_rtl::pixelflow::texture_memory::TextureMemory;
use tilewright_rtl::pixelflow::texture_unit::{TextureUnit, TextureUnitIn, TextureUnitOut};
use tilewright_scenes::Texture;
use tilewright_sim::{Bundle, EngineKind, Port, Simulation};

use super::observed::Observed;
use crate::error::Error;
use crate::pixelflow::following::TextureObserver;
use crate::tracer::Tracer;

/// A texture unit with textures in its memory.
pub(in crate::pixelflow) struct TextureLookUp {
    block: TextureUnit,
    pub unit: Observed<TextureUnitIn, TextureUnitOut, TextureObserver>,
}

impl TextureLookUp {
    /// A texture unit for such an array, with these textures. They are written before the frame, one texel a clock.
    ///
    /// # Errors
    /// [`Error::Parameter`]: a texture is too fine for the hardware; [`Error::Simulation`].
    pub fn new<'a>(
        array: &PixelArray,
        textures: impl ExactSizeIterator<Item = &'a Texture> + Clone,
        engine: EngineKind,
    ) -> Result<TextureLookUp, Error> {
        if let Some(texture) = textures.clone().find(|texture| texture.level() > TextureMemory::FINEST) {
            let (side, most) = (1_u64 << texture.level(), 1_u64 << TextureMemory::FINEST);
            let problem = format!(
                "a texture of {side}x{side} texels: a node's textures have at most {most} a side; take a smaller picture"
            );
            return Err(ParameterError(problem).into());
        }
        let size: u64 = textures.clone().map(|texture| TextureMemory::size(texture.level())).sum();
        let count = textures.len() as u32;
        let memory = TextureMemory { texels: (size as u32).max(2), textures: count.max(2) };
        let block = TextureUnit { chips: array.chips(), pixels: array.pixels(), memory };
        let mut sim = Simulation::at(&block, ARRAY.period)?.on(engine);
        for port in [sim.i.start, sim.i.write.valid, sim.i.describe.valid] {
            sim.set(port, false);
        }
        sim.try_reset()?;
        let mut unit = TextureLookUp { block, unit: Observed::new(sim) };
        let mut base = 0;
        for (number, texture) in textures.enumerate() {
            unit.write(number as u64, base, texture)?;
            base += TextureMemory::size(texture.level());
        }
        Ok(unit)
    }

    /// Begins a waveform of it, if the unit of that name is traced.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn trace(&mut self, tracer: &Tracer, name: &str) -> Result<(), Error> {
        tracer.attach(name, (&self.block, ARRAY.period), &mut self.unit.sim)
    }

    fn write(&mut self, number: u64, base: u64, texture: &Texture) -> Result<(), Error> {
        let sim = &mut self.unit.sim;
        let (describe, write) = (sim.i.describe, sim.i.write);
        sim.set(describe.texture, number);
        sim.set(describe.base, base);
        sim.set(describe.finest, texture.level());
        sim.set(describe.valid, true);
        sim.set(write.valid, true);
        for level in 0..=texture.level() {
            let side = 1_u32 << level;
            for (j, i) in (0..side).flat_map(|j| (0..side).map(move |i| (j, i))) {
                let place = TextureMemory::place(base, level, i.into(), j.into());
                let [red, green, blue] = texture.texel(level, i, j).map(u64::from);
                sim.set(write.bank, place.bank);
                sim.set(write.address, place.address);
                sim.set(write.texel, blue << 16 | green << 8 | red);
                sim.try_step()?;
                sim.set(describe.valid, false);
            }
        }
        sim.set(write.valid, false);
        Ok(())
    }

    /// Clocks for a region, whatever the textures are.
    pub fn clocks(array: &PixelArray) -> u64 {
        let memory = TextureMemory { texels: 2, textures: 2 };
        TextureUnit { chips: array.chips(), pixels: array.pixels(), memory }.clocks()
    }

    /// Simulates a clock of the unit, before that of the array whose registers it reads and writes. Returns whether it has finished.
    ///
    /// # Errors
    /// [`Error::Simulation`].
    pub fn clock<I: Bundle, O: Bundle>(
        &mut self,
        array: &mut Simulation<I, O>,
        registers: PortAccess<Port>,
        seen: Port,
        starts: bool,
    ) -> Result<bool, Error> {
        if !starts && !self.unit.is_busy {
            array.set(registers.writes, false);
            return Ok(false);
        }
        let unit = &mut self.unit.sim;
        let port = unit.o.port;
        array.set(registers.pixel, unit.get_u64(port.pixel));
        array.set(registers.address, unit.get_u64(port.address));
        // The port is either read or written in a clock.
        let writes = unit.get_u64(port.writes) == 1;
        array.set(registers.writes, writes);
        match writes {
            true => array.set(registers.bytes, unit.limbs(port.bytes)),
            false => unit.set(unit.i.seen, array.limbs(seen)),
        }
        unit.set(unit.i.start, starts);
        let is_done = unit.get_u64(unit.o.done) == 1;
        self.unit.clock(is_done)?;
        Ok(is_done)
    }
}
