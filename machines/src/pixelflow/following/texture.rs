//! A shader's texture unit in each clock, as far as it is about one pixel; its memory for any point.

use std::collections::VecDeque;
use std::sync::Arc;

use tilewright_rtl::pixelflow::array::PixelArray;
use tilewright_rtl::pixelflow::texture_unit::{TextureUnitIn, TextureUnitOut};
use tilewright_scenes::Texture;
use tilewright_sim::Simulation;

use super::array::Place;
use super::{Observer, texture_unit_of};
use crate::error::Error;
use crate::looks::Looks;
use crate::pixelflow::costs::Ticks;
use crate::told::{Checks, Told, Unit, compared, violated};

const CLOCK: (&str, u64) = ("clk", 10_000);
/// Bytes of a request, and of its texels; the register of the first texel; the clocks of the memory.
const ASKED: u64 = 6;
const TEXELS: u64 = 24;
const FIRST: u64 = 8;
const LATENCY: usize = 3;
const PORT: [&str; 5] = ["start", "port_pixel", "port_address", "port_writes", "done"];
const REQUEST: [&str; 6] = ["request_valid", "request_u", "request_v", "request_level", "request_texture", "valid"];

/// A texture unit.
pub(in crate::pixelflow) struct TextureObserver {
    told: Told,
    tick: Ticks,
    place: Place,
    chips: u64,
    pixels: u64,
    textures: Vec<Arc<Texture>>,
    /// For each start, whether it is for the region of the pixel; and the number of starts.
    followed: Vec<bool>,
    starts: usize,
    units: [Unit; 2],
    looks: Looks,
    places: [usize; 2],
    /// Clocks since the start; what the pixel asked, and the texels that the memory gave.
    clock: Option<u64>,
    asked: [u8; ASKED as usize],
    texels: [u64; 8],
    to_come: VecDeque<Option<Option<[u64; 8]>>>,
}

impl TextureObserver {
    /// Of the shader of that name.
    pub fn new(
        name: &str,
        array: &PixelArray,
        textures: &[Arc<Texture>],
        place: Place,
        followed: Vec<bool>,
    ) -> TextureObserver {
        let (mut looks, chip) = (Looks::default(), format!("[{}]", place.chip));
        let port = looks.add("", PORT);
        looks.add("", [format!("port_bytes{chip}"), format!("seen{chip}")].iter().map(|it| &**it));
        let memory = looks.add("u_memory.", REQUEST);
        let texels: Vec<String> = (0..8).map(|texel| format!("u_memory.texels[{texel}]")).collect();
        looks.add("", texels.iter().map(|it| &**it));
        TextureObserver {
            told: Told::of(texture_unit_of(name)),
            tick: 0,
            place,
            chips: array.chips().into(),
            pixels: array.pixels().into(),
            textures: textures.to_vec(),
            followed,
            starts: 0,
            units: [
                Unit::new(texture_unit_of(name), "texture-unit", CLOCK, ""),
                Unit::new(format!("texture memory of {name}"), "texture-memory", CLOCK, "u_memory."),
            ],
            looks,
            places: [port, memory],
            clock: None,
            asked: [0; 6],
            texels: [0; 8],
            to_come: (0..LATENCY).map(|_| None).collect(),
        }
    }

    fn is_followed(&self) -> bool {
        self.starts.checked_sub(1).and_then(|start| self.followed.get(start)) == Some(&true)
    }

    /// Compares the texels with those of the request before, and notes those of the pixel.
    fn remember(&mut self, [valid, u, v, level, texture, gives]: [u64; 6], memory: usize, checks: &mut Checks) {
        let requested = (valid == 1).then(|| self.textures.get(texture as usize).map(|it| around(it, u, v, level)));
        self.to_come.push_back(requested);
        let come = self.to_come.pop_front().flatten();
        checks.bit("valid", gives, come.is_some());
        let seen: [u64; 8] = self.looks.from(memory + REQUEST.len());
        if let Some(Some(right)) = come {
            for (seen, right) in seen.into_iter().zip(right) {
                checks.same("texels", format!("{seen:06x}"), format!("{right:06x}"));
            }
        }
        let turn = self.chips.max(ASKED + TEXELS);
        let of_pixel = turn * (u64::from(self.place.pixel) + 1) + u64::from(self.place.chip) + LATENCY as u64;
        if self.clock == Some(of_pixel) {
            self.texels = seen;
            let right = come.flatten().unwrap_or(seen);
            let text = |texels: [u64; 8]| texels.map(|texel| format!("{texel:06x}")).join(" ");
            let values = vec![compared("texels", text(seen), text(right))];
            if !self.is_followed() {
                return;
            }
            self.told.tell(self.units[1].step_at(
                "valid",
                self.tick / 2,
                None,
                "gives the texels of the pixel",
                values,
            ));
        }
    }
}

