//! What is stated of values.

use super::*;
use tilewright_hdl::Bits;

impl Builder<'_> {
    pub fn states(&mut self, directive: Directive, clock: ClockId, condition: NodeId, message: &str) {
        self.build.assert(condition, message);
        let property = self.build.module.properties.last_mut().expect("there is one");
        (property.directive, property.clock) = (directive, clock);
    }

    /// A condition that always holds, in each lane of a value.
    pub fn always(&mut self, of: Pick) -> NodeId {
        let (of, how) = self.choose(of, Shape::Plain);
        let inverse = self.build.not(of);
        if how.is_multiple_of(2) {
            let both = self.build.or(of, inverse);
            return self.build.node(Op::Unary(Unary::AllOnes, both), 1, self.build.shape(of));
        }
        let both = self.build.and(of, inverse);
        self.compare(Relation::Le, false, both, of)
    }

    /// That a value is never this one, which may fail; or that it is at some time.
    pub fn compared(&mut self, directive: Directive, clock: ClockId, of: Pick, pattern: Pattern) {
        let of = self.any(of);
        let (width, shape) = (self.build.width(of), self.build.shape(of));
        let constant = self.build.node(Op::Const(pattern.bits(width)), width, shape);
        if directive == Directive::Cover {
            Feature::CoverInShapes.used();
            let condition = self.compare(Relation::Eq, false, of, constant);
            return self.states(directive, clock, condition, "this may happen");
        }
        // What is narrow meets it too soon.
        if width > 4 {
            let condition = self.compare(Relation::Ne, false, of, constant);
            self.states(directive, clock, condition, "this may fail");
        }
    }

    /// Two registers of a value, whatever they hold at first: the same from the first edge on.
    pub fn past(&mut self, number: usize, clock: ClockId, of: Pick) {
        Feature::PastInShapes.used();
        let of = self.any(of);
        let (width, shape) = (self.build.width(of), self.build.shape(of));
        let one = Bits::new(1, 1);
        let held = ["past", "held"].map(|what| {
            let name = self.name(&format!("{what}{number}"), Kind::Inner);
            let register = self.build.register(&name, width, shape, None);
            self.build.next(register, None, of);
            self.build.module.registers.last_mut().expect("there is one").clock = clock;
            register
        });
        let name = self.name(&format!("has{number}"), Kind::Inner);
        let has_past = self.build.register(&name, 1, shape, Some(Init::Same(Bits::zero(1))));
        let always = self.build.node(Op::Const(one), 1, shape);
        self.build.next(has_past, None, always);
        let made = self.build.module.registers.last_mut().expect("there is one");
        (made.clock, made.initial) = (clock, Some(Bits::zero(1)));
        let same = self.compare(Relation::Eq, false, held[0], held[1]);
        let no_past = self.build.not(has_past);
        let condition = self.build.or(no_past, same);
        self.states(Directive::Assert, clock, condition, "a value was what it was");
        self.values.push(held[0]);
    }
}
