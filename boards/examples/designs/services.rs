//! Designs as they are used by bytes: requests come in, and answers go out, the lowest byte of each first.

use super::cache::{Cache, CacheIn, Request};
use super::served::{READER, master};
use super::transform::{Transform, TransformIn};
use tilewright_blocks::*;
use tilewright_hdl::*;

/// The requests that the bytes are.
fn requests<F: Fields<Width>>(m: Module, layout: &F, bytes: Stream) -> Stream<F::With<Signal>>
where
    F::With<Signal>: Data,
{
    let bits = layout.leaves().iter().map(|(_, width)| width.bits()).sum::<u32>();
    let words = m.widen("u_requests", bits.div_ceil(8), bytes);
    words.with(unpack(layout, words.trunc(bits)))
}

/// The bytes of answers.
fn answers<P: Data>(m: Module, answers: Stream<P>) -> Stream {
    let words = answers.packed();
    let parts = words.width().div_ceil(8);
    m.narrow("u_answers", parts, words.with(words.zext(8 * parts)))
}

record! {
    /// An access to registers.
    struct Access {
        write: bit(),
        /// Of a byte.
        address: bits(6),
        /// Which bytes are written.
        bytes: bits(4),
        data: bits(32),
    }
}

block! {
    /// Registers behind AXI4-Lite. Each access has 6 bytes, and its answer is 4 bytes of data and the response.
    pub struct AxiLiteService;
    in AxiLiteServiceIn { into: stream(bits(8)), buttons: bits(7) }
    out AxiLiteServiceOut { out: stream(bits(8)), leds: bits(8) }
}

impl AxiLiteService {
    fn build(&self, m: Module, i: AxiLiteServiceIn) -> AxiLiteServiceOut {
        let accesses = requests(m, &Access::widths(), i.into);
        let [reads, writes] = m.split_by(accesses, |access| access.write);
        let [aw, w] = m.fork("u_fork", writes);
        let to = |access: Access| AxiLiteAddress { addr: access.address, prot: lit(3, 0) };
        let pressed = (0..7).map(|number| m.synchronize(&format!("button{number}"), i.buttons.bit(number)));
        let pressed: Vec<Signal> = pressed.collect();
        let into = AxiLiteRegistersIn {
            aw: aw.with(to(*aw)),
            w: w.with(AxiLiteData { data: w.data, strb: w.bytes }),
            ar: reads.with(to(*reads)),
            status: vec![concat(&pressed.into_iter().rev().collect::<Vec<_>>()).zext(32)],
        };
        let registers = AxiLiteRegisters { address: 6, width: 32, registers: 8, status: 1 };
        def!(registers = m.instance(&registers, into));
        let (b, r) = (registers.b, registers.r);
        let both = [b.with(AxiLiteWord { data: lit(32, 0), resp: b.resp }), r];
        let words = m.arbiter("u_arbiter", Turns::Priority, both);
        let out = answers(m, words.with(cat![words.resp, words.data]));
        AxiLiteServiceOut { out, leds: registers.registers[0].trunc(8) }
    }
}

block! {
    /// Reads a flash memory. Each read has 5 bytes: the number of bytes, and the address.
    pub struct FlashService;
    in FlashServiceIn { into: stream(bits(8)), miso: bit() }
    out FlashServiceOut { out: stream(bits(8)), sck: bit(), mosi: bit(), cs_n: bit() }
}

impl FlashService {
    fn build(&self, m: Module, i: FlashServiceIn) -> FlashServiceOut {
        let reads = requests(m, &FlashRead { address: bits(24), length: bits(READER.length) }, i.into);
        def!(reader = m.instance(&READER, SpiFlashReaderIn { reads, miso: i.miso }));
        let out = reader.bytes.with(reader.bytes.byte);
        FlashServiceOut { out, sck: reader.sck, mosi: reader.mosi, cs_n: reader.cs_n }
    }
}

block! {
    /// Is told what to do on I2C. Each command has 2 bytes, and so has its answer.
    pub struct I2cService;
    in I2cServiceIn { into: stream(bits(8)), scl: bit(), sda: bit() }
    out I2cServiceOut { out: stream(bits(8)), scl_low: bit(), sda_low: bit() }
}

impl I2cService {
    fn build(&self, m: Module, i: I2cServiceIn) -> I2cServiceOut {
        let commands = requests(m, &I2cCommand::widths(), i.into);
        def!(master = m.instance(&master(), I2cMasterIn { commands, scl: i.scl, sda: i.sda }));
        I2cServiceOut { out: answers(m, master.answers), scl_low: master.scl_low, sda_low: master.sda_low }
    }
}

block! {
    /// Transforms vectors of four elements of 16 bits, with 8 bits after the point. Each request has 9 bytes: a vector
    /// and 0, or a coefficient in the first two bytes and `0x80 + place` in the last. A vector is answered by 8 bytes.
    pub struct TransformService;
    in = StreamIn { into: stream(bits(8)) };
    out = StreamOut { out: stream(bits(8)) };
}

impl TransformService {
    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        let requests = m.widen("u_requests", 9, i.into);
        let [vectors, coefficients] = m.split_by(requests, |request| request.msb());
        let coefficient = coefficients.take_when(1);
        let into = TransformIn {
            write: coefficient.taken,
            place: coefficient.part(64, 4),
            coefficient: coefficient.trunc(16).signed(),
            vectors: vectors.with(vectors.trunc(64).unpack(row(4)).signed()),
        };
        def!(transform = m.instance(&Transform { width: 16, fraction: 8 }, into));
        let results = transform.results;
        StreamOut { out: answers(m, results.with(results.pack())) }
    }
}

block! {
    /// Sines and cosines of angles of 2 bytes. Each answer has 2 bytes of a sine, and 2 of a cosine.
    pub struct SineCosineService;
    in = StreamIn { into: stream(bits(8)) };
    out = StreamOut { out: stream(bits(8)) };
}

impl SineCosineService {
    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        let angles = m.widen("u_requests", 2, i.into);
        def!(sines = m.instance(&SineCosine::new(16), StreamIn { into: angles }));
        StreamOut { out: answers(m, sines.points) }
    }
}

block! {
    /// A cache before a memory of 4096 words. Each request has 7 bytes, and its answer is a word of 4 bytes.
    pub struct CacheService;
    in = StreamIn { into: stream(bits(8)) };
    out = StreamOut { out: stream(bits(8)) };
}

impl CacheService {
    fn build(&self, m: Module, i: StreamIn) -> StreamOut {
        const ADDRESS: u32 = 12;
        let requests = requests(m, &Request::widths(ADDRESS), i.into);
        def!(fetched = m.stream_wire(bits(32)));
        let block = Cache { address: ADDRESS, sets: 64, words: 8 };
        def!(cache = m.instance(&block, CacheIn { requests, fetched: *fetched }));

        def!(memory = m.memory(1 << ADDRESS, bits(32), ReadUnderWrite::Any));
        def!(full = m.reg(bit()).reset(0));
        let transfer = cache.transfers.take_when(!full);
        memory.write(transfer.taken & transfer.write, transfer.address, transfer.data);
        def!(reads = transfer.taken & !transfer.write);
        def!(word = memory.read_when(reads, transfer.address));
        let (words, sent) = m.offer(full, word);
        full.when(reads, 1).when(sent, 0);
        fetched.drive(words);
        StreamOut { out: answers(m, cache.words) }
    }
}
