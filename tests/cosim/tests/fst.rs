//! An FST file shows what the VCD file of the same run shows, to two readers: that of Surfer, and GTKWave's.

use proptest::strategy::ValueTree;
use std::path::Path;
use std::process::Command;
use tilewright_cosim::drawn::Kind;
use tilewright_cosim::spec::Stimulus;
use tilewright_cosim::stimulus::Numbers;
use tilewright_gen::tools;
use tilewright_hdl::Design;
use tilewright_sim::{EngineKind, Error, Fst, Passes, Simulation, Trace, Vcd};

const SEED: u64 = 2;

/// What a file has: its times, and each variable with its changes.
type Shown = (Vec<u64>, Vec<(String, Vec<(u64, String)>)>);

/// Reads a file as Surfer does.
fn read(path: &Path) -> Shown {
    let mut file = wellen::simple::read(path).expect("it can be read");
    let scale = file.hierarchy().timescale().expect("a time has a unit");
    assert_eq!((scale.factor, scale.unit), (1, wellen::TimescaleUnit::PicoSeconds));
    assert_eq!(file.hierarchy().date(), "");
    assert!(file.hierarchy().version().starts_with("Tilewright "));
    let signals: Vec<_> = file.hierarchy().all_vars().map(|name| file.hierarchy()[name].signal_ref()).collect();
    file.load_signals(&signals);
    let hierarchy = file.hierarchy();
    let variable = |name| {
        let variable: &wellen::Var = &hierarchy[name];
        let signal = file.get_signal(variable.signal_ref()).expect("it was loaded");
        let changes = signal.iter_changes().map(|(at, value)| (file.time_table()[at as usize], value.to_string()));
        let encoding = variable.signal_encoding(hierarchy);
        (format!("{:?} {encoding:?} {}", variable.var_type(), variable.full_name(hierarchy)), changes.collect())
    };
    (file.time_table().to_vec(), hierarchy.all_vars().map(variable).collect())
}

/// Runs a design under a random stimulus, also on after assertions that fail. Each failure ends a block.
fn run(design: &Design, stimulus: &Stimulus, trace: Trace) {
    let mut sim = Simulation::with_passes(design, &Passes { looks_after: 0, guarded: true, ..Passes::default() })
        .expect("it can be run")
        .on(EngineKind::Compiled);
    let top = design.top();
    let inputs = top.inputs.iter().map(|input| (sim.port(&input.name).expect("it is a port"), top.node(input.node)));
    let inputs: Vec<_> = inputs.collect();
    sim.trace(trace).expect("the file can be made");
    let mut numbers = Numbers(stimulus.seed);
    for _ in 0..stimulus.steps {
        for (port, node) in &inputs {
            if !numbers.draw().is_multiple_of(4) {
                sim.set(*port, numbers.lanes(node));
            }
        }
        match sim.try_run(numbers.draw() % 16) {
            Err(Error::Violated(_)) => {}
            done => done.expect("the file can be written"),
        }
    }
    sim.finish().expect("the file can be written");
}

#[test]
fn fst_files_of_random_designs_show_what_their_vcd_files_show() {
    let folder = tempfile::tempdir().expect("there is a place for files");
    let [vcd, fst, back] = ["run.vcd", "run.fst", "back.vcd"].map(|name| folder.path().join(name));
    let converts = tools::skipped_without(&["fst2vcd"]).is_none();
    let mut runs = 0;
    for number in 0..30 {
        let drawn = Kind::Mixed.draw(SEED, number).current();
        let design = drawn.design(number).unwrap_or_else(|problems| panic!("{problems}"));
        if design.top().clocks.is_empty() {
            continue;
        }
        runs += 1;
        let window = if number.is_multiple_of(3) { 7_000..150_000 } else { 0..u64::MAX };
        run(&design, drawn.stimulus(), Vcd::to(&vcd).times(window.clone()));
        run(&design, drawn.stimulus(), Fst::to(&fst).times(window.clone()));
        let expected = read(&vcd);
        assert!(read(&fst) == expected, "design {number} of seed {SEED}: {:#?}\nis not\n{expected:#?}", read(&fst));
        if converts && number.is_multiple_of(2) {
            let done = Command::new("fst2vcd")
                .args([&fst, &back].iter().zip(["-f", "-o"]).flat_map(|(file, flag)| [flag.as_ref(), file.as_os_str()]))
                .status();
            assert!(done.expect("it can be run").success());
            assert!(read(&back).1 == expected.1, "design {number} of seed {SEED}, converted");
        }
    }
    assert!(runs > 15, "{runs} designs have clocks");
}
