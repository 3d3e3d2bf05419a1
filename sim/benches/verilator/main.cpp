// Runs a model for so many cycles. Prints its checksum, the seconds to the end of the first cycle, and those of the others.
//
// Each clock rises at the multiples of its period, and a cycle is a time at which one or more clocks rise. Before the first one,
// until every clock has risen RESET_CYCLES times, the resets are high.

#include "Vmodel.h"
#include "verilated.h"

#include "ports.h" // CLOCKS has CLOCK(port, period) of each clock, RESETS has RESET(port) of each reset; RESET_CYCLES

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace {

struct Clock {
    CData* level;
    std::uint64_t period;
    std::uint64_t next;
    std::uint64_t rises;
};

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <std::size_t N>
void cycle(Vmodel& model, Clock (&clocks)[N]) {
    std::uint64_t now = clocks[0].next;
    for (const Clock& clock : clocks) now = clock.next < now ? clock.next : now;
    for (Clock& clock : clocks) {
        if (clock.next != now) continue;
        *clock.level = 1;
        clock.next += clock.period;
        clock.rises++;
    }
    model.eval();
    for (Clock& clock : clocks) *clock.level = 0;
    model.eval();
}

template <std::size_t N>
bool in_reset(const Clock (&clocks)[N]) {
    for (const Clock& clock : clocks) {
        if (clock.rises < RESET_CYCLES) return true;
    }
    return false;
}

}  // namespace

int main(int, char** arguments) {
    const std::uint64_t cycles = std::strtoull(arguments[1], nullptr, 10);

    const double started = seconds();
    VerilatedContext context;
    const auto model = std::make_unique<Vmodel>(&context);
#define CLOCK(port, period) {&model->port, period, period, 0},
    Clock clocks[] = {CLOCKS};
#define RESET(port) model->port = level;
    const auto reset = [&](CData level) { RESETS };
    reset(1);
    while (in_reset(clocks)) cycle(*model, clocks);
    reset(0);
    cycle(*model, clocks);

    const double ready = seconds();
    for (std::uint64_t done = 1; done < cycles; done++) cycle(*model, clocks);
    const double ended = seconds();
    std::printf("%08x %.9f %.9f\n", model->csum, ready - started, ended - ready);
    return 0;
}
