//! Blocks in one declaration: every form of it, and the result.

use std::marker::PhantomData;

use tilewright_hdl::*;

const FAST: Clock = Clock::new("fast", Period::ns(4));

bundle! {
    /// A pixel of the screen.
    struct Position<T> {
        /// Counted from the left.
        x: T,
        y: T,
    }
}

codes! {
    /// Which way.
    enum Way { Left, Right }
}

block! {
    /// Has no parameters.
    /// And a second line, of [`Position`].
    ///
    /// More of it, which no header shows.
    struct Plain;
}

impl Plain {
    fn build(&self, _: Module, (): ()) {}
}

block! {
    /// Uses every form of a port.
    #[derive(Copy)]
    pub(crate) struct Forms {
        /// How many.
        count: u32,
        screen: (u32, u32),
    }
    out(self) FormsOut {
        /// As wide as what drives it.
        sum: _,
        first: Position = _,
        all: [Position] = _,
        signal: bits(8),
        /// Goes through.
        passed: stream(8),
        area: struct Area { size: bits(20) },
        same: bit().of(row(self.count)),
    }
    source = "a book";
    in(self) FormsIn {
        /// Where it is.
        at: Position { x: below(self.screen.0), y: below(self.screen.1) }.on(FAST),
        other: Position = self.position(),
        /// Several.
        many: [bits(8); self.count],
        places: [Position = self.position(); 2],
        way: one_of::<Way>(),
        lanes: bit().of(row(self.count)),
        r#move: bit(),
        /// Declared where it stands.
        size: struct Size {
            /// From the left to the right.
            width: below(self.screen.0),
            height: below(self.screen.1),
        }.on(FAST),
        /// One after another.
        words: stream(8),
        visited: stream(Position { x: bits(3), y: bits(2) }).on(FAST),
    }
    latency(self) = format!("{} clocks, or so", self.count + 1);
}

impl Forms {
    fn position(&self) -> Position<Width> {
        Position { x: below(self.screen.0), y: below(self.screen.1) }.on(FAST)
    }

