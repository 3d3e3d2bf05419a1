//! The image memory against a list of words: pixels drawn and sent at random, with stalls and exchanges of the buffers.

use proptest::prelude::*;
use tilewright_sim::Simulation;

use super::super::*;
use super::EMPTY;

/// A word's address: page, offset and buffer.
type Place = [u64; 3];

/// A pixel under way.
struct Drawn {
    place: Place,
    word: u64,
    /// The clocks that the pixel still takes.
    left: u32,
}

/// Both buffers in software.
struct Model {
    page_pixels: u64,
    words: Vec<u64>,
    drawn: Option<Drawn>,
    sent: u64,
}

impl Model {
    fn new(memory: &ImageMemory) -> Model {
        let words = vec![EMPTY; (2 * memory.pages * memory.page_pixels) as usize];
        Model { page_pixels: memory.page_pixels.into(), words, drawn: None, sent: EMPTY }
    }

    fn word(&mut self, [page, offset, buffer]: Place) -> &mut u64 {
        &mut self.words[((page * self.page_pixels + offset) * 2 + buffer) as usize]
    }

    fn ready(&self) -> bool {
        self.drawn.as_ref().is_none_or(|drawn| drawn.left == 1)
    }

    /// A clock of the processor. A pixel lowers its word in the third clock after its acceptance (VC1-ACC).
    fn processor_clock(&mut self, Draw { valid, page, offset, word }: Draw<u64>, front: u64) {
        let ready = self.ready();
        if let Some(drawn) = &mut self.drawn {
            drawn.left -= 1;
        }
        if let Some(Drawn { place, word, .. }) = self.drawn.take_if(|drawn| drawn.left == 0) {
            let kept = self.word(place);
            *kept = word.min(*kept);
        }
        if ready && valid == 1 {
            self.drawn = Some(Drawn { place: [page, offset, front], word, left: 3 });
        }
    }

    /// A clock of the merger. A pixel sent leaves an empty word (VC1-CLR1).
    fn merger_clock(&mut self, SendPixel { enable, resident, page, offset, buffer }: SendPixel<u64>) {
        if enable == 1 {
            let place = [page, offset, buffer];
            self.sent = if resident == 1 { std::mem::replace(self.word(place), EMPTY) } else { EMPTY };
        }
    }
}

/// The inputs from the processor and the scan until the next edge.
#[derive(Debug, Clone)]
struct Step {
    draw: Draw<u64>,
    exchange: bool,
    send: SendPixel<u64>,
}

fn step(pages: u32, page_pixels: u32) -> impl Strategy<Value = Step> {
    let flag = |probability| prop::bool::weighted(probability).prop_map(u64::from);
    // Few addresses and few words, so that many pixels collide, and some agree in half of their bits.
    let place = move || (0..u64::from(pages), prop_oneof![4 => 0..3u64, 1 => 0..u64::from(page_pixels)]);
    let half = || prop_oneof![4 => 0..3u64, 1 => Just(0xff_ffff)];
    let draw = (flag(0.7), place(), half(), half()).prop_map(|(valid, (page, offset), z, rgb)| Draw {
        valid,
        page,
        offset,
        word: z << 24 | rgb,
    });
    let send = (flag(0.7), flag(0.9), place(), 0..2u64)
        .prop_map(|(enable, resident, (page, offset), buffer)| SendPixel { enable, resident, page, offset, buffer });
    (draw, prop::bool::weighted(0.1), send).prop_map(|(draw, exchange, send)| Step { draw, exchange, send })
}

fn run() -> impl Strategy<Value = (ImageMemory, Vec<Step>)> {
    (2..6u32, prop::sample::select(vec![4, 8, 16u32])).prop_flat_map(|(pages, edge)| {
        let memory = ImageMemory { pages, page_pixels: edge * edge };
        (Just(memory), prop::collection::vec(step(pages, edge * edge), 1..200))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    /// Checks the outputs in every clock, and the contents at the end (VC1-ACC, VC1-CLR1, VC1-LFB). The scan reads any
    /// buffer but that of a pixel under way.
    #[test]
    fn it_keeps_the_smallest_word_until_it_is_sent((memory, steps) in run(), seed in any::<u64>()) {
        let mut sim = Simulation::of(&memory).unwrap().seeded(seed);
        sim.reset();
        let mut model = Model::new(&memory);
        let mut front = 0;
        for Step { mut draw, exchange, mut send } in steps {
            front ^= u64::from(exchange);
            draw.valid &= u64::from(model.ready());
            if let Some(Drawn { place: [.., buffer], .. }) = model.drawn {
                send.buffer = 1 - buffer;
            }
            sim.drive(ImageMemoryIn { draw, front, send });
            let o = sim.read_u64();
            prop_assert_eq!(o.idle == 1, model.drawn.is_none());
            prop_assert_eq!(o.sent, model.sent);

            let clocks = |sim: &Simulation<_, _>| [PE, MERGE].map(|clock| sim.cycles(clock).unwrap());
            let before = clocks(&sim);
            sim.step();
            let [pe, merge] = clocks(&sim);
            if merge > before[1] {
                model.merger_clock(send);
            }
            if pe > before[0] {
                model.processor_clock(draw, front);
            }
        }
        let held = (0..model.words.len() as u32).map(|i| sim.peek_memory("words", i).unwrap().to_u64().unwrap());
        prop_assert_eq!(held.collect::<Vec<_>>(), model.words);
    }
}
