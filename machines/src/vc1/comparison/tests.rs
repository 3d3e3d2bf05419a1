use super::*;
use crate::Follower;
use crate::run::Watch;
use crate::vc1::{Clocks, Config, Machine, Report};
use tilewright_scenes::{Projection, Scene, Size, project};

/// Two frames of three processing elements that overflow and send polygons to all.
fn config() -> (Config, Projection) {
    let size = Size::new(64, 48).unwrap();
    let view = project(&Scene::builtin("star").unwrap(), size).unwrap();
    (Config { processors: 3, pages: Some(30), apr: Some(40), refresh: 6000.0, ..Config::new(size) }, view)
}

/// Draws with the circuit, of which events are noted as that function makes them.
fn drawn(falsify: impl Fn(Event) -> Option<Event> + 'static) -> Result<Report, Error> {
    let (config, view) = config();
    let mut machine = Machine::new(config).unwrap();
    machine.falsify(falsify);
    let mut views = [view.clone(), view].into_iter();
    machine.render_frames([0; 3], &mut Watch::default(), || views.next(), |_| true)
}

/// The model beside itself, with events and frames that those functions change.
fn beside_itself(falsify: impl Fn(Event) -> Option<Event>, change: impl Fn(&mut FrameReport)) -> Result<(), Error> {
    let (config, view) = config();
    let model = Model::new(config).unwrap();
    let dealt = model.deal(&Arc::new(view), None).unwrap();
    let mut events = Vec::new();
    let report = model.observe([dealt.clone()], |event| events.extend(falsify(event)));
    let mut comparison = Comparison::new(&model);
    comparison.command(dealt.view());
    comparison.see(events);
    report.frames.into_iter().for_each(|mut frame| {
        change(&mut frame);
        comparison.show(frame);
    });
    comparison.compare(u64::MAX)
}

fn falsified(falsify: impl Fn(Event) -> Option<Event>) -> Result<(), Error> {
    beside_itself(falsify, |_| {})
}

fn differing<T: std::fmt::Debug>(drawn: Result<T, Error>) -> (String, &'static str, [u64; 2]) {
    match drawn {
        Err(Error::Differs { unit, signal, seen, expected, .. }) => (unit, signal, [seen, expected]),
        other => panic!("{other:?}"),
    }
}

const KINDS: [What; 11] = [
    What::Draws(0),
    What::Clears(0),
    What::Receives(0),
    What::Ends,
    What::Due,
    What::Overflows,
    What::Swaps,
    What::Resumes,
    What::Carries(0, 0),
    What::Restarts,
    What::Shows(0),
];

/// The circuit's, and one that comes a clock later.
#[test]
fn events_of_the_circuit_are_compared() {
    let report = drawn(Some).expect("nothing differs");
    assert!(report.compared > 10_000, "{}", report.compared);
    let late = |event: Event| Some(Event { clock: event.clock + u64::from(event.what == What::Overflows), ..event });
    let (unit, signal, values) = differing(drawn(late));
    assert!(unit.starts_with("processing element "), "{unit}");
    assert_eq!((signal, values), ("the number of overflows", [0, 1]));
}

/// Of each kind, one that comes a clock later, and one that never comes.
#[test]
fn an_event_of_any_kind_that_differs_is_found() {
    falsified(Some).expect("nothing differs");
    for what in KINDS {
        let is_it = move |event: Event| event.what.kind() == what.kind();
        let late = move |event: Event| Some(Event { clock: event.clock + u64::from(is_it(event)), ..event });
        let (_, signal, values) = differing(falsified(late));
        assert_eq!((signal, values), (what.kind(), [0, 1]));
        let (unit, signal, values) = differing(falsified(move |event| Some(event).filter(|it| !is_it(*it))));
        assert_eq!((signal, values), (what.kind(), [0, 1]));
        let place = match what {
            What::Carries(..) => "the bus",
            What::Restarts | What::Shows(_) => "the merger",
            _ => "processing element ",
        };
        assert!(unit.starts_with(place), "{unit}");
    }
}

/// Another pixel, entry, word, sender or number.
#[test]
fn what_an_event_says_is_compared() {
    let another = |event: Event| {
        let what = match event.what {
            What::Draws(it) => What::Draws(it + 1),
            What::Clears(it) => What::Clears(it + 1),
            What::Receives(it) => What::Receives(it ^ 1),
            What::Carries(sender, word) => What::Carries(sender + 1, word),
            What::Shows(it) => What::Shows(it + 1),
            other => other,
        };
        Event { what, ..event }
    };
    for what in KINDS.into_iter().filter(|what| what.value_name() != what.kind()) {
        let falsify = move |event: Event| Some(if event.what.kind() == what.kind() { another(event) } else { event });
        let (_, signal, [seen, expected]) = differing(falsified(falsify));
        assert_eq!(signal, what.value_name());
        assert_ne!(seen, expected);
    }
}

