//! `bench`.

use crate::cli::harness::{Folder, Run};
use serde_json::Value;
use std::sync::OnceLock;
use tilewright_benches::{Subject, reset};
use tilewright_gen::tools::skipped;
use tilewright_sim::{EngineKind, Simulation};

/// What the reference engine ends with after the cycles of a measurement, as the report has it.
fn checksum(measured: &Value) -> String {
    let subject: Subject = measured["design"].as_str().unwrap().parse().unwrap();
    let design = subject.design().unwrap();
    let mut sim = Simulation::from_design(&design).unwrap().on(EngineKind::Reference);
    let port = sim.port("csum").unwrap();
    reset(&mut sim).unwrap();
    sim.run(measured["cycles"].as_u64().unwrap());
    format!("{:08x}", sim.get_u64(port))
}

#[test]
fn the_report_has_every_design_and_its_checksum() {
    let folder = Folder::new();
    let report = folder.json("bench qt2 simd64 --rounds 2 --seconds 0.001 --json");
    assert_eq!((&report["format"], &report["rounds"], &report["verilator"]), (&2.into(), &2.into(), &().into()));
    let [qt, simd] = report["designs"].as_array().unwrap().as_slice() else { panic!("{report}") };
    assert_eq!((&qt["design"], &simd["design"]), (&"qt2".into(), &"simd64".into()));
    for design in [qt, simd] {
        assert_eq!(design["checksum"], checksum(design), "{design}");
        let [ours, _] = design["simulators"].as_array().unwrap().as_slice() else { panic!("{design}") };
        assert_eq!((&ours["ratio"], &ours["build_seconds"]), (&1.0.into(), &().into()));
        assert!(ours["ns_per_cycle"].as_f64() > Some(0.0) && ours["first_cycle_seconds"].as_f64() > Some(0.0));
    }
}

/// The help's example of one rival.
const ONE_RIVAL: &str = "bench qt1 --against verilator --verilog qt --seconds 0.1 --json";

/// A command of the help texts, if its run is here. It is run once for all tests: Verilator's model takes long to build.
pub fn example(arguments: &str) -> Option<Run> {
    static RUN: OnceLock<Run> = OnceLock::new();
    (arguments == ONE_RIVAL).then(|| RUN.get_or_init(|| Folder::new().run(ONE_RIVAL)).clone())
}

#[test]
fn one_rival_can_be_asked_for_by_its_verilog() {
    let folder = Folder::new();
    let run = folder.run("bench pxpl8 qt1 --against verilator --verilog pxpl_planes");
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{run:?}");
    let sentence = "error: there is no Verilog `pxpl_planes` for qt1: give one of ours, qt\n";
    assert_eq!(run.stderr, sentence);
    assert_eq!(folder.run("bench pxpl8 --verilog pxpl").code, Some(2), "there is nothing to build it with");

    let run = example(ONE_RIVAL).unwrap();
    if run.code == Some(4) {
        let _ = skipped(run.stderr.trim_end());
        return;
    }
    let report: Value = serde_json::from_str(&run.stdout).unwrap();
    let [ours, rivals @ ..] = report["designs"][0]["simulators"].as_array().unwrap().as_slice() else {
        panic!("{report}")
    };
    assert_eq!(ours["made"], Value::Null);
    assert!(!rivals.is_empty() && rivals.iter().all(|it| it["made"]["verilog"] == "qt.v"), "{report}");
}

#[test]
fn without_verilator_there_is_a_sentence() {
    let folder = Folder::new();
    let run = Run::of(folder.command("bench qt1 --against verilator").env("PATH", folder.path(".")).output().unwrap());
    assert_eq!((run.code, run.stdout.as_str()), (Some(4), ""), "{run:?}");
    assert!(run.stderr.starts_with("error: Verilator is not installed: apt-get install verilator"), "{run:?}");
}
