//! Appendix D: the traits that signatures name, and what has them.

#[cfg(test)]
mod tests {
    use crate::uart::queue::Received;
    use crate::uart::transmitter::Phase;
    use tilewright_hdl::*;
    use tilewright_sim::IntoValue;

    fn operand(_: impl Operand) {}
    fn signal(_: impl IntoSignal) {}
    fn amount(_: impl ShiftAmount) {}
    fn integer(_: impl Integer) {}
    fn width(_: impl IntoWidth) {}
    fn shape(_: impl IntoShape) {}
    fn layout(_: impl Layout) {}
    fn data(_: impl Data) {}
    fn bundle(_: impl Bundle) {}
    fn by_name<R: Record>(_: R) {}
    fn lanes(_: impl Lanes) {}
    fn fits<V: Data>(_: &V, _: impl Fits<V>) {}
    fn fields<T: Leaf>(_: impl Fields<T>) {}
    fn codes(_: impl Codes) {}
    fn block(_: impl Block) {}
    fn value(_: impl IntoValue) {}

    #[test]
    fn what_has_which_trait() {
        tilewright_sim::example(|m| {
            let one = lit(8, 1);
            let record = Received { data: one, broken: lit(1, 0) };
            def!(count = m.reg(8).reset(0));
            count.next(*count);
            def!(net = m.wire(8));
            net.drive(one);
            def!(phase = m.fsm(Phase::Idle));
            phase.next(|_| hold());
            def!(held = m.reg(Received::widths()).reset(0));
            held.next(record);

            signal(one);
            signal(count);
            signal(net);

            operand(one);
            operand(count);
            operand(5);
            operand(true);
            operand(Bits::new(8, 5));
            operand(hex(0x3f));
            operand(one.low());
            operand(Phase::Idle);
            operand(phase);

            amount(3);
            amount(one);

            integer(3u8);
            integer(3usize);
            integer(true);

            width(8);
            width(bits(8));
            width(below(12));

            shape(4);
            shape(row(4));
            shape(grid(3, 4));

            layout(8);
            layout(below(12));
            layout(Received::widths());

            bundle(record);
            by_name(record);
            lanes(stack([record, record]));
            data(one);
            data(record);
            data(vec![one, one]);
            data([record, record]);

            fits(&one, 5);
            fits(&one, count);
            fits(&record, record);
            fits(&record, held);
            fits(&record, Received { data: 5, broken: 0 });
            fits(&record, 0);

            fields::<Signal>(record);
            fields::<u64>(Received { data: 5, broken: 0 });
            fields::<Width>(Received::widths());

            codes(Phase::Stop);
            block(crate::counter::Counter { limit: 3 });
            value(-5);
            value(true);
            value(Bits::new(100, 5));
            m.assert(one.eq(1), "what compiles runs");
        });
    }
}
