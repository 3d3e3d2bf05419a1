//! Registers and wires of records.

use tilewright_hdl::*;
use tilewright_sim::Simulation;

bundle! {
    /// A record, a list and an array in a record.
    struct Sprite<T> { visible: T, at: Point<T>, palette: Vec<T>, corners: [Point<T>; 2] }
    struct SpriteIn<T> { clear: T, load: T, hide: T, sprite: Sprite<T> }
    struct SpriteOut<T> { held: Sprite<T>, delayed: Sprite<T> }
}

/// Stores a sprite; a reset sets it to a record of numbers.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Holder;

const RESET: fn() -> Sprite<u64> = || Sprite {
    visible: 1,
    at: Point { x: 17, y: 0 },
    palette: vec![3, 1, 2],
    corners: [Point { x: 255, y: 1 }, Point { x: 0, y: 2 }],
};

fn sprite() -> Sprite<Width> {
    let point = Point { x: bits(8), y: bits(2) };
    Sprite { visible: bit(), at: point, palette: vec![below(5); 3], corners: [point; 2] }
}

impl Block for Holder {
    type In = SpriteIn;
    type Out = SpriteOut;

    fn inputs(&self) -> SpriteIn<Width> {
        SpriteIn { clear: bit(), load: bit(), hide: bit(), sprite: sprite() }
    }

    fn build(&self, m: Module, i: SpriteIn) -> SpriteOut {
        let next = m.wire("next_sprite", sprite());
        let held = m.reg("holder", sprite()).reset(RESET());
        held.when(i.clear, 0).when(i.load | i.hide, next.clone());
        next.drive(mux(i.hide, Sprite { visible: !held.visible, ..(*held).clone() }, i.sprite));
        let delayed = m.reg("later", sprite()).enable(!i.clear);
        delayed.next(held.clone());
        SpriteOut { held: (*held).clone(), delayed: (*delayed).clone() }
    }
}

#[test]
fn a_register_of_a_record_is_a_register_a_field() {
    let design = elaborate(&Holder).unwrap();
    let module = design.top();
    let names: Vec<_> = module.registers.iter().map(|register| module.register_name(register)).collect();
    let fields = [
        "visible",
        "at_x",
        "at_y",
        "palette_0",
        "palette_1",
        "palette_2",
        "corners_0_x",
        "corners_0_y",
        "corners_1_x",
        "corners_1_y",
    ];
    let held = fields.map(|field| format!("holder_{field}"));
    let later = fields.map(|field| format!("later_{field}"));
    assert_eq!(names, [held, later].concat());
}

#[test]
fn it_is_reset_enabled_and_updated_as_one() {
    let mut sim = Simulation::of(&Holder).unwrap();
    sim.reset();
    let drive = |clear, load, hide, sprite: &Sprite<u64>| SpriteIn { clear, load, hide, sprite: sprite.clone() };
    let other = Sprite { visible: 1, at: Point { x: 4, y: 3 }, palette: vec![4, 0, 1], ..RESET() };
    assert_eq!(sim.read_u64().held, RESET());
    sim.drive(drive(0, 1, 0, &other));
    sim.step();
    assert_eq!((sim.read_u64().held, sim.read_u64().delayed), (other.clone(), RESET()));
    sim.drive(drive(0, 0, 1, &RESET()));
    sim.step();
    let hidden = Sprite { visible: 0, ..other.clone() };
    assert_eq!((sim.read_u64().held, sim.read_u64().delayed), (hidden.clone(), other.clone()));
    sim.drive(drive(1, 1, 1, &RESET()));
    sim.step();
    let zero = hidden.map(|_| 0);
    assert_eq!((sim.read_u64().held, sim.read_u64().delayed), (zero, other));
}

block! {
    /// A chain of conditions with an end.
    struct Turn;
    in TurnIn { first: bit(), second: bit(), third: bit() }
    out Point { x: _, y: _ }
}

impl Turn {
    fn build(&self, m: Module, i: TurnIn) -> Point {
        let at = m.reg("at", Point { x: 8, y: 2 }).reset(0);
        at.when(i.first, Point { x: 7, y: 3 })
            .when(i.second, Point { x: at.x + 1, y: at.y - 1 })
            .when(i.third, Point { x: lit(8, 9), ..*at })
            .otherwise(0);
        *at
    }
}

#[test]
fn the_first_condition_that_holds_wins() {
    let mut sim = Simulation::of(&Turn).unwrap();
    sim.reset();
    let mut step = |first, second, third| {
        sim.drive(TurnIn { first, second, third });
        sim.step();
        let Point { x, y } = sim.read_u64();
        (x, y)
    };
    assert_eq!(step(1, 1, 1), (7, 3));
    assert_eq!(step(0, 1, 1), (8, 2));
    assert_eq!(step(0, 0, 1), (9, 2));
    assert_eq!(step(0, 0, 0), (0, 0));
}
