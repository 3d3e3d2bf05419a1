//! Registers behind AXI4-Lite: each channel with its own pauses.

use proptest::prelude::*;
use tilewright_blocks::*;
use tilewright_sim::{Pauses, Port, Simulation, Testbench, monitor};

type Slave = Simulation<AxiLiteRegistersIn, AxiLiteRegistersOut>;

const OKAY: u64 = AxiResponse::Okay as u64;
const SLVERR: u64 = AxiResponse::Slverr as u64;

fn at(addr: u64) -> AxiLiteAddress<u64> {
    AxiLiteAddress { addr, prot: addr & 7 }
}

#[test]
fn a_write_a_clock_until_an_answer_waits() {
    let mut sim = Simulation::of(&AxiLiteRegisters { address: 4, width: 32, registers: 2, status: 0 }).unwrap();
    sim.reset();
    let names = [
        "s_axi_awvalid",
        "s_axi_awaddr",
        "s_axi_awready",
        "s_axi_wvalid",
        "s_axi_wdata",
        "s_axi_wready",
        "s_axi_bvalid",
        "s_axi_bresp",
        "s_axi_bready",
    ];
    let wave = sim.record(names.into_iter().chain(["registers_0", "registers_1", "written"]));
    let rows = [
        (Some(0), Some(0x11), 1),
        (Some(4), Some(0x22), 1),
        (Some(8), Some(0x33), 1),
        (None, Some(0x44), 1), // the word waits for its address
        (None, None, 1),
        (Some(0), None, 1),
        (Some(4), Some(0x55), 0),
        (None, None, 0),
        (None, None, 1),
        (None, None, 1),
    ];
    for (address, word, ready) in rows {
        sim.set(sim.i.aw.valid, address.is_some());
        sim.set(sim.i.aw.addr, address.unwrap_or(0));
        sim.set(sim.i.w.valid, word.is_some());
        sim.set(sim.i.w.data, word.unwrap_or(0));
        sim.set(sim.i.w.strb, 0b1111);
        sim.set(sim.o.b.ready, ready);
        sim.step();
    }
    wave.expect(
        r"
        clk           |~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/~~\_/
        s_axi_awvalid |~~~~~~~~~~~~~~\_________/~~~~~~~~~\_______________
        s_axi_awaddr  | 0  | 4  | 8  | 0            | 4  | 0            |
        s_axi_awready |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_________/~~~~~
        s_axi_wvalid  |~~~~~~~~~~~~~~~~~~~\_________/~~~~\_______________
        s_axi_wdata   | 11 | 22 | 33 | 44 | 0       | 55 | 0            |
        s_axi_wready  |~~~~~~~~~~~~~~~~~~~\_________/~~~~\_________/~~~~~
        s_axi_bvalid  |____/~~~~~~~~~~~~~~\_________/~~~~~~~~~~~~~~~~~~~~
        s_axi_bresp   | Okay         | Slverr       | Okay              |
        s_axi_bready  |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_________/~~~~~~~~~~
        registers_0   | 0  | 11                     | 44                |
        registers_1   | 0       | 22                               | 55 |
        written       | 0  | 1  | 2  | 0            | 1  | 0       | 2  |",
    );
}

#[test]
fn a_read_at_the_edge_of_a_write_gives_the_old_word() {
    let mut sim = Simulation::of(&AxiLiteRegisters { address: 5, width: 64, registers: 1, status: 1 }).unwrap();
    sim.reset();
    let names = [
        "s_axi_arvalid",
        "s_axi_araddr",
        "s_axi_arready",
        "s_axi_rvalid",
        "s_axi_rdata",
        "s_axi_rresp",
        "s_axi_rready",
        "registers_0",
    ];
    let wave = sim.record(names);
    sim.set(sim.i.status[0], 0x99);
    sim.set(sim.i.aw.valid, 1);
    sim.set(sim.i.w.valid, 1);
    sim.set(sim.i.w.data, 0x1234);
    sim.set(sim.i.w.strb, 0b01);
    for (address, ready) in
        [(Some(0), 1), (Some(7), 1), (Some(8), 1), (Some(16), 0), (Some(0), 1), (Some(0), 1), (None, 1), (None, 1)]
    {
        sim.set(sim.i.ar.valid, address.is_some());
        sim.set(sim.i.ar.addr, address.unwrap_or(0));
        sim.set(sim.o.r.ready, ready);
        sim.step();
        sim.set(sim.i.aw.valid, 0);
        sim.set(sim.i.w.valid, 0);
    }
    wave.expect(
        r"
        clk           |~~~~\___/~~~~\___/~~~~\___/~~~~\___/~~~~\___/~~~~\___/~~~~\___/~~~~\___/
        s_axi_arvalid |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\__________________
        s_axi_araddr  | 0      | 7      | 8      | 10     | 0                                 |
        s_axi_arready |~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\________/~~~~~~~~~~~~~~~~~~~~~~~~~~~
        s_axi_rvalid  |________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\_________
        s_axi_rdata   | 0               | 34     | 99              | 0      | 34              |
        s_axi_rresp   | Okay                                       | Slverr | Okay            |
        s_axi_rready  |~~~~~~~~~~~~~~~~~~~~~~~~~~\________/~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
        registers_0   | 0      | 34                                                           |",
    );
}

