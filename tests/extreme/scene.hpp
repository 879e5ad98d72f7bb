// SPDX-License-Identifier: BSD-3-Clause
// Three scenes in double and float behind one interface, so that they are compiled once for all tests of this folder:
// a fluid, a fluid between walls of markers, grains of any mass and radius between elastic walls; each under any integrator
// on any number of threads.
#pragma once

#include "extreme/chosen.hpp"

#include <functional>
#include <memory>
#include <ostream>
#include <vector>

namespace extreme {

using spate::Box;
using spate::Vec;

enum class Kind { fluid, walled, grains };
enum class Real { double_, float_ };

/// Every number of a scene; the defaults are a good one.
struct Setup {
    Kind kind = Kind::fluid;
    Real real = Real::double_;
    int integrator = chosen::leapfrog;
    int threads = 1, cell = 0;
    Box<2> box{{{0, 0}}, {{1, 1}}};
    bool periodic = false; ///< else open (fluid), or walls
    spate::Watch watch{};
    double skin = 0; ///< 0: as the interaction has it

    double dx = 0.02, smoothing = 1.3, rho0 = 1000, c0 = 20, alpha = 0.1; // fluids
    double largest = 0.01, k = 1e5;                                       // grains
    Vec<2, double> g{};
};

/// One particle.
struct State {
    Vec<2, double> x{}, v{}, a{};
    double rho = 0, rho_rate = 0, p = 0; // fluids
    double mass = 0, radius = 0;
};

class Scene {
public:
    virtual ~Scene() = default;
    virtual std::size_t fill(Box<2> const& box) = 0;
    /// Of grains mass and radius must be given.
    virtual void add(Vec<2, double> x, Vec<2, double> v = {}, double mass = 0, double radius = 0) = 0;
    virtual void run(spate::RunOptions const& o, std::function<void()> const& after_step = nullptr) = 0;
    virtual std::vector<State> states() = 0; ///< by id
    virtual void put(std::size_t id, State const& s) = 0;
    virtual void rates() = 0;   ///< of the state of now
    virtual void current() = 0; ///< wraps what has left a period
    [[nodiscard]] virtual std::size_t size() const = 0;
    [[nodiscard]] virtual double dt() const = 0;
    [[nodiscard]] virtual double time() const = 0;
    [[nodiscard]] virtual std::int64_t steps() const = 0;
    [[nodiscard]] virtual std::uint64_t hash() const = 0;
    [[nodiscard]] virtual spate::Energy energy() const = 0;
    [[nodiscard]] virtual Vec<2, double> momentum() const = 0;
    [[nodiscard]] virtual spate::RunReport const& report() const = 0;
};

/// Throws what the library throws.
std::unique_ptr<Scene> make(Setup const& s);

/// How a run ended: "ok", the name of a stop, or "BadInput", and what it said.
struct End {
    std::string name = "ok", message;
    spate::StopFacts facts;
};
template <class F>
End end_of(F const& run)
{
    try {
        run();
    }
    catch (spate::Stop const& stop) {
        return {stop.name(), stop.what(), stop.facts()};
    }
    catch (spate::BadInput const& bad) {
        return {"BadInput", bad.what(), {}};
    }
    return {};
}
/// Whether each number of the state is finite.
bool finite(std::vector<State> const& all);

inline std::ostream& operator<<(std::ostream& out, Real r) { return out << (r == Real::double_ ? "double" : "float"); }

} // namespace extreme
