//! Pictures of several passes on a whole machine.

use super::*;
use crate::gfb::Passes;
use crate::gfb::testing::average;

const WIDE: Screen = Screen { width: 64, height: 8 };

/// A machine whose T_m is one and a half refreshes of its display, as in the paper. A sum takes more than one refresh.
fn machine() -> Vc1 {
    let machine = Vc1 { accumulation: true, ..vc1(WIDE, 4, 32, 2) };
    let t_m = machine.gfb_swap().merge_clocks * MERGE.period.picoseconds();
    Vc1 { display: Display::of_rate(WIDE, 1.5e12 / t_m as f64, Blanking::AtStart).unwrap(), ..machine }
}

/// A picture of n passes takes 2 n + 1 refreshes: two for each pass, and one for their average (VC1-ACB).
#[test]
fn a_picture_takes_two_refreshes_for_a_pass_and_one_for_the_average() {
    for passes in [Passes::Two, Passes::Four] {
        let machine = machine();
        let colour = |frame: u32, processor: u64| 0x010000 * u64::from(frame) + 0x20 * processor + 7;
        let frames = 2 * passes.count();
        let drawn = |processor: u64| -> Vec<Vec<Pixel>> {
            (0..frames).map(|frame| vec![(3 + 40 * processor, 5, colour(frame, processor))]).collect()
        };
        let mut sim = running(&machine, 7);
        let host = sim.i.host.multipass[0];
        sim.set(host.accumulates, 1);
        sim.set(host.passes, passes.code());
        let ports: Vec<_> = sim.i.processors.iter().copied().zip(sim.o.processors.iter().copied()).collect();
        let (pixel, refreshes) = (sim.o.pixel, RefCell::new(vec![Vec::new()]));
        let t = sim.testbench();
        t.limit(4_000_000);
        let end = 3 + usize::try_from(2 * (2 * passes.count() + 1)).unwrap();
        let programs = ports.into_iter().zip(0..).map(|(ports, number)| program(&t, ports, 32, drawn(number)));
        let until = async {
            while refreshes.borrow().len() <= end {
                t.on("crt").wait(1).await;
            }
        };
        t.run((t.all(programs), until, monitor(display(&t, pixel, WIDE.pixels(), &refreshes))));
        drop(t);

        let of_frame = |frame: u32| nearest(WIDE, drawn(0)[frame as usize].iter().chain(&drawn(1)[frame as usize]));
        let pass = |frame: u32| of_frame(frame).iter().map(|word| word & 0xffffff).collect::<Vec<u64>>();
        let picture = |number: u32| {
            let its = number * passes.count()..(number + 1) * passes.count();
            let all: Vec<Vec<u64>> = its.map(pass).collect();
            let twice = all.iter().flat_map(|pass| [pass.clone(), pass.clone()]);
            twice.chain([average(&all)]).collect::<Vec<_>>()
        };
        let expected = [picture(0), picture(1)].concat();
        let refreshes = refreshes.into_inner();
        let first = refreshes.iter().position(|refresh| *refresh == expected[0]).expect("the first pass is shown");
        assert_eq!(refreshes[first..first + expected.len()], expected, "{passes:?}");
    }
}