/// An event more than the model has.
#[test]
fn an_event_that_does_not_happen_is_found() {
    let more = |event: Event| match event.what {
        What::Overflows => Some(Event { what: What::Ends, ..event }),
        _ => Some(event),
    };
    let (unit, signal, values) = differing(falsified(more));
    assert!(unit.starts_with("processing element "), "{unit}");
    assert_eq!((signal, values), ("the number of overflows", [0, 1]));
}

#[test]
fn every_number_of_a_frame_is_compared() {
    let signal = |change: &dyn Fn(&mut FrameReport)| match beside_itself(Some, change) {
        Err(Error::Differs { signal, .. }) => signal,
        other => panic!("{other:?}"),
    };
    let frame: [&dyn Fn(&mut FrameReport); 9] = [
        &|it| it.packets += 1,
        &|it| it.words += 1,
        &|it| it.times.command += 1,
        &|it| it.times.drawn = None,
        &|it| it.times.swapped = None,
        &|it| it.times.merged = None,
        &|it| it.times.shown = None,
        &|it| it.times.averaged = Some(1),
        &|it| it.refreshes += 1,
    ];
    assert_eq!(frame.map(signal), FRAME.map(|(name, _)| name));
    let processor: [&dyn Fn(&mut FrameReport); 6] = [
        &|it| it.processors[2].polygons += 1,
        &|it| it.processors[2].expected += 1,
        &|it| it.processors[2].pixels += 1,
        &|it| it.processors[2].pages += 1,
        &|it| it.processors[2].overflows += 1,
        &|it| it.processors[2].broadcast += 1,
    ];
    assert_eq!(processor.map(signal), PROCESSOR.map(|(name, _)| name));
    let classes: [fn(&mut Clocks) -> &mut u64; 10] = [
        |it| &mut it.clearing,
        |it| &mut it.geometry,
        |it| &mut it.rasterization,
        |it| &mut it.sending,
        |it| &mut it.receiving,
        |it| &mut it.stalled,
        |it| &mut it.bus,
        |it| &mut it.overflow,
        |it| &mut it.sync,
        |it| &mut it.swap,
    ];
    assert_eq!(classes.map(|class| signal(&|it| *class(&mut it.processors[1].clocks) += 1)), CLOCKS);
}

#[test]
fn a_refresh_that_comes_at_another_time_is_found() {
    let (config, _) = config();
    let model = Model::new(config).unwrap();
    let mut comparison = Comparison::new(&model);
    let (dawn, pixel) = comparison.model.refresh_from(10_000);
    comparison.refresh(dawn, pixel).expect("nothing differs");
    assert!(matches!(comparison.refresh(dawn, pixel + 1), Err(Error::Differs { .. })));
    assert!(matches!(comparison.refresh(dawn - 1, pixel), Err(Error::Differs { .. })));
    let (next, _) = comparison.model.refresh_from(dawn + 1);
    let refresh = 1e12 / config.refresh / Event::PE_PERIOD as f64;
    assert!(((next - dawn) as f64 - refresh).abs() < 2.0, "{dawn} {next}");
}

/// A machine that follows a pixel runs to its end, and has the difference as its error and in the way.
#[test]
fn a_difference_is_not_lost_where_a_pixel_is_followed() {
    for (late, block, clock) in [(What::Restarts, "gfb-sequencer", "merge"), (What::Swaps, "lfb-swap", "pe")] {
        let (config, view) = config();
        let follower = Follower::new([32, 24]);
        let mut machine = Machine::new(config).unwrap().following(&follower);
        machine.falsify(move |event| Some(Event { clock: event.clock + u64::from(event.what == late), ..event }));
        let mut views = [view.clone(), view].into_iter();
        let rendered = machine.render_frames([0; 3], &mut Watch::default(), || views.next(), |_| true);
        assert!(matches!(rendered, Err(Error::Differs { .. })), "{rendered:?}");
        let way = follower.take().unwrap();
        let first = way.first_difference().unwrap();
        assert_eq!((first.block, first.clock.as_str()), (block, clock));
    }
}
