//! The VC-1's model for runs that the circuit is too slow for.

use std::sync::Arc;

use tilewright_machines::vc1::Config;
use tilewright_machines::vc1::model::Model;
use tilewright_scenes::Scene;

/// Milliseconds for which this thread has run.
fn processor_time() -> f64 {
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").expect("on Linux");
    times.split(' ').next().and_then(|it| it.parse::<f64>().ok()).expect("nanoseconds") / 1e6
}

/// `cargo test --release -p tilewright-machines --test all a_frame_takes_milliseconds -- --ignored --nocapture` prints what a frame takes.
#[test]
#[ignore = "measures"]
fn a_frame_takes_milliseconds() {
    for (scene, immediate) in
        [("ter1k", false), ("ter250", false), ("ter250", true), ("table", false), ("teapot", false)]
    {
        let view = Arc::new(Scene::builtin(scene).expect("a built-in scene").project().expect("in sight"));
        for processors in [1, 16, 64, 256] {
            let apr = (processors > 1).then_some(500 * 16 / processors);
            let model =
                Model::new(Config { processors, apr, immediate, ..Config::new(view.size) }).expect("can be built");
            let begin = processor_time();
            let dealt = model.deal(&view, None).expect("of its size");
            let dealing = processor_time() - begin;
            let begin = processor_time();
            let report = model.render(std::iter::repeat_n(dealt, 10));
            let each = (processor_time() - begin) / 10.0;
            let refreshes: u64 = report.frames.iter().map(|it| it.refreshes).sum();
            let mode = if immediate { " sent each time" } else { "" };
            println!(
                "{scene}{mode}, n = {processors}: dealt in {dealing:.1} ms, {each:.1} ms a frame of {refreshes} / 10 refreshes"
            );
        }
    }
}
