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
