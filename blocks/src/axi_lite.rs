//! Registers for a processor, behind AXI4-Lite.

use crate::encode::one_hot;
use crate::ports::state_that_it_stays;
use crate::slice::Slice;
use crate::streams::StreamBlocks;
use tilewright_hdl::{
    Module, Signal, any_of, below, bit, bits, block, bundle, case, codes, def, lit, mux, one_of, record,
};

codes! {
    /// The answer to an access, as AXI4 numbers it.
    ///
    /// ```
    /// use tilewright_blocks::AxiResponse;
    /// use tilewright_hdl::Codes;
    ///
    /// assert_eq!(AxiResponse::from_number(2), Some(AxiResponse::Slverr));
    /// ```
    pub enum AxiResponse {
        /// The access is done.
        Okay = 0,
        /// The slave refuses it.
        Slverr = 2,
        /// No slave has the address.
        Decerr = 3,
    }
}

record! {
    /// The payload of the channels AW and AR.
    ///
    /// ```
    /// # use tilewright_blocks::AxiLiteAddress;
    /// let second_word = AxiLiteAddress { addr: 4, prot: 0 };
    /// assert_eq!(AxiLiteAddress::widths(12).addr.bits(), 12);
    /// # assert_eq!(second_word.addr, 4);
    /// ```
    pub struct AxiLiteAddress(address: u32) {
        /// The address of a byte.
        addr: bits(address),
        /// The kind of access, which is ignored.
        prot: bits(3),
    }
}

bundle! {
    /// A write, from both of its channels.
    struct Write<T> {
        /// A bit for each register: the written one is high.
        chosen: T,
        data: T,
        /// The bits of the bytes that are written.
        bytes: T,
    }
}

block! {
    /// A slave of AXI4-Lite: registers that the master reads and writes, and words that the master only reads.
    ///
    /// ```text
    ///        .------.
    /// aw ===>| skid |==.  .------.              .-----------.
    ///        '------'  +=>| join |==> decode ==>| registers |==+==> registers
    /// w ====>| skid |=='  '------'      |       '-----------'  |
    ///        '------'                   '==>[ resp ]======> b  |
    ///        .------.                   .======================'
    /// ar ===>| skid |==> decode ==> select ==>[ data, resp ]======> r
    ///        '------'                   '== status
    /// ```
    ///
    /// The registers have the first addresses, a word each, and the words of `status` follow. An access to any other
    /// address changes nothing, and is answered by `SLVERR`. The same is true of a write to a word of `status`. The
    /// lowest bits of an address, which choose a byte of a word, are ignored: `strb` says which bytes are written.
    ///
    /// Latency 1 clock, an access of each kind a clock. All ports come from registers, so no path within a clock leads
    /// from one port to another. Reads and writes do not wait for each other. A read at the same edge as a write gives
    /// the old word.
    ///
    /// In Verilog the ports have the names of the standard, such as `s_axi_awvalid`, so that a packager infers the interface.
    ///
    /// ```
    /// # use tilewright_blocks::{AxiLiteAddress, AxiLiteData, AxiLiteRegisters};
    /// # use tilewright_sim::Simulation;
    /// let mut sim = Simulation::of(&AxiLiteRegisters { address: 4, width: 32, registers: 2, status: 1 })?;
    /// sim.reset();
    /// sim.set(sim.i.status[0], 0xcafe);
    /// let (aw, w, b, ar, r) = (sim.i.aw, sim.i.w, sim.o.b, sim.i.ar, sim.o.r);
    /// let t = sim.testbench();
    /// let at = |addr| AxiLiteAddress { addr, prot: 0 };
    /// let data = AxiLiteData { data: 0x1234_5678, strb: 0b0011 };
    /// let (.., written) = t.run((t.send(aw, at(4)), t.send(w, data), t.receive(b)));
    /// let (_, register) = t.run((t.send(ar, at(4)), t.receive(r)));
    /// let (_, status) = t.run((t.send(ar, at(8)), t.receive(r)));
    /// let (_, nothing) = t.run((t.send(ar, at(12)), t.receive(r)));
    /// assert_eq!((written.resp, register.data, status.data, nothing.resp), (0, 0x5678, 0xcafe, 2));
    /// # Ok::<(), tilewright_sim::Error>(())
    /// ```
    pub struct AxiLiteRegisters {
        /// The bits of an address.
        pub address: u32,
        /// The bits of a word.
        pub width: u32,
        /// The number of words that the master reads and writes.
        pub registers: u32,
        /// The number of words that the master only reads.
        pub status: u32,
    }
    ranges(self) {
        /// AXI4-Lite has words of 4 or of 8 bytes.
        width: any_of([32, 64]),
        registers: 1..=4096,
        status: ..=4096,
        /// Every word has an address.
        address: self.fewest_bits()..=64,
    }
    port_names { aw: "s_axi_aw", w: "s_axi_w", b: "s_axi_b", ar: "s_axi_ar", r: "s_axi_r" }
    latency = "1 clock";
    in(self) AxiLiteRegistersIn {
        /// Write addresses.
        aw: stream(AxiLiteAddress::widths(self.address)),
        /// Words to write.
        ///
        /// ```
        /// # use tilewright_blocks::AxiLiteData;
        /// let low_half = AxiLiteData { data: 0x1234, strb: 0b0011 };
        /// assert_eq!(low_half.strb, 3);
        /// ```
        w: stream(pub struct AxiLiteData {
            /// The word.
            data: bits(self.width),
            /// The bytes of the word that are written, one bit each.
            strb: bits(self.width / 8),
        }),
        /// Read addresses.
        ar: stream(AxiLiteAddress::widths(self.address)),
        /// The words that the master only reads.
        status: [bits(self.width); self.status],
    }
    out(self) AxiLiteRegistersOut {
        /// Answers to writes.
        ///
        /// ```
        /// # use tilewright_blocks::{AxiLiteAnswer, AxiResponse};
        /// # use tilewright_hdl::Codes;
        /// assert_eq!(AxiLiteAnswer { resp: AxiResponse::Okay.code() }.resp, 0);
        /// ```
        b: stream(pub struct AxiLiteAnswer {
            /// Whether the word was written.
            resp: one_of::<AxiResponse>(),
        }),
        /// Answers to reads.
        ///
        /// ```
        /// # use tilewright_blocks::AxiLiteWord;
        /// let refused = AxiLiteWord { data: 0, resp: 2 };
        /// # assert_eq!(refused.resp, 2);
        /// ```
        r: stream(pub struct AxiLiteWord {
            /// The word, or 0 if no word has the address.
            data: bits(self.width),
            /// Whether a word has the address.
            resp: one_of::<AxiResponse>(),
        }),
        /// The registers; 0 after a reset.
        registers: [bits(self.width); self.registers],
        /// A bit for each register: high in the first clock of a written value.
        written: bits(self.registers),
    }
}

