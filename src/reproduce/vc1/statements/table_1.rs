//! Section 5.3, Table 1: the virtual local frame buffer beside regions.

use super::super::found::Found;
use super::super::regions::Means;
use super::super::table::{NAMES, PRINTED, vlfb};
use super::reasons::REGIONS;
use super::{WITHIN_1, WITHIN_10};
use tilewright_report::{Rule, Statement};

pub fn statements(found: &Found) -> Vec<Statement> {
    let Some(vlfb) = vlfb(found) else { return Vec::new() };
    let all = [vlfb, found.regional.machines[0], found.regional.machines[1], found.regional.machines[2]];
    let [_, _, four_with_2, four_with_4] = all;
    let model = || found.model();
    let by_name = |of: fn(&Means) -> f64, means: &[Means; 4]| [1, 2, 3].map(|at| (NAMES[at], of(&means[at])));
    let time: fn(&Means) -> f64 = |it| it.time;
    let waiting: fn(&Means) -> f64 = |it| it.synchronization;
    let beside = |text: &str, of: fn(&Means) -> f64| {
        let ratios = (1..4).map(|at| (NAMES[at], of(&found.regional.unclipped[at - 1]) / of(&vlfb)));
        Statement::new("VC1-T1", text, Rule::AtLeast).unit("times that of VLFB").paper([1.0]).found(model(), ratios)
    };
    vec![
        Statement::new("VC1-T1", "With virtual local frame buffers ter1k takes 33.4 ms.", WITHIN_1)
            .unit("ms")
            .paper([PRINTED[0].time])
            .found(model(), [vlfb.time]),
        Statement::new("VC1-T1", "With regions ter1k takes considerably longer.", WITHIN_10)
            .unit("ms")
            .paper(by_name(time, &PRINTED))
            .found(model(), by_name(time, &all))
            .because(REGIONS),
        Statement::new(
            "VC1-T1",
            "With virtual local frame buffers and with regions, a processing element waits for the others: ter1k.",
            WITHIN_10,
        )
        .unit("ms")
        .paper(NAMES.into_iter().zip(PRINTED.iter().map(waiting)))
        .found(model(), NAMES.into_iter().zip(all.iter().map(waiting)))
        .because(REGIONS),
        Statement::new(
            "VC1-T1",
            "The time increases from VLFB by 2x2 regions and by 4x4 with 4 buffers to 4x4 with 2.",
            Rule::Increases { with: "more regions and fewer buffers".to_owned() },
        )
        .unit("ms")
        .found(model(), [0, 1, 3, 2].map(|at| (NAMES[at], all[at].time))),
        Statement::new(
            "VC1-T1",
            "With more buffers there is less waiting: 4x4 regions.",
            Rule::Decreases { with: "the buffers".to_owned() },
        )
        .unit("ms")
        .found(model(), [("2 buffers", waiting(&four_with_2)), ("4 buffers", waiting(&four_with_4))]),
        beside(
            "The increase of synchronization is essential: with free clipping regions wait longer than VLFB.",
            waiting,
        ),
        beside("With free clipping regions still take longer than VLFB.", time),
    ]
}
