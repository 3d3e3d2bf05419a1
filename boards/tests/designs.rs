//! Designs on a ULX3S, by what their pins do.

#[path = "../../blocks/examples/devices/flash.rs"]
mod flash;
#[path = "../../blocks/examples/devices/i2c.rs"]
#[allow(dead_code, reason = "other tests use more of it")]
mod i2c;
#[path = "../examples/designs/main.rs"]
mod tops;

use flash::Flash;
use i2c::{Bus, Eeprom, Stretching};
use std::cell::Cell;
use tilewright_blocks::I2cCommand;
use tilewright_boards::ulx3s::CORE;
use tilewright_gen::tools::lint_quickly;
use tilewright_gen::verilog;
use tilewright_hdl::elaborate;
use tilewright_sim::{Port, Simulation, Testbench, monitor};
use tops::served::{READER, Served};
use tops::top::{OnUlx3s, OnUlx3sIn, OnUlx3sOut};
use tops::uart::{far_end_receives, far_end_sends};
use tops::{figures, placed};

type Chip = Simulation<OnUlx3sIn, OnUlx3sOut>;

const CLOCKS_PER_BIT: u32 = 8;

/// A chip with one design, from power-on until the PLL has locked. It ignores its line before.
fn locked(design: Served) -> Chip {
    let mut sim = Simulation::of(&OnUlx3s { designs: vec![design], clocks_per_bit: CLOCKS_PER_BIT }).unwrap().seeded(3);
    let (rx, tx, locked) = (sim.i.rx[0], sim.o.tx[0], sim.o.locked);
    for (level, clocks, has_locked) in [(0, 20, 0), (1, 60, 1)] {
        sim.set(rx, level);
        sim.step_clock(CORE, clocks);
        assert_eq!((sim.get_u64(locked), sim.get_u64(tx)), (has_locked, 1));
    }
    sim
}

/// A request, its bytes, and the bytes of its answer.
type Request = (u128, u32, usize);

/// Sends each request as soon as the one before is answered. Returns the answers.
async fn asks(t: &Testbench<'_>, rx: Port, answered: &Cell<usize>, requests: &[Request]) {
    let mut expected = 0;
    for (request, bytes, answer) in requests {
        for byte in 0..*bytes {
            far_end_sends(t, rx, (request >> (8 * byte) & 0xff) as u64, 1, CLOCKS_PER_BIT.into()).await;
        }
        expected += answer;
        while answered.get() < expected {
            t.step().await;
        }
    }
}

/// The answers to these requests.
async fn hears(t: &Testbench<'_>, tx: Port, answered: &Cell<usize>, requests: &[Request]) -> Vec<u64> {
    let mut answers = Vec::new();
    for (.., bytes) in requests.iter().filter(|(.., bytes)| *bytes > 0) {
        let mut answer = 0;
        for byte in 0..*bytes {
            answer |= far_end_receives(t, tx, CLOCKS_PER_BIT.into()).await << (8 * byte);
            answered.set(answered.get() + 1);
        }
        answers.push(answer);
    }
    answers
}

/// What a design that has no other pads answers.
fn answers(sim: &mut Chip, requests: &[Request]) -> Vec<u64> {
    let (rx, tx) = (sim.i.rx[0], sim.o.tx[0]);
    let (t, answered) = (&sim.testbench().on(CORE), &Cell::new(0));
    t.run((asks(t, rx, answered, requests), hears(t, tx, answered, requests))).1
}

#[test]
fn registers_are_written_and_read_over_a_serial_line() {
    let mut sim = locked(Served::AxiLite);
    sim.set(sim.i.buttons[0], 0x55);
    let access = |write: u128, address: u128, data: u128| (write << 42 | address << 36 | 0xf << 32 | data, 6, 5);
    let accesses = [access(1, 0, 0x1234_56a7), access(0, 0, 0), access(0, 32, 0), access(0, 60, 0)];
    // The last address has no word: SLVERR.
    assert_eq!(answers(&mut sim, &accesses), [0, 0x1234_56a7, 0x55, 2 << 32]);
    assert_eq!(sim.get_u64(sim.o.leds[0]), 0xa7);
}

#[test]
fn vectors_are_transformed_over_a_serial_line() {
    let mut sim = locked(Served::Transform);
    // Twice the elements, in reverse sequence: 2 is 0x200.
    let matrix = (0..16).map(|at| ((0x80 | at) << 64 | if at / 4 + at % 4 == 3 { 0x200 } else { 0 }, 9, 0));
    let requests: Vec<Request> = matrix.chain([(0x0004_0003_0002_fff0, 9, 8)]).collect();
    assert_eq!(answers(&mut sim, &requests), [0xffe0_0004_0006_0008]);
}