/// A write: the number of a word, its data, and the bytes that are written.
type Written = (u64, u64, u64);

/// What registers hold after writes, by a plain program.
fn model(block: &AxiLiteRegisters, writes: &[Written]) -> Vec<u64> {
    let mut registers = vec![0; block.registers as usize];
    for &(word, data, strb) in writes {
        let mask = (0..8).filter(|byte| strb >> byte & 1 == 1).fold(0, |mask, byte| mask | 0xff << (8 * byte));
        if let Some(register) = registers.get_mut(word as usize) {
            *register = *register & !mask | data & mask;
        }
    }
    registers
}

/// At every instant: no output changes with an input, within the clock.
async fn has_no_path(t: &Testbench<'_>, inputs: &[Port], outputs: &[Port]) {
    let seen = || outputs.iter().map(|port| t.get_u64(*port)).collect::<Vec<_>>();
    loop {
        t.step().await;
        let before = seen();
        for input in inputs {
            t.suppose(*input, t.get_u64(*input) ^ 1, || assert_eq!(seen(), before, "a path within a clock"));
        }
    }
}

fn inputs(sim: &Slave) -> Vec<Port> {
    let AxiLiteRegistersIn { aw, w, ar, status } = sim.i.clone();
    let handshakes = [aw.valid, w.valid, ar.valid, sim.o.b.ready, sim.o.r.ready];
    handshakes.into_iter().chain([aw.addr, w.data, w.strb, ar.addr]).chain(status).collect()
}

fn outputs(sim: &Slave) -> Vec<Port> {
    let AxiLiteRegistersOut { b, r, registers, written } = sim.o.clone();
    let handshakes = [sim.i.aw.ready, sim.i.w.ready, sim.i.ar.ready, b.valid, r.valid];
    handshakes.into_iter().chain([b.resp, r.data, r.resp, written]).chain(registers).collect()
}

