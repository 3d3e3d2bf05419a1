//! Chapter 4: codes whose numbers a protocol gives.

use tilewright_hdl::*;

codes! {
    /// What an AXI4-Lite slave answers.
    pub enum Response {
        /// The access is done.
        Okay = 0,
        /// The slave refuses it.
        Slverr = 2,
    }
}

bundle! {
    /// The answer to a read.
    pub struct Answer<T> {
        /// Whether it is done.
        pub response: T,
        /// The word.
        pub word: T,
    }
}

block! {
    /// Answers with a word at address 0 and refuses all other addresses.
    pub struct Slave;
    in SlaveIn {
        /// The address of a read.
        address: bits(4),
        /// The word at address 0.
        word: bits(8),
    }
    out SlaveOut {
        /// The answer.
        answer: Answer { response: one_of::<Response>(), word: bits(8) },
    }
}

impl Slave {
    fn build(&self, _: Module, i: SlaveIn) -> SlaveOut {
        let done = Answer { response: Response::Okay.into(), word: i.word };
        let refused = Answer { response: Response::Slverr.into(), word: lit(8, 0) };
        SlaveOut { answer: mux(i.address.eq(0), done, refused) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tilewright_sim::Simulation;

    #[test]
    fn it_refuses_all_but_one_address() -> Result<(), tilewright_sim::Error> {
        let mut sim = Simulation::of(&Slave)?;
        sim.drive(SlaveIn { address: 0, word: 7 });
        assert_eq!(sim.code::<Response>("answer_response")?, Response::Okay);
        sim.drive(SlaveIn { address: 4, word: 7 });
        assert_eq!(sim.code::<Response>("answer_response")?, Response::Slverr);
        assert_eq!(sim.get(sim.o.answer.response), 2); // as a number
        Ok(())
    }
}