impl AxiLiteRegisters {
    /// The bits of the shortest address that every word has.
    fn fewest_bits(&self) -> u32 {
        let bytes = u64::from(self.width / 8) * (u64::from(self.registers) + u64::from(self.status)).max(2);
        below(bytes).bits()
    }

    fn build(&self, m: Module, i: AxiLiteRegistersIn) -> AxiLiteRegistersOut {
        m.ignore(&[i.aw.prot, i.ar.prot]);
        let word_of = |address: Signal| address.slice(below(self.width / 8).bits()..self.address);
        let aw = m.slice("u_aw", Slice::Backward, i.aw.with(word_of(i.aw.addr)));
        let w = m.slice("u_w", Slice::Backward, i.w);
        let ar = m.slice("u_ar", Slice::Backward, i.ar.with(word_of(i.ar.addr)));
        let resp = |is_there: Signal| mux(is_there, AxiResponse::Okay, AxiResponse::Slverr);

        let writes = m.join(aw, w, |word, AxiLiteData { data, strb }| {
            def!(bytes = strb.unpack(self.width / 8).repeat(8).pack());
            Write { chosen: one_hot(word, self.registers), data, bytes }
        });
        def!(answers = m.reg(bit()).reset(0));
        def!(answer = m.reg(one_of::<AxiResponse>()));
        let (b, sent) = m.offer(answers, AxiLiteAnswer { resp: *answer });
        let write = writes.take_when(!answers | sent);
        answers.when(write.taken, 1).when(sent, 0);
        answer.when(write.taken, resp(write.chosen.any_one()));
        state_that_it_stays(m, &b.packed());
        def!(writing = write.chosen & write.taken.repeat(self.registers));
        let registers = (0..self.registers).map(|number| {
            let register = m.reg(&format!("register{number}"), self.width).reset(0);
            register.when(writing.bit(number), (write.data & write.bytes) | (register & !write.bytes));
            *register
        });
        let registers: Vec<Signal> = registers.collect();
        def!(written = m.reg(self.registers).reset(0));
        written.next(writing & write.bytes.any_one().repeat(self.registers));

        let words = registers.iter().chain(&i.status).copied();
        def!(is_there = one_hot(*ar, self.registers + self.status).any_one());
        def!(data = case(*ar, (0u64..).zip(words), lit(self.width, 0)));
        let r = m.slice("u_r", Slice::Forward, ar.with(AxiLiteWord { data, resp: resp(is_there) }));
        AxiLiteRegistersOut { b, r, registers, written: *written }
    }
}
