#!/usr/bin/env bash
# Installs what the tests need where that is possible, then passes all tests.
set -euo pipefail
cd "$(dirname "$0")"

# Verilog simulators and linters, and the C++ compiler for the fastest of them. Without them the tests that need them say `skipped`;
# with CI set they fail.
missing=()
for tool in verilator iverilog yosys clang; do
    command -v "$tool" >/dev/null || missing+=("$tool")
done
if [ ${#missing[@]} -gt 0 ]; then
    if command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
        apt-get update -qq
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" g++ make >/dev/null
    else
        echo "not installed: ${missing[*]} (Debian: apt-get install ${missing[*]} g++ make)"
    fi
fi
if ! python3 -c 'import pyslang' 2>/dev/null; then
    if ! command -v pip3 >/dev/null && command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; then
        DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends python3 python3-pip >/dev/null
    fi
    python3 -m pip install -q pyslang 2>/dev/null || python3 -m pip install -q --break-system-packages pyslang ||
        echo "not installed: pyslang (pip install pyslang)"
fi

cargo test --workspace "$@"
