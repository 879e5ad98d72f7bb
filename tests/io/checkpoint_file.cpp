// SPDX-License-Identifier: BSD-3-Clause
// A checkpoint is whole, or it is refused with one sentence and nothing has changed.
#include "spate/io/checkpoint_file.hpp"

#include "fuzz/stranger.hpp"
#include "io/small_tank.hpp"
#include "spate/io/checkpoint.hpp"

#include <gmock/gmock.h>

namespace {

using namespace spate;
using testing::HasSubstr;

/// splitmix64: the same numbers everywhere.
struct Dice {
    std::uint64_t seed;
    std::uint64_t operator()(std::uint64_t below)
    {
        std::uint64_t z = seed += 0x9E3779B97F4A7C15u;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return (z ^ (z >> 31)) % below;
    }
};

class CheckpointFileTest : public small_tank::InFolder {
protected:
    using Bytes = std::vector<std::byte>;
    void SetUp() override
    {
        InFolder::SetUp();
        tank.run({.steps = 40});
        state = io::state_of(tank);
        io::write_checkpoint(file(), state);
        const std::string text = content(file());
        bytes.resize(text.size());
        std::memcpy(bytes.data(), text.data(), text.size());
    }
    std::filesystem::path file() const { return folder / "checkpoint_40.h5"; }
    /// What is said of the bytes, empty if they are taken.
    static std::string said_of(Bytes const& content)
    {
        try {
            (void)io::checkpoint_in(content, "c.h5");
            return {};
        }
        catch (BadInput const& e) {
            return e.what();
        }
    }
    /// What a scene says of a state; it must stay as it was if it says something.
    template <class Scene>
    static std::string said_by(Scene&& scene, io::State const& s)
    {
        const auto before = io::state_of(scene);
        try {
            io::resume(scene, s);
            return {};
        }
        catch (BadInput const& e) {
            const auto after = io::state_of(scene);
            EXPECT_EQ(before.tables, after.tables) << e.what();
            EXPECT_EQ(before.texts, after.texts) << e.what();
            return e.what();
        }
    }
    static void expect_one_sentence(std::string const& said)
    {
        EXPECT_EQ(said.rfind("spate: ", 0), 0u) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
        EXPECT_LT(said.size(), 1000u) << said;
    }

