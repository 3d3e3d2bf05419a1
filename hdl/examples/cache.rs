//! A two-way write-back cache between a processor and a memory. A plain model predicts each request to the memory.
//! `cargo run -p tilewright-hdl --example cache`

use tilewright_hdl::*;
use tilewright_sim::{Pauses, Simulation};

codes! {
    /// What the cache does.
    enum Step {
        /// It makes the lines of all sets invalid, one set a clock.
        Clear,
        /// It waits for a request.
        Idle,
        /// It compares the tags of the two lines.
        Compare,
        /// It writes the older line back, word by word.
        WriteBack,
        /// It reads the line that was asked for.
        Fetch,
        /// It reads the tags again.
        Retry,
    }
}

record! {
    /// A request of the processor.
    pub struct Request(address: u32) {
        /// It writes; otherwise it reads.
        write: bit(),
        /// The address of a word.
        address: bits(address),
        /// The word to write.
        data: bits(32),
        /// Which bytes of the word are written.
        bytes: bits(4),
    }

    /// A request to the memory.
    pub struct Transfer(address: u32) {
        /// It writes; otherwise it reads.
        write: bit(),
        /// The address of a word.
        address: bits(address),
        /// The word to write.
        data: bits(32),
    }

    /// What is known of a line.
    struct Line(tag: u32) {
        /// It is in the cache.
        valid: bit(),
        /// It differs from the memory.
        dirty: bit(),
        /// The upper part of its address.
        tag: bits(tag),
    }
}

block! {
    /// A two-way cache. It replaces the line that was used longer ago, and writes a changed line back then.
    ///
    /// ```text
    ///              .-------.  .-------.
    /// requests ===>| lines |  | data  |===> words
    ///              | 2 way |  | 2 way |===> transfers
    ///              '-------'  '-------'<=== fetched
    /// ```
    ///
    /// A reset makes all lines invalid. What was not yet written back is lost.
    pub struct Cache {
        /// The bits of an address of a word.
        pub address: u32,
        /// The number of sets.
        pub sets: u32,
        /// The words of a line.
        pub words: u32,
    }
    ranges { sets: powers_of_two(2..=4096), words: powers_of_two(2..=64) }
    latency = "1 clock for a hit, and a hit every 2 clocks";
    in(self) CacheIn {
        /// The requests of the processor.
        requests: stream(Request::widths(self.address)),
        /// The words that the memory was asked to read, in the order of the requests.
        fetched: stream(bits(32)),
    }
    out(self) CacheOut {
        /// A word for each request: as it was before the request.
        words: stream(bits(32)),
        /// What the memory has to read and to write.
        transfers: stream(Transfer::widths(self.address)),
    }
}

impl Cache {
    /// The bits of an address above those of the set and the word.
    fn tag_bits(&self) -> u32 {
        self.address - self.sets.ilog2() - self.words.ilog2()
    }

