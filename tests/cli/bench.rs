//! `bench`.

use crate::harness::{Folder, Run};

#[test]
fn the_report_has_every_design_and_its_known_checksum() {
    let folder = Folder::new();
    let report = folder.json("bench qt2 simd64 --rounds 2 --seconds 0.001 --json");
    assert_eq!((&report["format"], &report["rounds"], &report["verilator"]), (&1.into(), &2.into(), &().into()));
    let [qt, simd] = report["designs"].as_array().unwrap().as_slice() else { panic!("{report}") };
    assert_eq!((&qt["design"], &simd["design"]), (&"qt2".into(), &"simd64".into()));
    if simd["cycles"] == 200 {
        assert_eq!(simd["checksum"], "ace7069c");
    }
    for design in [qt, simd] {
        let [ours, _] = design["simulators"].as_array().unwrap().as_slice() else { panic!("{design}") };
        assert_eq!((&ours["ratio"], &ours["build_seconds"]), (&1.0.into(), &().into()));
        assert!(ours["ns_per_cycle"].as_f64() > Some(0.0) && ours["first_cycle_seconds"].as_f64() > Some(0.0));
    }
}

#[test]
fn without_verilator_there_is_a_sentence() {
    let folder = Folder::new();
    let run = Run::of(folder.command("bench qt1 --against verilator").env("PATH", folder.path(".")).output().unwrap());
    assert_eq!((run.code, run.stdout.as_str()), (Some(4), ""), "{run:?}");
    assert!(run.stderr.starts_with("error: Verilator is not installed: apt-get install verilator"), "{run:?}");
}
