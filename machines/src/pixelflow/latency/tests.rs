//! The paper's numbers, and what follows from its formulas (facts A4, B).

use super::*;
use crate::pixelflow::Stereo;

const EIGHT: Samples = Samples::Eight { rasterizations: 2.0 };

fn software(system: System, shaders: u32, samples: Samples) -> Software {
    Software::paper(system, Nodes::paper(shaders), samples)
}

/// To so many decimals.
fn rounded(number: f64, decimals: usize) -> String {
    format!("{number:.decimals$}")
}

#[test]
fn stages_take_what_the_paper_says() {
    let Times { compose, shade, load, .. } = software(System::Base, 1, Samples::One).times(0.0);
    assert_eq!([rounded(compose, 4), rounded(shade, 3), rounded(load, 2)], ["1.0752", "4.416", "2.08"]);
    let plain = software(System::NonTexturing, 0, Samples::One);
    assert_eq!(rounded(plain.times(0.0).compose, 4), "0.3584");
    // The paper rounds it to 360 us.
    assert!((plain.times(0.0).compose - 0.360).abs() < 0.002);
}

#[test]
fn the_non_texturing_system_draws_over_600_000_primitives_in_30_ms() {
    let plain = software(System::NonTexturing, 0, Samples::One);
    let primitives = plain.primitives_within(30.0);
    assert_eq!(rounded(primitives.floor(), 0), "607563");
    let Times { front, rasterize, .. } = plain.times(primitives);
    assert_eq!([rounded(front, 1), rounded(rasterize, 1)], ["27.9", "24.7"]);
    // D2: 3.3 times the base system.
    assert_eq!(rounded(primitives / software(System::Base, 1, Samples::One).primitives_within(30.0), 1), "3.3");
}

#[test]
fn least_latencies_with_eight_samples() {
    let least = |system, shaders| rounded(software(system, shaders, EIGHT).latency(0.0), 2);
    // C1 and C3.
    assert_eq!(least(System::NonTexturing, 0), "4.69");
    assert_eq!([least(System::Base, 4), least(System::Base, 1)], ["2.18", "4.52"]);
}

#[test]
fn one_shader_is_better_for_many_primitives() {
    let crossing = |system| {
        let [one, four] = [1, 4].map(|shaders| software(system, shaders, Samples::One));
        crossover(&one, &four).map(|primitives| primitives.ceil() as u64)
    };
    // In steps of 10, as the facts have them, 49,330 and 42,110.
    assert_eq!([crossing(System::Base), crossing(System::PreSort)], [Some(49_323), Some(42_102)]);
    assert_eq!(crossover(&software(System::Base, 4, Samples::One), &software(System::Base, 1, Samples::One)), None);
    // C4: 18 rasterizers for 15.
    for milliseconds in [30.0, 40.0] {
        let [one, four] = [1, 4].map(|shaders| software(System::Base, shaders, EIGHT).primitives_within(milliseconds));
        assert_eq!(rounded(one / four, 2), "1.20");
    }
}

/// C5 and D1 do not follow from the paper's constants.
#[test]
fn pre_sorting_gains_more_than_the_paper_says() {
    let gain = |samples| {
        let [sorted, base] =
            [System::PreSort, System::Base].map(|system| software(system, 1, samples).primitives_within(35.0));
        rounded(sorted / base, 2)
    };
    assert_eq!(gain(Samples::One), "1.32");
    let eight = |rasterizations| gain(Samples::Eight { rasterizations });
    assert_eq!([eight(1.0), eight(2.0), eight(4.0), eight(8.0)], ["1.42", "1.34", "1.19", "1.10"]);
}

#[test]
fn shading_every_sample_turns_the_number_of_shaders_around() {
    let every_sample = |shaders| Software { composed: 320.0, shaded: 320.0, ..software(System::Base, shaders, EIGHT) };
    assert_eq!(rounded(every_sample(1).latency(0.0), 1), "35.4");
    let [one, four] = [1, 4].map(|shaders| every_sample(shaders).primitives_within(40.0));
    assert_eq!([rounded(one / 1000.0, 0), rounded(four / 1000.0, 0)], ["44", "137"]);
}

#[test]
fn latency_grows_with_the_primitives() {
    for system in [System::Base, System::PreSort, System::NonTexturing] {
        for samples in [Samples::One, EIGHT] {
            let software = software(system, 1, samples);
            for milliseconds in [5.0, 20.0, 80.0] {
                let primitives = software.primitives_within(milliseconds);
                assert!(software.latency(primitives) <= milliseconds);
                assert!(software.latency(primitives + 1.0) > milliseconds);
            }
            assert_eq!(software.primitives_within(1.0), 0.0);
        }
    }
}

/// It works on both frames without a pause, and the last region follows.
#[test]
fn the_front_end_limits_two_frames() {
    let plain = software(System::NonTexturing, 0, Samples::One);
    let Times { front, compose, load, .. } = plain.times(500_000.0);
    assert_eq!(plain.stereo_latency(500_000.0, Stereo::Sequential), 2.0 * front + compose.max(load));
}
