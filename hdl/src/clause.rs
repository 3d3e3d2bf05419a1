//! The message for what is no clause of `block!`.

/// Never implemented: names what stands where a clause of [`block!`](crate::block!) is expected.
#[doc(hidden)]
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no clause of a block",
    label = "a clause is expected here",
    note = "the clauses are `ranges {{ .. }}`, `name = ..;`, `foreign = ..;`, `port_names {{ .. }}`, `latency = ..;`, `source = ..;`, `in Name {{ .. }}` and `out Name {{ .. }}`, each at most once; one whose expressions use `self` has `(self)` after its first word"
)]
pub trait ClauseOfABlock {}

/// Fails to compile at the word that is no clause. A value of that name makes rustc point at the word.
#[doc(hidden)]
#[macro_export]
macro_rules! no_clause {
    (ranges ranges) => { compile_error!("a block has one clause `ranges`, as in `ranges { depth: 2..=8, side: powers_of_two(2..=256) }`"); };
    (name name) => { compile_error!("a block has one clause `name`, as in `name = \"uart\";`"); };
    (foreign foreign) => { compile_error!("a block has one clause `foreign`, as in `foreign = Foreign::module(\"EHXPLLL\").capitals();`"); };
    (port_names port_names) => { compile_error!("a block has one clause `port_names`, as in `port_names { beats: \"s_axis_t\" }`"); };
    (latency latency) => { compile_error!("a block has one clause `latency`, as in `latency = \"2 clocks\";`"); };
    (source source) => { compile_error!("a block has one clause `source`, as in `source = \"section 3\";`"); };
    (in in) => { compile_error!("a block has one clause `in`, as in `in AdderIn { a: bits(8) }` or `in(self) AdderIn { a: bits(self.width) }`"); };
    (out out) => { compile_error!("a block has one clause `out`, as in `out AdderOut { sum: bits(8) }` or `out(self) AdderOut { sum: bits(self.width) }`"); };
    // As an identifier the word would have the place of this macro, so that it is repeated as a token.
    ($is_a_word:ident $word:tt) => {
        const _: () = {
            #[allow(non_camel_case_types, dead_code)]
            struct $word;
            const fn is_a<C: $crate::ClauseOfABlock>(_: C) {}
            is_a($word);
        };
    };
    ($($other:tt)*) => {
        compile_error!("the clauses of a block are `ranges { .. }`, `name = ..;`, `foreign = ..;`, `port_names { .. }`, `latency = ..;`, `source = ..;`, `in Name { .. }` and `out Name { .. }`");
    };
}
