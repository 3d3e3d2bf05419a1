use super::*;
use crate::run::Watch;
use crate::vc1::Machine;
use tilewright_scenes::{Scene, Size, project};

#[test]
fn a_frame_of_the_model_is_that_of_the_circuit() {
    let scene = Scene::builtin("star").unwrap();
    let size = Size::new(64, 48).unwrap();
    let view = project(&scene, size).unwrap();
    let config = Config { processors: 3, refresh: 5000.0, ..Config::new(size) };
    let model = Model::new(config).unwrap();
    let mut count = 0;
    let dealt = model.deal(&Arc::new(view.clone()), None).unwrap();
    let expected = model.observe([dealt], |event| {
        count += 1;
        if count > 20000 {
            panic!("{event:?}");
        }
    });
    let (_, report) = Machine::new(config).unwrap().render(&view, [0; 3], &mut Watch::default()).unwrap();
    assert_eq!(report.frames, expected.frames);
}

/// The banks may change in every clock of a window, its last one too, and not in the next one.
#[test]
fn a_window_ends_where_the_next_clock_is_closed() {
    let config = Config { processors: 1, refresh: 5000.0, ..Config::new(Size::new(16, 12).unwrap()) };
    let display = timing::Display::new(&config.hardware().unwrap());
    let mut clock = 0;
    for _ in 0..3 {
        let opens = display.open_from(clock);
        let closed = display.closed_from(opens);
        assert!(opens < closed && (opens..closed).all(|it| display.open_from(it) == it), "{opens} {closed}");
        assert!(display.open_from(closed) > closed);
        assert_eq!((display.closed_from(closed - 1), display.closed_from(closed)), (closed, closed));
        clock = closed;
    }
}
