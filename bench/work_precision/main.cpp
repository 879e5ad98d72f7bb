// SPDX-License-Identifier: BSD-3-Clause
// One point of a work-precision diagram: `--list` names the families, `--family K --n 50 ...` runs one and prints a line
// of JSON. bench/work_precision/run.py decides what to run.
#include "family.hpp"

#include <cmath>
#include <cstdio>
#include <exception>
#include <map>

using namespace work_precision;

namespace {

void print(Family const& f)
{
    std::printf(R"("case": "%s", "kernel": "%s", "h_dx": %g, "formulation": "%s", "integrator": "%s", )"
                R"("precision": "%s")",
                f.scene.c_str(), f.kernel.c_str(), f.h_dx, f.formulation.c_str(), f.integrator.c_str(),
                f.precision.c_str());
}
void print(Outcome const& o)
{
    std::printf(R"({"N": %zu, "dt": %.9g, "steps": %lld, "force_evals": %lld, "pairs": %lld, "wall_s": %.6g, )"
                R"("cpu_s": %.6g, "setup_s": %.6g, "status": "%s", "errors": {)",
                o.particles, o.dt, static_cast<long long>(o.steps), static_cast<long long>(o.force_evals),
                static_cast<long long>(o.pairs), o.wall, o.cpu, o.setup, o.status.c_str());
    bool first = true;
    for (auto const& [name, value] : o.errors) {
        if (!std::isfinite(value)) continue; // JSON has no word for it
        std::printf(R"(%s"%s": %.9g)", first ? "" : ", ", name.c_str(), value);
        first = false;
    }
    std::printf("}}\n");
}

Setting setting(std::map<std::string, double> const& given)
{
    Setting s;
    for (auto const& [name, value] : given) {
        if (name == "n") s.n = int(value);
        else if (name == "cfl") s.cfl = value;
        else if (name == "sound") s.sound = value;
        else if (name == "reynolds") s.reynolds = value;
        else if (name == "length") s.length = value;
        else if (name == "until") s.until = value;
        else if (name == "jitter") s.jitter = value;
        else if (name == "omega_dt") s.omega_dt = value;
        else if (name == "skin") s.skin = value;
        else if (name == "cell") s.cell = int(value);
        else if (name == "threads") s.threads = int(value);
        else if (name == "at_most") s.at_most = value;
        else if (name != "family") throw BadInput("option", "--" + name, "one that Setting names");
    }
    return s;
}

} // namespace

int main(int argc, char** argv)
{
    if (argc == 2 && std::string(argv[1]) == "--list") {
        for (std::size_t k = 0; k < families().size(); ++k) {
            std::printf("{\"family\": %zu, ", k);
            print(families()[k]);
            std::printf("}\n");
        }
        return 0;
    }
    if (argc < 3 || argc % 2 == 0) {
        std::fprintf(stderr,
                     "usage: bench_work_precision --list | --family K [--n N] [--cfl C] [--NAME VALUE]...\n"
                     "NAME: sound reynolds length until jitter omega_dt skin cell threads at_most (family.hpp)\n");
        return 2;
    }
    try {
        std::map<std::string, double> given;
        for (int k = 1; k + 1 < argc; k += 2) given[std::string(argv[k]).substr(2)] = std::stod(argv[k + 1]);
        print(families().at(std::size_t(given.at("family"))).run(setting(given)));
    }
    catch (std::exception const& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}
