// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun: processes write a file together, at once if HDF5 knows MPI, and none of them holds what all have.
#include "io/shared_rows.hpp"
#include "mpi/going_on.hpp"
#include "spate/io/checkpoint.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

#include <malloc.h>

namespace {

std::atomic<std::size_t> allocated{0}, most_allocated{0}; ///< by new  [bytes]

void* counted(std::size_t size)
{
    void* const at = std::malloc(size == 0 ? 1 : size);
    if (at == nullptr) throw std::bad_alloc();
    const std::size_t now = allocated += malloc_usable_size(at);
    std::size_t most = most_allocated;
    while (most < now && !most_allocated.compare_exchange_weak(most, now)) {}
    return at;
}
void forget(void* at)
{
    if (at != nullptr) allocated -= malloc_usable_size(at);
    std::free(at);
}

} // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* at) noexcept { forget(at); }
void operator delete[](void* at) noexcept { forget(at); }
void operator delete(void* at, std::size_t) noexcept { forget(at); }
void operator delete[](void* at, std::size_t) noexcept { forget(at); }

namespace {

using namespace spate;
using going_on::End, going_on::Processes;

/// A folder that all processes see, gone after the test.
class SharedFiles : public testing::Test {
protected:
    void SetUp() override
    {
        const int job = ranks.all(ranks.rank() == 0 ? int(::getpid()) : 0, agree::Most{});
        folder = std::filesystem::temp_directory_path() / ("spate_shared_files_" + std::to_string(job));
        by_one(ranks, [&] { std::filesystem::create_directories(folder); });
    }
    void TearDown() override
    {
        by_one(ranks, [&] { std::filesystem::remove_all(folder); });
    }
    /// A run on all processes, and what is left of it from its checkpoint on these and on one, are the run of one.
    template <class Case>
    void expect_to_go_on(std::int64_t cut) const
    {
        const auto file = folder / "checkpoint.h5";
        const End whole = going_on::run<Case>(Serial{}, Case::steps);
        const End half = going_on::run<Case>(Serial{}, cut);
        const End here =
            going_on::run<Case>(Processes{Threads{1}, 2, Balance{.every = 1}}, cut, nullptr,
                                [&](auto& any) { io::write_checkpoint(any, file, io::detail::part_of(any)); });
        going_on::expect_the_same(here, half, "before");
        const io::State state = io::read_checkpoint(file);
        EXPECT_THAT(going_on::differences(state, half.state), testing::IsEmpty());
        going_on::expect_the_same(going_on::run<Case>(Processes{Threads{1}, 1}, Case::steps - cut, &state), whole,
                                  "on all");
        if (ranks.rank() == 0)
            going_on::expect_the_same(going_on::run<Case>(Serial{}, Case::steps - cut, &state), whole, "on one");
    }

    const MpiRanks ranks;
    std::filesystem::path folder;
};

TEST_F(SharedFiles, AreThoseOfOneProcess) { shared_rows::expect_files_of_one(ranks, folder); }
TEST_F(SharedFiles, EndAllProcessesWithAnErrorIfTheyCannotBeWritten)
{
    shared_rows::expect_errors_of_all(ranks, folder);
}
TEST_F(SharedFiles, GoOnWithTheBitsOfOneProcess)
{
    expect_to_go_on<going_on::Column>(411);
    expect_to_go_on<going_on::Hopper>(1236);
}
// Beside its part a process needs room for its stretch, of like size, and for its keys and the one table that is on its way
// (its copy in order, as messages and as they arrive: less than a part); and for a block of the file.
TEST_F(SharedFiles, NeedRoomForThePartOfAProcessOnly)
{
    constexpr std::size_t n = 400'000;
    io::State mine = shared_rows::part(shared_rows::state(n), ranks.rank(), ranks.count(), shared_rows::Whose::even);
    std::uint64_t bytes = 0;
    for (auto const& [name, table] : mine.tables)
        bytes += table.size() * std::visit([]<class T>(std::vector<T> const&) { return sizeof(T); }, table.values);
    const auto all = ranks.all(bytes, agree::Sum{}), largest = ranks.all(bytes, agree::Most{});
    const std::size_t before = allocated;
    most_allocated = before;
    io::write_checkpoint(io::TheseRanks(ranks), folder / "large.h5", std::move(mine));
    const std::size_t more = most_allocated - before;
    EXPECT_LT(more, 2 * largest + (std::size_t{2} << 20));
    const auto most = ranks.all(more, agree::Most{});
    if (ranks.rank() == 0)
        std::printf("%d processes: a state of %.1f MB, at most %.1f MB on one, which needed %.1f MB more to write it\n",
                    ranks.count(), 1e-6 * double(all), 1e-6 * double(largest), 1e-6 * double(most));
}

} // namespace
