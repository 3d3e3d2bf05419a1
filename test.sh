#!/usr/bin/env bash
# Installs what the tests need where that is possible, then passes all tests.
set -euo pipefail
cd "$(dirname "$0")"

# Each program with the Debian package that has it: Verilog simulators and linters, what they call in turn (Verilator a C++ compiler and
# make, Yosys vcd2fst to read a VCD), the C++ compiler for the fastest models, and a browser to look at reports with. Without one the tests
# that need it say `skipped` and its name; with CI set they fail.
tools=(verilator:verilator iverilog:iverilog yosys:yosys clang:clang g++:g++ make:make vcd2fst:gtkwave python3:python3 pip3:python3-pip
    chromium:chromium)
as_root_on_debian() { command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; }

missing=() packages=()
for tool in "${tools[@]}"; do
    command -v "${tool%%:*}" >/dev/null || { missing+=("${tool%%:*}") packages+=("${tool##*:}"); }
done
if [ ${#missing[@]} -gt 0 ]; then
    if as_root_on_debian; then
        apt-get update -qq
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${packages[@]}" >/dev/null
    else
        echo "not installed: ${missing[*]} (Debian: apt-get install ${packages[*]})"
    fi
fi
if ! python3 -c 'import pyslang' 2>/dev/null; then
    python3 -m pip install -q pyslang 2>/dev/null || python3 -m pip install -q --break-system-packages pyslang ||
        echo "not installed: pyslang (pip install pyslang)"
fi

# All is built once here: without what makes the next build quicker, and without line numbers in backtraces.
export CARGO_INCREMENTAL="${CARGO_INCREMENTAL:-0}" CARGO_PROFILE_DEV_DEBUG="${CARGO_PROFILE_DEV_DEBUG:-0}"
cargo test --workspace "$@"
