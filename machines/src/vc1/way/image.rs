//! An image memory: the pixels that are drawn into it.

use std::collections::{HashMap, VecDeque};

use tilewright_rtl::lfb::LfbUnit;

use super::drawing::Drawn;
use super::{Sim, pe};
use crate::looks::{Looks, Words};
use crate::told::{At, Told, compared, hex};

/// The word of a pixel where nothing is drawn.
pub(super) const EMPTY: u64 = (1 << 48) - 1;

/// The clocks after the end of the look-up in which the old word is read, the nearer word is known, and it is written.
const COMPARES: u64 = 2;
const WRITES: u64 = 3;
const HAS_WRITTEN: u64 = 4;

/// The model of an image memory.
pub(super) struct Image {
    number: u32,
    offset_bits: u32,
    /// The words of the memory.
    depth: u32,
    /// The words that are not empty, by address.
    words: HashMap<u32, u64>,
    under_way: VecDeque<Access>,
    nets: Nets,
}

/// A pixel that is being drawn.
struct Access {
    drawn: Drawn,
    /// The edge at which it came.
    came: u64,
    address: u32,
    word: u64,
    old: Option<u64>,
}

/// Nets: of their looks, the first one is [`LOOKED_AT`]'s.
struct Nets {
    place: usize,
    draw_word: String,
    address: String,
    words: Words,
}

const LOOKED_AT: [&str; 6] = ["draw_page", "draw_offset", "draw_word", "front", "old_word", "drawn_address"];

impl Image {
    /// One of the local frame buffer with that number and instance.
    pub fn new(number: u32, unit: &str, lfb: &LfbUnit, looks: &mut Looks) -> Image {
        let image = |name: &str| format!("{unit}.u_image_memory.{name}");
        let nets = Nets {
            place: looks.add(&image(""), LOOKED_AT),
            draw_word: image("draw_word"),
            address: image("drawn_address"),
            words: Words::of(image("words")),
        };
        let offset_bits = lfb.patches.pixels().ilog2();
        let depth = 2 * lfb.pages * lfb.patches.pixels();
        Image { number, offset_bits, depth, words: HashMap::new(), under_way: VecDeque::new(), nets }
    }

    fn at(&self, unit: &str, block: &'static str, clock: u64) -> At {
        At { unit: format!("{unit} of PE {}", self.number), block, edge: pe(clock) }
    }

    pub fn is_busy(&self) -> bool {
        !self.under_way.is_empty()
    }

    /// The address of a word.
    pub fn address(&self, page: u32, offset: u32, buffer: u32) -> u32 {
        (page << self.offset_bits | offset) << 1 | buffer
    }

    /// The word at an address.
    pub fn word(&self, address: u32) -> u64 {
        self.words.get(&address).copied().unwrap_or(EMPTY)
    }

    /// The scan reads and clears a word.
    pub fn sends(&mut self, address: u32) -> u64 {
        self.words.remove(&address).unwrap_or(EMPTY)
    }

    /// The buffers were exchanged. What is drawn into from now on has been sent and cleared.
    pub fn swaps(&mut self, front: u32) {
        self.words.retain(|address, _| address & 1 != front);
    }

    /// A pixel comes from the first stage, for that page, place in the page and buffer.
    pub fn takes(
        &mut self,
        clock: u64,
        (drawn, page, [offset, front]): (Drawn, u64, [u32; 2]),
        nets: &Looks,
        told: &mut Told,
    ) {
        let (pixel, _, primitive) = drawn;
        let [came_page, came_offset, came_word, came_front] = nets.from(self.nets.place);
        if (came_page, came_offset, came_word, came_front) != (page, offset.into(), pixel.word, front.into()) {
            told.check("draw", self.number, false, || {
                let values = vec![
                    compared("page", came_page, page),
                    compared("place in the page", came_offset, offset),
                    compared("word", hex(came_word), hex(pixel.word)),
                    compared("buffer", came_front, front),
                ];
                let at = self.at("local frame buffer", "lfb-unit", clock);
                at.step("passes the pixel to the image memory", values).of(primitive).on(&self.nets.draw_word)
            });
        }
        let address = self.address(came_page as u32, came_offset as u32, came_front as u32);
        self.under_way.push_back(Access { drawn, came: clock, address, word: came_word, old: None });
    }

    /// Looks at the memory before an edge.
    pub fn look(&mut self, sim: &mut Sim, clock: u64, nets: &Looks, told: &mut Told) {
        let [old, drawn] = nets.from(self.nets.place + 4);
        for at in 0..self.under_way.len() {
            let Access { came, address, .. } = self.under_way[at];
            match clock - came {
                COMPARES => self.under_way[at].old = Some(old),
                WRITES if drawn != u64::from(address) => told.check("address", self.number, false, || {
                    let values = vec![compared("address", drawn, address)];
                    let at = self.at("image memory", "image-memory", clock);
                    at.step("takes a pixel", values).on(&self.nets.address)
                }),
                _ => {}
            }
        }
        if let Some(access) = self.under_way.pop_front_if(|it| clock - it.came >= HAS_WRITTEN) {
            self.stays(sim, clock, &access, told);
        }
    }

    /// A pixel has been drawn.
    fn stays(&mut self, sim: &mut Sim, clock: u64, access: &Access, told: &mut Told) {
        let Access { drawn: (_, is_followed, primitive), address, word: new, old, .. } = *access;
        let expected = self.word(address);
        let nearer = expected.min(new);
        // An address may be outside of the memory, after a unit before this one has failed.
        let stays = if address < self.depth { self.nets.words.word(sim, address) } else { nearer };
        let old = old.unwrap_or_default();
        if is_followed || (old, stays) != (expected, nearer) {
            told.check("stays", self.number, is_followed, || {
                let values = vec![
                    compared("old word", hex(old), hex(expected)),
                    compared("new word", hex(new), hex(new)),
                    compared("word that stays", hex(stays), hex(nearer)),
                ];
                let at = self.at("image memory", "image-memory", clock - 1);
                at.step(format!("draws at address {address}"), values)
                    .of(primitive)
                    .on(format!("{}[{address}]", self.nets.words.name))
            });
        }
        self.words.insert(address, stays);
    }
}