fn slaves() -> impl Strategy<Value = AxiLiteRegisters> {
    let sizes = (prop_oneof![Just(32u32), Just(64)], 1u32..6, 0u32..4, 6u32..13);
    sizes.prop_map(|(width, registers, status, address)| AxiLiteRegisters {
        address: address + 1,
        width,
        registers,
        status,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Writes go on while words that do not change are read; then all words are read.
    #[test]
    fn accesses_with_pauses_on_every_channel(
        block in slaves(), drawn in prop::collection::vec(any::<[u64; 3]>(), 0..30), stalls in any::<[u8; 5]>(), seed in any::<u64>(),
    ) {
        let mut sim = Simulation::of(&block).unwrap().seeded(seed);
        sim.reset();
        let (bytes, words) = (u64::from(block.width / 8), u64::from(block.registers + block.status));
        let status: Vec<u64> = (0..u64::from(block.status)).map(|number| 0x1111 * (number + 1)).collect();
        sim.set_list(|i| &i.status, status.clone());
        let writes = drawn.iter().map(|[word, data, strb]| {
            (word % (words + 2), data & (u64::MAX >> (64 - block.width)), strb & ((1 << bytes) - 1))
        });
        let writes: Vec<Written> = writes.collect();
        // The bits of an address within a word are not looked at.
        let addresses = writes.iter().map(|(word, data, _)| at(word * bytes + data % bytes));
        let data = writes.iter().map(|&(_, data, strb)| AxiLiteData { data, strb });
        let answers = writes.iter().map(|(word, ..)| if *word < u64::from(block.registers) { OKAY } else { SLVERR });
        let answers = answers.map(|resp| AxiLiteAnswer { resp });

        let registers = model(&block, &writes);
        let read = |word: u64| {
            let value = registers.iter().chain(&status).nth(word as usize);
            AxiLiteWord { data: value.copied().unwrap_or(0), resp: if value.is_some() { OKAY } else { SLVERR } }
        };
        let unchanged: Vec<u64> = drawn.iter().map(|[_, word, _]| u64::from(block.registers) + word % (u64::from(block.status) + 2)).collect();
        let all: Vec<u64> = (0..words + 2).collect();

        let pauses = |channel: usize| Pauses::percent(u64::from(stalls[channel]) % 90, seed ^ channel as u64);
        let (every_input, every_output) = (inputs(&sim), outputs(&sim));
        let (aw, w, ar, b, r, pulses) = (sim.i.aw, sim.i.w, sim.i.ar, sim.o.b, sim.o.r, sim.o.written);
        let t = &sim.testbench();
        let mut written = vec![0; block.registers as usize];
        let counts = async {
            loop {
                t.step().await;
                let now = t.get_u64(pulses);
                written.iter_mut().enumerate().for_each(|(number, count)| *count += now >> number & 1);
            }
        };
        let reads = |words: &[u64]| {
            let addresses: Vec<_> = words.iter().map(|word| at(word * bytes)).collect();
            let expected: Vec<_> = words.iter().map(|word| read(*word)).collect();
            (t.send_all(ar, addresses, pauses(3)), t.expect_all(r, expected, pauses(4)))
        };
        let (asks, hears) = reads(&unchanged);
        t.run((
            t.send_all(aw, addresses.collect::<Vec<_>>(), pauses(0)),
            t.send_all(w, data.collect::<Vec<_>>(), pauses(1)),
            t.expect_all(b, answers.collect::<Vec<_>>(), pauses(2)),
            asks,
            hears,
            monitor(t.holds(b)),
            monitor(counts),
            monitor(has_no_path(t, &every_input, &every_output)),
        ));
        let expected = (0..u64::from(block.registers)).map(|number| {
            writes.iter().filter(|(word, _, strb)| *word == number && *strb != 0).count() as u64
        });
        prop_assert_eq!(written, expected.collect::<Vec<_>>());
        let (asks, hears) = reads(&all);
        t.run((asks, hears, t.expect_silence(b, 10), monitor(t.holds(r))));
        prop_assert_eq!(sim.get_list(|o| &o.registers), registers);
    }
}

#[test]
fn addresses_that_are_too_short() {
    let problem = |block: AxiLiteRegisters| tilewright_hdl::elaborate(&block).unwrap_err().to_string();
    let short = problem(AxiLiteRegisters { address: 4, width: 32, registers: 4, status: 1 });
    assert!(
        short.starts_with("`address` of `AxiLiteRegisters` is 4: it has to be from 5 to 64. Every word has an address"),
        "{short}"
    );
    let odd = problem(AxiLiteRegisters { address: 4, width: 16, registers: 1, status: 0 });
    assert!(odd.starts_with("`width` of `AxiLiteRegisters` is 16: it has to be 32 or 64"), "{odd}");
}

#[test]
fn ports_have_the_names_and_the_sequence_of_the_standard() {
    let block = AxiLiteRegisters { address: 4, width: 32, registers: 1, status: 0 };
    let text = tilewright_gen::verilog(&tilewright_hdl::elaborate(&block).unwrap()).pop().unwrap().text;
    let head = text.split_once("(\n").unwrap().1.split_once(");").unwrap().0;
    let names = head
        .lines()
        .filter_map(|line| line.split("//").next().unwrap().trim().trim_end_matches(',').split(' ').next_back());
    let axi: Vec<&str> = names.filter_map(|name| name.strip_prefix("s_axi_")).collect();
    let expected = "awvalid awready awaddr awprot wvalid wready wdata wstrb arvalid arready araddr arprot \
                    bvalid bready bresp rvalid rready rdata rresp";
    assert_eq!(axi.join(" "), expected);
}
