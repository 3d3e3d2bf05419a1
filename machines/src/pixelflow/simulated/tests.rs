//! The model beside the paper's formulas: in perfect balance, and with random primitives (facts A4, E4).

use super::*;
use crate::pixelflow::Nodes;

const EIGHT: Samples = Samples::Eight { rasterizations: 2.0 };
const SYSTEMS: [(System, u32); 5] =
    [(System::Base, 1), (System::Base, 4), (System::PreSort, 1), (System::PreSort, 4), (System::NonTexturing, 0)];

fn software(system: System, shaders: u32, samples: Samples) -> Software {
    Software::paper(system, Nodes::paper(shaders), samples)
}

/// The paper's primitives, at random places.
fn random(software: &Software, primitives: u64) -> Workload {
    software.paper_boxes(primitives, 1).unwrap()
}

/// The formula with what the machine does with eight samples: all regions of both renderings are composed, and so many shaded.
fn formula(software: Software, choices: Choices) -> Software {
    if !software.is_side_by_side() {
        return software;
    }
    let shaded = if choices.shades == Shades::EverySample { 320.0 } else { 40.0 };
    Software { composed: 320.0, shaded, ..software }
}

/// A region's way from a rasterizer to the frame buffer, in milliseconds, at most: what fills the pipe.
fn filling(software: &Software, primitives: usize, choices: Choices) -> f64 {
    let regions = software.regions_drawn();
    let shares = Workload::balanced(1, 1, primitives, software.draws());
    let one = software.turns(regions, choices);
    let last = one.last().unwrap();
    let shading = last.shades.unwrap();
    let waits = if choices.shades == Shades::OncePerPixel { 8 } else { 2 };
    milliseconds(waits * (shares.shares[0].draws() + last.composes) + 2 * shading.takes + shading.sends + last.loads)
}

#[test]
fn in_perfect_balance_the_formulas_hold_up_to_the_filling_of_a_region() {
    for (system, shaders) in SYSTEMS {
        for samples in [Samples::One, EIGHT] {
            for shades in [Shades::EverySample, Shades::OncePerPixel] {
                for primitives in [0, 1, 30, 300] {
                    let software = Software { overlap: 1.0, ..software(system, shaders, samples) };
                    let choices = Choices { shades, ..Choices::default() };
                    let rasterizers = software.nodes.rasterizers as usize;
                    let regions = software.regions_drawn();
                    let workload = Workload::balanced(rasterizers, regions as u16, primitives, software.draws());
                    let found = software.simulate(&workload, choices).latency;
                    let formula = formula(software, choices);
                    let expected = formula.latency(workload.primitives() as f64);
                    let most = match (system, choices.shades) {
                        (System::NonTexturing, _) => 0.1,
                        // While a shader works on the samples of pixels together, there is no room for those of the next ones.
                        (_, Shades::OncePerPixel) if software.is_side_by_side() => {
                            filling(&software, primitives, choices) + formula.times(0.0).shade
                        }
                        _ => filling(&software, primitives, choices),
                    };
                    let what = format!(
                        "{system:?}, {shaders}, {samples:?}, {shades:?}, {primitives}: {found} {expected} {most}"
                    );
                    assert!((-1e-6..most).contains(&(found - expected)), "{what}");
                }
            }
        }
    }
}

#[test]
fn bins_of_real_extents_have_the_papers_overlap() {
    for (samples, printed) in [(Samples::One, "1.25"), (EIGHT, "1.52")] {
        let software = software(System::Base, 1, samples);
        let overlap = random(&software, 200_000).overlap();
        assert!((overlap / software.overlap - 1.0).abs() < 0.005, "{overlap} {}", software.overlap);
        assert_eq!(format!("{overlap:.2}"), printed);
    }
}

#[test]
fn random_primitives_take_longer_than_balanced_ones_by_little() {
    for (system, shaders) in SYSTEMS {
        for samples in [Samples::One, EIGHT] {
            let software = software(system, shaders, samples);
            let found = software.simulate(&random(&software, 100_000), Choices::default());
            let expected = formula(software, Choices::default()).latency(100_000.0);
            let more = found.latency / expected - 1.0;
            println!("{system:?} {shaders} {samples:?}: {:.2} ms, formula {expected:.2} ms", found.latency);
            assert!((0.0..0.12).contains(&more), "{system:?}, {shaders}, {samples:?}: {more}");
        }
    }
}

/// PFL-600K.
#[test]
fn over_600_000_primitives_take_30_ms_without_textures() {
    let software = software(System::NonTexturing, 0, Samples::One);
    let latency = software.simulate(&random(&software, 600_000), Choices::default()).latency;
    assert!((29.0..30.0).contains(&latency), "{latency}");
    assert!(software.simulate(&random(&software, 610_000), Choices::default()).latency > 30.0);
}

/// C4 inverts: with one shader, all regions of eight samples take 35 ms to shade.
#[test]
fn shading_every_sample_turns_the_number_of_shaders_around() {
    let latency = |shaders, shades| {
        let software = software(System::Base, shaders, EIGHT);
        software.simulate(&random(&software, 100_000), Choices { shades, ..Choices::default() }).latency
    };
    assert!(latency(1, Shades::EverySample) > latency(4, Shades::EverySample));
    assert!(latency(1, Shades::OncePerPixel) < latency(4, Shades::OncePerPixel));
}

#[test]
fn one_way_takes_longer_where_the_network_is_the_slowest() {
    let software = software(System::Base, 4, EIGHT);
    let workload = random(&software, 1000);
    let latency = |one_way, set_up| {
        let choices = Choices { one_way, set_up, shades: Shades::OncePerPixel };
        software.simulate(&workload, choices).latency
    };
    let composed = formula(software, Choices::default()).times(0.0).compose;
    assert!(latency(false, 0) >= composed);
    // 40 times 3 bytes more.
    let more = latency(true, 0) - latency(false, 0);
    assert!((0.12..0.16).contains(&more), "{more}");
    // 320 compositions are set up, 1 us each.
    let more = latency(false, 200) - latency(false, 0);
    assert!((0.31..0.33).contains(&more), "{more}");
}

/// With shading once per pixel, four regions are shaded together, when the last rendering of the last one has come.
#[test]
fn a_shader_works_on_four_regions_at_once() {
    let software = software(System::Base, 4, EIGHT);
    let turns = software.turns(8, Choices { shades: Shades::OncePerPixel, ..Choices::default() });
    let takes: Vec<Ticks> = turns.iter().map(|turn| turn.shades.unwrap().takes).collect();
    let (works, waits): (Vec<_>, Vec<_>) = takes.iter().enumerate().partition(|(number, _)| number % 8 == 7);
    assert!(works.len() == 2 && works.iter().all(|(_, takes)| **takes > 0), "{takes:?}");
    assert!(waits.iter().all(|(_, takes)| **takes == 0), "{takes:?}");
}