    fn build(&self, m: Module, i: FormsIn) -> FormsOut {
        m.ignore(&i.r#move);
        m.ignore(&i.at);
        let signal = i.many.iter().copied().reduce(|a, b| a ^ b).expect("there are some");
        let _ = i.visited.take_when(1);
        m.ignore(&i.visited.payload);
        m.ignore(&i.visited.valid);
        let Size { width, height } = i.size;
        let area = Area { size: width.times(height).zext(20) };
        FormsOut {
            sum: i.way.is(Way::Right),
            first: i.other,
            all: i.places,
            signal,
            passed: i.words,
            area,
            same: i.lanes,
        }
    }
}

block! {
    /// Uses every form of a stream.
    struct Streams {
        count: u32,
    }
    in(self) StreamsIn {
        /// Words.
        words: stream(bits(8)),
        fast: stream(up_to(self.count)).on(FAST),
        places: stream(Position { x: bits(3), y: bits(4) }).on(FAST),
        others: stream(Position = Position { x: bits(5), y: bits(6) }),
        many: [stream(bits(2)); self.count],
        /// What is asked for.
        asked: stream(struct Asked {
            /// Which one.
            number: up_to(self.count),
            again: bit(),
        }).on(FAST),
    }
    out StreamsOut {
        /// What was asked for.
        answers: stream(struct Answer { which: bits(3) }),
        sent: stream(bits(8)),
        sent_fast: stream(_),
        sent_places: stream(Position = _),
        sent_others: stream(Position { x: bits(5), y: bits(6) }),
        sent_many: [stream(_)],
    }
}

impl Streams {
    fn build(&self, _: Module, i: StreamsIn) -> StreamsOut {
        StreamsOut {
            answers: i.asked.with(Answer { which: cat![i.asked.number, i.asked.again] }),
            sent: i.words,
            sent_fast: i.fast,
            sent_places: i.places,
            sent_others: i.others,
            sent_many: i.many,
        }
    }
}

bundle! {
    /// What several blocks take and give.
    struct Both<T> {
        /// A place.
        place: Position<T>,
        words: Stream<T, T>,
    }
}

block! {
    /// Its ports are a bundle of others.
    struct Shared {
        width: u32,
    }
    in(self) = Both { place: Position { x: bits(3), y: bits(4) }, words: stream(bits(self.width)) };
    out = Renamed { at: Position { x: bits(3), y: bits(4) }, sent: stream(8) };
}

bundle! {
    struct Renamed<T> { at: Position<T>, sent: Stream<T, T> }
}

impl Shared {
    fn build(&self, _: Module, i: Both) -> Renamed {
        Renamed { at: i.place, sent: i.words }
    }
}

/// What a counter's value stands for.
trait Unit {
    const MOST: u64;
}

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Seconds;

#[derive(Debug, Clone, PartialEq, Eq, Hash)]
struct Hours;

impl Unit for Seconds {
    const MOST: u64 = 59;
}

impl Unit for Hours {
    const MOST: u64 = 23;
}

block! {
    /// Counts what its type says.
    struct Wheel<U: Unit> {
        of: PhantomData<U>,
        way: Way,
        first: u64,
    }
    ranges { first: ..=U::MOST }
    in WheelIn { turn: bit() }
    out WheelOut { at: up_to(U::MOST) }
}

impl<U: Unit> Wheel<U> {
    fn build(&self, m: Module, i: WheelIn) -> WheelOut {
        let at = m.reg("at", up_to(U::MOST)).reset(self.first);
        let next = match self.way {
            Way::Left => at - 1,
            Way::Right => at + 1,
        };
        at.when(i.turn, next);
        WheelOut { at: *at }
    }
}

#[test]
fn a_block_without_parameters_and_ports() {
    let design = elaborate(&Plain).unwrap();
    let about = &design.top().about;
    assert_eq!(about.summary, "Has no parameters. And a second line, of `Position`.");
    assert_eq!((about.latency.as_str(), about.source.as_str(), design.top().inputs.len()), ("", "", 0));
}

#[test]
fn every_form_of_a_port() {
    let forms = Forms { count: 3, screen: (640, 480) };
    let copy = forms;
    let design = elaborate(&copy).unwrap();
    let top = design.top();
    assert_eq!(top.name, "forms_count3_screen640_480");
    assert_eq!((top.about.latency.as_str(), top.about.source.as_str()), ("4 clocks, or so", "a book"));
    let names: Vec<_> = top.inputs.iter().map(|input| format!("{} {}", input.name, top.width(input.node))).collect();
    assert_eq!(
        names.join(", "),
        "at_x 10, at_y 9, other_x 10, other_y 9, many_0 8, many_1 8, many_2 8, places_0_x 10, places_0_y 9, \
         places_1_x 10, places_1_y 9, way 1, lanes 1, move 1, size_width 10, size_height 9, words_valid 1, words_payload 8, \
         visited_valid 1, visited_x 3, visited_y 2, passed_ready 1"
    );
    let said: Vec<_> = top.about.inputs.iter().map(|(path, said)| format!("{path}: {said}")).collect();
    assert_eq!(
        said,
        [
            "at: Where it is.",
            "at.x: Counted from the left.",
            "many: Several.",
            "other.x: Counted from the left.",
            "places.x: Counted from the left.",
            "size: Declared where it stands.",
            "size.width: From the left to the right.",
            "visited.x: Counted from the left.",
            "words: One after another."
        ]
    );
    assert_eq!(top.about.outputs["sum"], "As wide as what drives it.");
    let names: Vec<_> = top.outputs.iter().map(|output| output.name.as_str()).collect();
    assert!(
        names.ends_with(&[
            "signal",
            "passed_valid",
            "passed_payload",
            "area_size",
            "same",
            "words_ready",
            "visited_ready"
        ]),
        "{names:?}"
    );
}

#[test]
fn every_form_of_a_stream() {
    let design = elaborate(&Streams { count: 2 }).unwrap();
    let top = design.top();
    let ports = top
        .inputs
        .iter()
        .map(|port| (&port.name, port.node))
        .chain(top.outputs.iter().map(|port| (&port.name, port.node)));
    let names: Vec<_> = ports.map(|(name, node)| format!("{name} {}", top.width(node))).collect();
    assert_eq!(
        names.join(", "),
        "words_valid 1, words_payload 8, fast_valid 1, fast_payload 2, places_valid 1, places_x 3, places_y 4, \
         others_valid 1, others_x 5, others_y 6, many_0_valid 1, many_0_payload 2, many_1_valid 1, many_1_payload 2, \
         asked_valid 1, asked_number 2, asked_again 1, answers_ready 1, sent_ready 1, sent_fast_ready 1, sent_places_ready 1, sent_others_ready 1, sent_many_0_ready 1, \
         sent_many_1_ready 1, \
         answers_valid 1, answers_which 3, sent_valid 1, sent_payload 8, sent_fast_valid 1, sent_fast_payload 2, sent_places_valid 1, sent_places_x 3, \
         sent_places_y 4, sent_others_valid 1, sent_others_x 5, sent_others_y 6, sent_many_0_valid 1, \
         sent_many_0_payload 2, sent_many_1_valid 1, sent_many_1_payload 2, words_ready 1, fast_ready 1, places_ready 1, \
         others_ready 1, many_0_ready 1, many_1_ready 1, asked_ready 1"
    );
    let about = &top.about;
    assert_eq!(
        [&about.inputs["words"], &about.inputs["asked"], &about.inputs["asked.number"]],
        ["Words.", "What is asked for.", "Which one."]
    );
    assert_eq!(about.outputs["answers"], "What was asked for.");
}

#[test]
fn ports_that_several_blocks_share() {
    let design = elaborate(&Shared { width: 8 }).unwrap();
    let top = design.top();
    let names: Vec<_> = top.inputs.iter().map(|port| port.name.as_str()).collect();
    assert_eq!(names, ["place_x", "place_y", "words_valid", "words_payload", "sent_ready"]);
    assert_eq!(top.about.inputs["place"], "A place.");
    let problems = elaborate(&Shared { width: 9 }).unwrap_err().to_string();
    assert!(
        problems.starts_with("output `sent_payload` is declared with 8 bits, but `words_payload` has 9 bits"),
        "{problems}"
    );
}

#[test]
fn a_block_of_a_type() {
    block! {
        /// Two wheels, told apart by their types.
        struct Clockwork;
        in ClockworkIn { turn: bit() }
        out ClockworkOut { hours: bits(5), seconds: bits(6) }
    }
    impl Clockwork {
        fn build(&self, m: Module, ClockworkIn { turn }: ClockworkIn) -> ClockworkOut {
            let hours = Wheel::<Hours> { of: PhantomData, way: Way::Left, first: 0 };
            let seconds = Wheel::<Seconds> { of: PhantomData, way: Way::Left, first: 0 };
            ClockworkOut {
                hours: m.instance("u_hours", &hours, WheelIn { turn }).at,
                seconds: m.instance("u_seconds", &seconds, WheelIn { turn }).at,
            }
        }
    }
    let design = elaborate(&Clockwork).unwrap();
    let names: Vec<_> = design.modules().iter().map(|module| module.name.as_str()).collect();
    assert_eq!(names, ["wheel_hours_way_left_first0", "wheel_seconds_way_left_first0", "clockwork"]);
    let wheel = |first| Wheel::<Hours> { of: PhantomData, way: Way::Left, first }.checked();
    assert!(wheel(23).is_ok());
    assert_eq!(wheel(24).unwrap_err().to_string(), "`first` of `Wheel` is 24: it has to be at most 23");
}