impl Observer<TextureUnitIn, TextureUnitOut> for TextureObserver {
    fn now(&mut self, tick: Ticks) {
        self.tick = tick;
    }

    fn look(&mut self, sim: &mut Simulation<TextureUnitIn, TextureUnitOut>) {
        self.looks.look(sim);
        let mut checks = Checks::default();
        let [port, memory] = self.places;
        let [start, pixel, address, writes, done, bytes, seen] = self.looks.from(port);
        let request: [u64; 6] = self.looks.from(memory);
        let turn = self.chips.max(ASKED + TEXELS);
        let all = turn * (self.pixels + 2);
        let clock = self.tick / 2;
        let here = u64::from(self.place.pixel);
        let mut tells = None;
        match self.clock {
            None => {
                checks.same("port_writes", writes, 0);
                checks.same("done", done, 0);
            }
            Some(now) => {
                let (round, at) = (now / turn, now % turn);
                if round < self.pixels && at < ASKED {
                    checks.same("port_pixel", pixel, round);
                    checks.same("port_address", address, at);
                    if round == here {
                        self.asked[at as usize] = seen as u8;
                    }
                }
                let is_written = round >= 2 && (ASKED..ASKED + TEXELS).contains(&at);
                checks.bit("port_writes", writes, is_written);
                if is_written {
                    checks.same("port_pixel", pixel, round - 2);
                    checks.same("port_address", address, at - ASKED + FIRST);
                    if round - 2 == here {
                        let byte = at - ASKED;
                        checks.same("port_bytes", bytes, self.texels[byte as usize / 3] >> (8 * (byte % 3)) & 0xff);
                    }
                }
                let asks = round >= 1 && round <= self.pixels && at < self.chips;
                checks.bit("request_valid", request[0], asks);
                if asks && round == here + 1 && at == u64::from(self.place.chip) {
                    let [u, u_high, v, v_high, level, texture] = self.asked.map(u64::from);
                    let right = [u | u_high << 8, v | v_high << 8, level, texture];
                    for ((what, seen), right) in REQUEST[1..5].iter().zip(&request[1..5]).zip(right) {
                        checks.same(what, *seen, right);
                    }
                    tells = Some(right);
                }
                checks.bit("done", done, now + 1 == all);
            }
        }
        let step = self.units[0].differing(clock, "reads requests and writes texels", &mut checks);
        self.told.extend(step);
        self.remember(request, memory, &mut checks);
        let step = self.units[1].differing(clock, "reads texels", &mut checks);
        self.told.extend(step);
        if let Some([u, v, level, texture]) = tells.filter(|_| self.is_followed()) {
            let values = [("u", u), ("v", v), ("level", level), ("texture", texture)];
            let values = values.map(|(what, value)| compared(what, value, value)).to_vec();
            self.told.tell(self.units[0].step_at(
                "u_memory.request_u",
                clock,
                None,
                "asks for the texels of the pixel",
                values,
            ));
        }
        self.clock = match (start, self.clock) {
            (1, _) => {
                self.starts += 1;
                Some(0)
            }
            (_, Some(now)) if now + 1 < all => Some(now + 1),
            _ => None,
        };
    }

    fn fail(&mut self, error: &Error) {
        let Some((instance, sentence)) = violated(error).filter(|_| !self.told.differs()) else { return };
        let unit = &self.units[usize::from(instance == "u_memory")];
        self.told.tell(unit.fails(self.tick / 2, sentence));
    }

    fn told(&mut self) -> &mut Told {
        &mut self.told
    }
}

/// The texels around a point, on a level and the next finer one.
fn around(texture: &Texture, u: u64, v: u64, level: u64) -> [u64; 8] {
    std::array::from_fn(|number| {
        let level = (level + number as u64 / 4).min(texture.level().into()) as u32;
        let side = 1_i64 << level;
        let place = |part: u64, next: usize| {
            let low = (((part << level >> 8) as i64) - 128) >> 8;
            (low + next as i64).rem_euclid(side) as u32
        };
        let [red, green, blue] = texture.texel(level, place(u, number & 1), place(v, number >> 1 & 1)).map(u64::from);
        blue << 16 | green << 8 | red
    })
}
