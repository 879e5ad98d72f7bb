// SPDX-License-Identifier: BSD-3-Clause
// Start files at random: tables and data files of LAMMPS that were good before a few moves. Each is refused in one sentence
// that names the file, or gives particles that a scene can begin with. A failure prints its seed.
#include "spate/io/start_csv.hpp"
#include "spate/io/start_lammps.hpp"
#include "spate/spate.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

namespace {

using namespace spate;

class Dice {
public:
    explicit Dice(std::uint64_t seed) : random_(seed) {}
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
    bool once_in(std::size_t n) { return below(n) == 0; }
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    template <class T>
    T of(std::vector<T> const& all)
    {
        return all[below(all.size())];
    }

private:
    std::mt19937_64 random_;
};
std::string number(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}
std::string table(Dice& dice)
{
    const bool heading = dice.once_in(2);
    std::string text = heading ? "x,y,vx,vy,radius,mass\n" : "# x, y, vx, vy\n";
    for (std::size_t k = 0, n = 1 + dice.below(5); k < n; ++k) {
        text += number(0.1 + 0.1 * double(k)) + "," + number(dice.uniform()) + ", " + number(dice.uniform()) + ",0";
        text += heading ? ",0.01,0.1\n" : "\n";
    }
    return text;
}
std::string data_file(Dice& dice)
{
    const std::size_t n = 1 + dice.below(4);
    std::string text =
        "grains\n\n" + std::to_string(n) + " atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n-0.1 0.1 zlo zhi\n";
    text += "\nAtoms # sphere\n\n";
    for (std::size_t k = 1; k <= n; ++k)
        text +=
            std::to_string(k) + " 1 0.02 2000 " + number(0.1 * double(k)) + " " + number(dice.uniform()) + " 0 0 0 0\n";
    if (dice.once_in(2)) return text;
    text += "\nVelocities\n\n";
    for (std::size_t k = 1; k <= n; ++k)
        text += std::to_string(k) + " " + number(dice.uniform()) + " 0 0 0 0 " + number(dice.uniform()) + "\n";
    return text;
}
/// A move: on bytes, on words, on lines, or of the whole.
void spoil(std::string& text, Dice& dice)
{
    const std::vector<std::string> words{"nan",        "inf",
                                         "-inf",       "1e999",
                                         "-1e999",     "5e-324",
                                         "1e-200",     "1e200",
                                         "-0",         "0x10",
                                         "1,5",        "1e",
                                         "",           "+1",
                                         "1.",         ".5",
                                         "١",          "1e308",
                                         "-1",         "0",
                                         "atoms",      "xlo",
                                         "Atoms",      "#",
                                         "4294967296", "9223372036854775808",
                                         "Velocities", "radius"};
    const std::size_t at = text.empty() ? 0 : dice.below(text.size());
    auto line_end = [&](std::size_t from) { return std::min(text.find('\n', from), text.size()); };
    switch (dice.below(10)) {
    case 0: text.resize(at); break; // cut short
    case 1:
        if (!text.empty()) text.erase(at, 1 + dice.below(3));
        break;
    case 2: text.insert(at, 1, char(dice.below(256))); break;
    case 3:
        if (!text.empty()) text[at] = char(dice.below(256));
        break;
    case 4:
    case 5:
    case 6: { // a word for another
        const std::size_t first = text.find_first_of(", \n", at);
        if (first == std::string::npos) break;
        const std::size_t last = std::min(text.find_first_of(", \n", first + 1), text.size());
        text.replace(first + 1, last - first - 1, dice.of(words));
        break;
    }
    case 7: { // a line twice
        const std::size_t first = line_end(at), last = line_end(std::min(first + 1, text.size()));
        text.insert(last, text.substr(std::min(first, text.size()), last - std::min(first, text.size())));
        break;
    }
    case 8: { // a line less
        const std::size_t first = line_end(at), last = line_end(std::min(first + 1, text.size()));
        text.erase(std::min(first, text.size()), last - std::min(first, text.size()));
        break;
    }
    default: text += text.substr(at); break;
    }
}
/// "ok", "BadInput", or what went wrong.
std::string begins(auto const& read, std::string const& path)
{
    try {
        const auto start = read();
        for (std::size_t n : {start.v.size(), start.radius.size(), start.mass.size(), start.spin.size()})
            if (n != start.size() && n != 0) return "columns of different lengths";
        if (start.size() == 0) return "nobody";
        Simulation s(physics(Discs{.largest = 1e9}, LinearSpring{.k = 1}), Leapfrog{}, Open{}, Serial{}, Double{},
                     NoWatch{});
        if (start.mass.empty() || start.radius.empty()) return "ok"; // the model's, in a scene
        start.add_to(s);
        s.prepare();
        auto const& p = s.particles();
        for (std::size_t i = 0; i < p.size(); ++i)
            for (double x : {p.at(position, i)[0], p.at(position, i)[1], p.at(velocity, i)[0], p.at(velocity, i)[1]})
                if (!std::isfinite(x)) return "a value that is not finite";
        for (std::size_t i = 0; i < p.size(); ++i)
            if (!(p.at(mass, i) > 0) || !std::isfinite(p.at(mass, i)) || !(p.at(radius, i) > 0))
                return "no mass or radius";
        return "ok";
    }
    catch (BadInput const& refused) {
        const std::string said = refused.what();
        if (said.rfind("spate: ", 0) != 0) return "a sentence of another kind: " + said;
        if (said.find("particle") == std::string::npos && said.find(path) == std::string::npos &&
            said.find("start") == std::string::npos)
            return "a sentence without the file: " + said;
        return "BadInput";
    }
    catch (std::exception const& other) {
        return std::string("another exception: ") + other.what();
    }
}
void read_files(std::uint64_t first, int count)
{
    const std::string path = testing::TempDir() + "/start_" + std::to_string(::getpid());
    std::map<std::string, int> ends;
    int failures = 0;
    for (int k = 0; k < count && failures < 10; ++k) {
        Dice dice(first + std::uint64_t(k));
        const bool lammps = dice.once_in(2);
        std::string text = lammps ? data_file(dice) : table(dice);
        for (std::size_t m = dice.below(4); m > 0; --m) spoil(text, dice);
        std::ofstream(path, std::ios::binary) << text;
        const std::string end = lammps ? begins([&] { return io::start_lammps<2>(path); }, path)
                                       : begins([&] { return io::start_csv<2>(path); }, path);
        ++ends[(lammps ? "data file, " : "table, ") + end];
        if (end == "ok" || end == "BadInput") continue;
        ++failures;
        ADD_FAILURE() << "seed " << first + std::uint64_t(k) << ": " << end << "\n" << text;
    }
    std::remove(path.c_str());
    for (auto const& [end, n] : ends) std::printf("  %6d %s\n", n, end.c_str());
    for (std::string kind : {"table, ", "data file, "}) { // not all of it is nonsense
        EXPECT_GT(ends[kind + "ok"], count / 20);
        EXPECT_GT(ends[kind + "BadInput"], count / 20);
    }
}
TEST(StartFiles, AreReadOrRefusedInASentence) { read_files(1, 1000); }
TEST(LongStartFiles, AreReadOrRefusedInASentence) { read_files(1000000, 100000); }

} // namespace