    decltype(small_tank::scene()) tank = small_tank::scene();
    io::State state;
    Bytes bytes;
};

TEST_F(CheckpointFileTest, IsReadAsItWasWritten)
{
    const auto again = io::read_checkpoint(file());
    EXPECT_EQ(again.tables, state.tables);
    EXPECT_EQ(again.texts, state.texts);
}
TEST_F(CheckpointFileTest, SaysWhyItIsRefused)
{
    EXPECT_THAT(said_of({}), HasSubstr("the checkpoint c.h5 is no checkpoint"));
    Bytes some(bytes.begin(), bytes.begin() + 700);
    EXPECT_THAT(said_of(some), HasSubstr("cut off after 700 bytes"));
    some = bytes;
    some[some.size() / 2] ^= std::byte{4};
    EXPECT_THAT(said_of(some), HasSubstr("damaged"));
    some = bytes;
    const auto version = std::string_view("spate checkpoint\nversion ").size();
    for (char other : {'1', '3'}) {
        some[version] = std::byte(other);
        EXPECT_THAT(said_of(some),
                    HasSubstr("of version " + std::string(1, other) + ", and this program reads version 2"));
    }
    some.assign(bytes.begin() + 512, bytes.end()); // any other HDF5 file
    EXPECT_THAT(said_of(some), HasSubstr("no checkpoint"));
    some = bytes;
    some.push_back(std::byte{0});
    EXPECT_THAT(said_of(some), HasSubstr("damaged"));
    try {
        (void)io::read_checkpoint(folder / "none.h5");
        FAIL();
    }
    catch (BadInput const& e) {
        EXPECT_THAT(e.what(), HasSubstr("not to be read (No such file or directory)"));
    }
    EXPECT_THROW((void)io::read_checkpoint(folder), BadInput);
}
TEST_F(CheckpointFileTest, IsRefusedWhereverItIsCutOff)
{
    Dice dice{1};
    std::vector<std::size_t> lengths;
    for (std::size_t n = 0; n < 600; n += 7) lengths.push_back(n);
    for (int k = 0; k < 100; ++k) lengths.push_back(dice(bytes.size()));
    lengths.push_back(bytes.size() - 1);
    for (const std::size_t n : lengths)
        expect_one_sentence(said_of(Bytes(bytes.begin(), bytes.begin() + std::ptrdiff_t(n))));
}
TEST_F(CheckpointFileTest, IsRefusedWhicheverBitHasFlipped)
{
    Dice dice{2};
    for (int k = 0; k < 600; ++k) {
        const std::size_t at = k < 200 ? dice(512) : dice(bytes.size());
        Bytes flipped = bytes;
        flipped[at] ^= std::byte(1u << dice(8));
        expect_one_sentence(said_of(flipped));
    }
}
/// With a checksum that is right the content may still be that of nobody.
TEST_F(CheckpointFileTest, IsRefusedOrTakenButNeverHalfTaken)
{
    Dice dice{3};
    int refused = 0, taken = 0;
    for (int k = 0; k < 300; ++k) {
        io::State wrong = state;
        auto at = wrong.tables.begin();
        std::advance(at, std::ptrdiff_t(dice(wrong.tables.size())));
        auto& table = at->second;
        std::visit(
            [&]<class T>(std::vector<T>& v) {
                const std::size_t one = v.empty() ? 0 : dice(v.size());
                switch (v.empty() ? 6 : dice(8)) {
                case 0: v.pop_back(); break;
                case 1:
                    v[one] = std::numeric_limits<T>::has_quiet_NaN ? std::numeric_limits<T>::quiet_NaN() : T(-1);
                    break;
                case 2: v[one] = std::numeric_limits<T>::max(); break;
                case 3: std::swap(v[one], v[dice(v.size())]); break;
                case 4: v[one] = T(dice(1000)); break;
                case 5: v.clear(); break;
                case 6: v.push_back(T(1)); break;
                default: table.columns += 1; break;
                }
            },
            table.values);
        if (dice(10) == 0) wrong.tables.erase(at);
        const std::string said = said_by(tank, wrong);
        if (said.empty()) {
            ++taken;
            EXPECT_EQ(said_by(tank, state), ""); // back to what it was
        }
        else {
            ++refused;
            expect_one_sentence(said);
        }
    }
    EXPECT_GT(refused, 150);
    EXPECT_GT(taken, 10); // such as another velocity of a particle: nobody can tell
}
// A short run of the fuzzer's moves, with lengths like those of its corpus.
TEST_F(CheckpointFileTest, StandsTheMovesOfTheFuzzer)
{
    Dice dice{4};
    for (int k = 0; k < 1500; ++k) {
        std::vector<std::uint8_t> bytes_of_fuzzer(1 + dice(k % 10 == 0 ? 4096 : 40));
        for (auto& b : bytes_of_fuzzer) b = std::uint8_t(dice(256));
        fuzz::stranger(bytes_of_fuzzer);
    }
}
TEST_F(CheckpointFileTest, IsRefusedWithoutAnyOfItsTables)
{
    for (const std::int64_t have_lists : {1, 0})
        for (auto const& [name, table] : state.tables) {
            io::State less = state;
            less.put_one("run/have_lists", have_lists);
            less.tables.erase(name);
            EXPECT_NE(said_by(tank, less), "") << name;
        }
}
template <class Precision = Double, class I = RungeKutta2>
auto other_tank(double c0, double top_of_box, auto viscosity)
{
    using small_tank::dx;
    auto water = wcsph(CubicSpline<2>{.h = 1.2 * dx}, Tait{.rho0 = 1000, .c0 = c0}, Continuity<2>{}, PressureForce<2>{},
                       viscosity, Gravity<2>{{0, -9.81}});
    Simulation tank(water, I{}, Bce(Box<2>{{0, 0}, {1, top_of_box}}, dx, Adami{}, open(top)), Serial{}, Precision{});
    tank.fill(Box<2>{{0, 0}, {0.5, 0.5}}, dx, hydrostatic);
    return tank;
}
TEST_F(CheckpointFileTest, IsOfThisSceneOrRefused)
{
    const ArtificialViscosity alike{.alpha = 0.1};
    EXPECT_EQ(said_by(other_tank(30, 1, alike), state), "");
    auto scene_differs = [&](std::string const& said, std::string const& what) {
        expect_one_sentence(said);
        EXPECT_THAT(said, HasSubstr("is of another scene: its " + what));
    };
    scene_differs(said_by(other_tank(31, 1, alike), state), "c0 is 30, here it is 31");
    scene_differs(said_by(other_tank(30, 2, alike), state), "upper corner of the box along axis 1 is 1, here it is 2");
    scene_differs(said_by(other_tank(30, 1, ArtificialViscosity{.alpha = 0.2}), state), "viscosity is 0.0224");
    scene_differs(said_by(other_tank(30, 1, LaminarViscosity{.mu = 1}), state),
                  "term 3 is spate::ArtificialViscosity, here it is spate::LaminarViscosity");
    scene_differs(said_by(other_tank<Float>(30, 1, alike), state), "real is double, here it is float");
    scene_differs(said_by(other_tank<Double, Leapfrog>(30, 1, alike), state),
                  "integrator is spate::RungeKutta2, here it is spate::Leapfrog");
}

} // namespace
