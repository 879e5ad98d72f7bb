// SPDX-License-Identifier: BSD-3-Clause
// Prints the state hash of some scenes: what two compilers make of the same source must be the same text.
#include "../simulation/scenes.hpp"

#include <cinttypes>
#include <cstdio>

int main()
{
    using namespace scenes;
    auto print = [](const char* name, Outcome const& o) {
        std::printf("%-24s %016" PRIx64 " after %" PRId64 " rebuilds\n", name, o.hash, o.rebuilds);
    };
    print("dam_break adami", dam_break(RungeKutta2{}, Adami{}, Threads{2}));
    print("dam_break continuity", dam_break(Leapfrog{}, ByContinuity{}, Threads{2}));
    print("dam_break float", dam_break<Float>(RungeKutta2{}, Adami{}, Threads{2}));
    print("vortices", vortices(Threads{2}));
    print("discs", discs(Threads{2}));
}