#[test]
fn a_sine_comes_over_a_serial_line() {
    let answers = answers(&mut locked(Served::SineCosine), &[(0x2000, 2, 4)]);
    // The half of the root of two, give or take 2.
    for number in [answers[0] & 0xffff, answers[0] >> 16] {
        assert!(number.abs_diff(11_585) <= 2, "{number}");
    }
}

#[test]
fn a_cache_answers_over_a_serial_line_also_what_it_has_written_back() {
    let access = |write: u128, address: u128, data: u128| (write << 48 | address << 36 | data << 4 | 0xf, 7, 4);
    // Three lines of a set, whose ways are two: the first is written back.
    let writes = [access(1, 5, 0xcafe_0001), access(1, 512 + 5, 0xcafe_0002), access(1, 1024 + 5, 0xcafe_0003)];
    let reads = [access(0, 5, 0), access(0, 1024 + 5, 0), access(0, 512 + 5, 0)];
    let answers = answers(&mut locked(Served::Cache), &[writes, reads].concat());
    assert_eq!(answers[3..], [0xcafe_0001, 0xcafe_0003, 0xcafe_0002]);
}

#[test]
fn a_flash_memory_is_read_through_pads() {
    let mut sim = locked(Served::Flash);
    let (rx, tx) = (sim.i.rx[0], sim.o.tx[0]);
    let lines = [sim.o.flash_lines[0], sim.o.flash_lines[1], sim.o.flash_lines[2], sim.i.miso[0]];
    let mut flash = Flash::new((0..32).map(|byte| byte ^ 0x5a).collect(), READER.fast);
    let (t, answered) = (&sim.testbench().on(CORE), &Cell::new(0));
    let requests = [(30 << 16 | 3, 5, 3)];
    let (_, answers, _) = t.run((
        asks(t, rx, answered, &requests),
        hears(t, tx, answered, &requests),
        monitor(flash.runs(t, lines, READER.half_period, 1)),
    ));
    assert_eq!(answers, [0x5a_4544]);
}

#[test]
fn an_eeprom_is_written_and_read_through_pads() {
    let mut sim = locked(Served::I2c);
    let (rx, tx) = (sim.i.rx[0], sim.o.tx[0]);
    let lines = [sim.i.scl[0].drives, sim.i.sda[0].drives, sim.o.i2c_lines[0], sim.o.i2c_lines[1]];
    let (t, answered) = (&sim.testbench().on(CORE), &Cell::new(0));
    let (bus, mut eeprom) = (&Bus::new(t, lines), Eeprom::new(0x50, vec![0; 16]));
    use I2cCommand as Do;
    let writes = [Do::START, Do::write(0xa0), Do::write(14), Do::write(0x12), Do::STOP];
    let reads = [Do::START, Do::write(0xa0), Do::write(14), Do::START, Do::write(0xa1), Do::LAST_READ, Do::STOP];
    let of = |command: &I2cCommand<u64>| (u128::from(command.action << 9 | command.byte << 1 | command.last), 2, 2);
    let requests: Vec<Request> = writes.iter().chain(&reads).map(of).collect();
    let (_, answers, ..) = t.run((
        asks(t, rx, answered, &requests),
        hears(t, tx, answered, &requests),
        bus.scl(),
        bus.sda(),
        monitor(eeprom.runs(bus, Stretching::new(20, 400, 3))),
    ));
    // All are done and acknowledged.
    assert!(answers.iter().all(|answer| answer >> 8 == 0), "{answers:x?}");
    assert_eq!(answers[10], 0x12);
}

/// The designs with pads that are driven from both sides, and the cache. nextpnr takes far longer for the others.
/// `cargo run -p tilewright-boards --example designs` places each.
#[test]
fn designs_side_by_side_are_in_time() {
    let designs = [Served::Flash, Served::I2c, Served::Cache];
    let Some(placed) = placed(&designs).unwrap() else { return };
    println!("{}", figures(&placed));
    let wanted: Vec<_> = placed.clocks.iter().map(|(net, clock)| (net.as_str(), clock.wanted)).collect();
    // Nothing but the PLL runs on the clock of 25 MHz.
    assert_eq!(wanted, [("core_clk", 80.0)]);
    assert!(placed.clocks.values().all(|clock| clock.reached >= clock.wanted), "{}", figures(&placed));
    // Lines from and to each, the clock, the lock, MISO, and five pads that are driven from both sides.
    assert_eq!((placed.cells["EHXPLLL"], placed.cells["TRELLIS_IO"]), (1, 6 + 2 + 1 + 5));
}

#[test]
fn the_verilog_of_all_designs_is_clean() {
    let files = verilog(&elaborate(&OnUlx3s::at_115200_baud(&Served::all())).unwrap());
    let _ = lint_quickly(&[&files]).unwrap();
}