    fn build(&self, m: Module, i: CacheIn) -> CacheOut {
        let (word_bits, set_bits) = (self.words.ilog2(), self.sets.ilog2());
        let ways = row(2);
        def!(step = m.fsm(Clear));
        use Step::*;
        let [clears, idle, compares, writes_back, fetches, retries] =
            [Clear, Idle, Compare, WriteBack, Fetch, Retry].map(|it| step.is(it));

        // A request is looked up at the edge at which it is accepted, and again when its line is there.
        let new = i.requests.take_when(idle);
        def!(request = m.pipe_when(new.taken, *new));
        def!(looks_up = new.taken | retries);
        def!(address = mux(idle, new.address, request.address));
        let set = address.part(word_bits, set_bits);
        let tag = address.part(word_bits + set_bits, self.tag_bits());
        let place = address.trunc(word_bits);

        // The two lines of the set, and which of them was used last.
        def!(lines = m.memory(self.sets, Line::widths(self.tag_bits()).of(ways), ReadUnderWrite::Any));
        def!(latest = m.memory(self.sets, bit(), ReadUnderWrite::Any));
        def!(line = lines.read_when(looks_up, set));
        def!(hits = line.valid & line.tag.eq(tag));
        def!(hit = hits.or_all());
        def!(way = mux(hit, hits.lane(1), !latest.read_when(looks_up, set)));
        def!(is_chosen = stack([!way, way]));
        def!(chosen = line.pick(way));
        m.assert(compares.implies(!hits.and_all()), "a line is in one of the ways only");

        // A word is read for an answer, or before it is sent to the memory.
        def!(data = m.memory(self.sets * self.words, bits(8).of(grid(2, 4)), ReadUnderWrite::Any));
        def!(sent = m.reg(up_to(self.words)).reset(0));
        def!(moves = m.wire(bit()));
        let next_sent = (sent + moves.zext(sent.width())).trunc(word_bits);
        def!(
            row_read =
                data.read_when(looks_up | compares & !hit | writes_back, cat![set, mux(looks_up, place, next_sent)])
        );
        def!(word = row_read.rows().pick(way).pack());
        let (words, answered) = m.offer(compares & hit, word);
        m.assert(compares.implies(next_sent.eq(0)), "a line is sent from its first word on");

        // The line that is replaced goes to the memory, and the words of the new one are asked of it.
        let to = |tag: Signal| cat![tag, set, sent.trunc(word_bits)];
        let transfer = Transfer {
            write: writes_back,
            address: mux(writes_back, to(chosen.tag), to(tag)),
            data: mux(writes_back, word, 0),
        };
        let (transfers, moved) = m.offer(writes_back | fetches & sent.ne(self.words), transfer);
        moves.drive(moved);
        def!(is_sent = writes_back & moved & sent.eq(self.words - 1));
        sent.when(compares | is_sent, 0).when(moved, sent + 1);
        def!(came = m.reg(below(self.words)).reset(0));
        let fetched = i.fetched.take_when(fetches);
        came.when(fetched.taken, came + 1);
        def!(is_complete = fetched.taken & came.all_ones());

        // Both memories are written with a word of the processor, or one that was fetched.
        def!(stores = answered & request.write);
        let bytes = stores & request.bytes.unpack(row(4)) | fetched.taken;
        data.write(
            is_chosen.to_columns(4) & bytes.to_rows(2),
            cat![set, mux(stores, place, came)],
            mux(stores, request.data, *fetched).unpack(row(4)).to_rows(2),
        );
        def!(cleared = m.reg(below(self.sets)).reset(0));
        cleared.when(clears, cleared + 1);
        let changes = clears | (stores | is_complete) & is_chosen;
        lines.write(changes, mux(clears, cleared, set), Line { valid: !clears, dirty: stores, tag });
        latest.write(clears | answered, mux(clears, cleared, set), answered & way);

        step.next(|step| match step {
            Clear => when(cleared.all_ones(), Idle),
            Idle => when(new.taken, Compare),
            Compare => when(answered, Idle).or_when(!hit & chosen.dirty, WriteBack).or_when(!hit, Fetch),
            WriteBack => when(is_sent, Fetch),
            Fetch => when(is_complete, Retry),
            Retry => goto(Compare),
        });
        CacheOut { words, transfers }
    }
}

/// What a cache has to do, without words of its own.
struct Model {
    words_in_line: u64,
    /// What the processor sees in the memory, word by word.
    words: Vec<u64>,
    /// Of each set the tags of its lines, and whether they are dirty; the line that was used last stands first.
    sets: Vec<Vec<(u64, bool)>>,
}

impl Model {
    /// The answer to a request, and what is transferred before it.
    fn answer(&mut self, request: &Request<u64>) -> (u64, Vec<Transfer<u64>>) {
        let (line, sets) = (request.address / self.words_in_line, self.sets.len() as u64);
        let (set, tag) = (line % sets, line / sets);
        let lines = &mut self.sets[set as usize];
        let mut transfers = Vec::new();
        let mut transfer = |write: bool, tag: u64| {
            for address in (0..self.words_in_line).map(|word| (tag * sets + set) * self.words_in_line + word) {
                let data = if write { self.words[address as usize] } else { 0 };
                transfers.push(Transfer { write: u64::from(write), address, data });
            }
        };
        let dirty = match lines.iter().position(|it| it.0 == tag) {
            Some(at) => lines.remove(at).1,
            None => {
                let replaced = if lines.len() == 2 { lines.pop() } else { None };
                if let Some((old, true)) = replaced {
                    transfer(true, old);
                }
                transfer(false, tag);
                false
            }
        };
        lines.insert(0, (tag, dirty || request.write == 1));
        let word = &mut self.words[request.address as usize];
        let before = *word;
        let mask = (0..4).map(|byte| ((request.bytes >> byte) & 1) * (0xff << (8 * byte))).sum::<u64>();
        if request.write == 1 {
            *word = request.data & mask | before & !mask;
        }
        (before, transfers)
    }
}

