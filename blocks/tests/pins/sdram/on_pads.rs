//! The controller with pads, whose bus is driven by one side at a time.

use super::*;
use tilewright_gen::{VerilogFile, testbench, verilog};
use tilewright_hdl::{Outside, elaborate};

fn small() -> (SdramController, Sheet) {
    let (rcd, rp, ras, rc, rfc, wr, mrd) = (2, 2, 4, 7, 5, 2, 2);
    let power_up = 4;
    let block = SdramController {
        row_bits: 11,
        column_bits: 3,
        bytes: 2,
        cas_latency: 2,
        late: 0,
        rcd,
        rp,
        ras,
        rc,
        rfc,
        wr,
        mrd,
        refresh: 40,
        power_up,
    };
    (block.clone(), sheet(&block, 7))
}

/// Goes through a clock. The chip drives the pads, or releases them.
fn step(
    sim: &mut Simulation<SdramOnPadsIn, SdramOnPadsOut>,
    chip: &mut Chip,
    wish: Option<Wish>,
) -> Result<bool, String> {
    let request = wish.unwrap_or(Wish::read(0, 0, 0)).request(3);
    let dq = Outside { value: sim.get_u64(sim.i.dq.value), drives: sim.get_u64(sim.i.dq.drives) };
    sim.drive(SdramOnPadsIn { request: Stream::of(wish.is_some().into(), request), dq });
    let taken = wish.is_some() && sim.get_u64(sim.i.request.ready) == 1;
    let mut inside = |name: &str| sim.peek(name).unwrap().to_u64().unwrap();
    let (line, driven) = (inside("u_dq.line"), inside("u_controller.dq_enable"));
    let lines =
        Lines { pins: sim.o.pins, dq_out: sim.i.dq.value, dq_enable: sim.i.dq.drives, dq: sim.i.dq.value, bytes: 2 };
    let seen = Seen { dq: line, driven: driven == 1, ..lines.seen(|port| sim.get_u64(port)) };
    let word = chip.edge(seen);
    sim.try_step().map_err(|error| error.to_string())?;
    sim.set(sim.i.dq.value, word.unwrap_or(0));
    sim.set(sim.i.dq.drives, word.is_some());
    Ok(taken)
}

/// Random requests and pauses. The result is the Verilog, and a bench that repeats them.
pub fn random_requests() -> (Vec<VerilogFile>, VerilogFile) {
    let (controller, sheet) = small();
    let design = elaborate(&SdramOnPads { controller }).unwrap();
    let mut sim = Simulation::of(&SdramOnPads { controller: small().0 }).unwrap().seeded(3);
    let recording = sim.recording();
    sim.reset();
    let mut chip = Chip::new(sheet);
    let mut chance = 1u64;
    let mut next = || {
        chance ^= chance << 13;
        chance ^= chance >> 7;
        chance ^= chance << 17;
        chance >> 8
    };
    let (mut wishes, mut words) = (Vec::new(), Vec::new());
    let mut wish = None;
    for clock in 0..700 {
        if wish.is_none() && clock < 600 && next() % 4 != 0 {
            let drawn = next();
            let write = (drawn % 3 == 0).then_some((next() & 0xffff, next() & 3));
            wish = Some(Wish { write, bank: drawn >> 8 & 3, row: drawn >> 16 & 1, column: drawn >> 24 & 7 });
        }
        sim.set(sim.o.words.ready, next() % 3 != 0 || clock > 600);
        let [valid, ready, payload] = [sim.o.words.valid, sim.o.words.ready, sim.o.words.payload];
        if [valid, ready].map(|port| sim.get_u64(port)) == [1, 1] {
            words.push(sim.get_u64(payload));
        }
        if step(&mut sim, &mut chip, wish).unwrap() {
            wishes.extend(wish.take());
        }
    }
    let (expected, _) = array(&Chip::new(small().1), &wishes);
    assert_eq!(words, expected);
    assert!(words.len() > 50 && wishes.len() > words.len() + 25, "{} of {}", words.len(), wishes.len());
    (verilog(&design), testbench(&design, &recording.take()))
}

#[test]
fn one_side_drives_the_bus() {
    random_requests();
}

/// A memory that drives the bus when it is not asked to.
#[test]
fn two_sides_that_drive_the_bus() {
    let (controller, sheet) = small();
    let mut sim = Simulation::of(&SdramOnPads { controller }).unwrap();
    sim.reset();
    let mut chip = Chip::new(sheet);
    let wish = Wish { write: Some((0xffff, 3)), ..Wish::read(0, 0, 0) };
    let ended = (0..200).find_map(|_| {
        sim.set(sim.i.dq.drives, 1);
        step(&mut sim, &mut chip, Some(wish)).err()
    });
    assert!(ended.unwrap().contains("the two sides of the pad do not drive different values"));
}
