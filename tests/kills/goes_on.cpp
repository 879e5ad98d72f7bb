// SPDX-License-Identifier: BSD-3-Clause
// goes_on FOLDER STEPS: a little water on the processes of mpirun, from the newest checkpoint in the folder up to a number of
// steps, with a checkpoint every few; prints the state's hash. tests/kills/run.sh ends it again and again.
#include <cstdio>
#include <cstdlib>

#include "io/small_tank.hpp"
#include "spate/backend/mpi.hpp"
#include "spate/io/checkpoint.hpp"
#include "spate/io/history.hpp"
#include "spate/io/snapshots.hpp"

int main(int argc, char** argv)
{
    using namespace spate;
    if (argc != 3) return 2;
    const std::filesystem::path folder = argv[1];
    std::int64_t newest = -1;
    for (auto const& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        long long step = -1;
        if (std::sscanf(name.c_str(), "checkpoint_%lld", &step) == 1 && entry.path().extension() == ".h5")
            newest = std::max(newest, std::int64_t(step));
    }
    newest = MpiRanks().all(newest, agree::Most{}); // one may look while an old file goes
    auto scene = small_tank::scene(Mpi{Serial{}, 1, Balance{.every = 1}});
    io::History history(folder, 1 / 256.0);
    io::Snapshots snapshots(folder, "tank", 1 / 64.0);
    io::Checkpoints checkpoints(folder, {.steps = 5}, history, snapshots);
    if (newest >= 0) checkpoints.restart(scene, folder / ("checkpoint_" + std::to_string(newest) + ".h5"));
    if (MpiRanks().rank() == 0) std::puts("begun"), std::fflush(stdout);
    scene.run({.steps = std::atoll(argv[2]) - scene.steps(), .dt = 1 / 2048.0}, history, snapshots, checkpoints);
    const auto hash = scene.state_hash();
    if (MpiRanks().rank() == 0)
        std::printf("from %lld to %lld: %016llx\n", static_cast<long long>(newest),
                    static_cast<long long>(scene.steps()), static_cast<unsigned long long>(hash));
    MpiRanks().leave(0);
}
