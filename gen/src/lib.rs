//! Prints a circuit as Verilog with a self-checking testbench.