/// The processor's side and the memory's, with random pauses of all.
fn converse(
    sim: &mut Simulation<CacheIn, CacheOut>,
    requests: &[Request<u64>],
    answers: &[u64],
    transfers: &[Transfer<u64>],
    initial: &[u64],
) {
    let (i, o) = (sim.i, sim.o);
    sim.reset();
    let t = &sim.testbench();
    let serves = async {
        let (mut memory, mut pauses) = (initial.to_vec(), Pauses::percent(50, 3));
        for (number, expected) in transfers.iter().enumerate() {
            t.wait(pauses.next_length().into()).await;
            let transfer = t.receive(o.transfers).await;
            assert_eq!(transfer, *expected, "transfer {number}");
            match transfer.write {
                1 => memory[transfer.address as usize] = transfer.data,
                _ => t.send(i.fetched, memory[transfer.address as usize]).await,
            }
        }
    };
    t.run((
        t.send_all(i.requests, requests.to_vec(), Pauses::percent(30, 1)),
        t.expect_all(o.words, answers.to_vec(), Pauses::percent(30, 2)),
        serves,
    ));
}

/// Runs it; a test does so too, and runs its Verilog against it.
pub fn run() -> Result<(Design, Recording), Box<dyn std::error::Error>> {
    const WORDS: u64 = 256;
    let cache = Cache { address: WORDS.ilog2(), sets: 4, words: 4 };
    let mut state = 1u64;
    let mut below = |limit: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % limit
    };
    let initial: Vec<u64> = (0..WORDS).map(|_| below(1 << 31)).collect();
    let mut model = Model { words_in_line: 4, words: initial.clone(), sets: vec![Vec::new(); 4] };

    // Any word, and one of 12 lines that compete for 8 places.
    let requests: Vec<Request<u64>> = (0..1000)
        .map(|_| {
            let limit = if below(8) == 0 { WORDS } else { 48 };
            let address = below(limit);
            Request { write: below(2), address, data: below(1 << 31), bytes: below(16) }
        })
        .collect();
    let (answers, transfers): (Vec<_>, Vec<_>) = requests.iter().map(|request| model.answer(request)).unzip();
    let transfers = transfers.concat();
    let written = transfers.iter().filter(|it| it.write == 1).count() / 4;
    let fetched = transfers.len() / 4 - written;
    assert!(written > 200 && fetched < 600, "{written} lines are written, and {fetched} fetched, for 1000 requests");

    // Once from memories of any contents, and once recorded.
    let mut sim = Simulation::of(&cache)?.seeded(7);
    converse(&mut sim, &requests, &answers, &transfers, &initial);
    let mut sim = Simulation::of(&cache)?;
    let recording = sim.recording();
    converse(&mut sim, &requests, &answers, &transfers, &initial);

    // Without pauses, hits take two clocks each.
    let last = *requests.last().expect("there are requests");
    let reads = vec![Request { write: 0, ..last }; 20];
    let answer = model.words[last.address as usize];
    let (i, o, before) = (sim.i, sim.o, sim.cycles("clk")?);
    let t = &sim.testbench();
    t.run((t.send_all(i.requests, reads, Pauses::NONE), t.expect_all(o.words, [answer; 20], Pauses::NONE)));
    assert_eq!(sim.cycles("clk")? - before, 40);
    Ok((elaborate(&cache)?, recording.take()))
}

/// Runs it, and prints its Verilog.
pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files = tilewright_gen::verilog(&run()?.0);
    files.iter().for_each(|file| print!("{}", file.text));
    Ok(())
}
