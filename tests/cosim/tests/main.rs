//! The simulator and other simulators on the printed Verilog.

mod blocks;
mod border;
mod campaign;
mod causes;
mod edges;
mod fst;
mod matrix;
mod pitfalls;
mod recordings;
mod shown;
mod strips;
mod waveforms;
