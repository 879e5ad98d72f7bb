// SPDX-License-Identifier: BSD-3-Clause
#include "support/summary.hpp"

#include <cstdlib>
#include <cxxabi.h>
#include <fstream>
#include <memory>
#include <regex>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <png.h>
#include <xsimd/config/xsimd_config.hpp>

#include <spate/io/detail/replace_file.hpp>

#include "support/hdf5_version.hpp"

#ifndef SPATE_VERSION
#define SPATE_VERSION "unknown"
#endif

namespace example {

namespace {

using Json = nlohmann::ordered_json;

double over(double a, double b) { return b > 0 ? a / b : std::numeric_limits<double>::quiet_NaN(); }

template <class... N>
std::string dotted(N... n)
{
    std::string s;
    ((s += std::to_string(n), s += '.'), ...);
    s.pop_back();
    return s;
}

Json versions()
{
    return {{"spate", SPATE_VERSION},
            {"eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
            {"xsimd", dotted(XSIMD_VERSION_MAJOR, XSIMD_VERSION_MINOR, XSIMD_VERSION_PATCH)},
            {"hdf5", hdf5_version()},
            {"libpng", png_get_libpng_ver(nullptr)},
            {"cli11", CLI11_VERSION},
            {"nlohmann_json",
             dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
}

std::string compiler()
{
#ifdef __clang__
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

std::string cpu()
{
    std::ifstream in("/proc/cpuinfo");
    for (std::string line; std::getline(in, line);)
        if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.size(), line.find(':') + 2));
    return "unknown";
}

std::string hexadecimal(std::uint64_t hash)
{
    std::string s(16, '0');
    for (std::size_t k = 16; k-- > 0; hash >>= 4) s[k] = "0123456789abcdef"[hash & 15];
    return s;
}

Json detail_of(Summary const& s)
{
    if (s.stop == "ok") return nullptr;
    auto const& f = s.stop_facts;
    Json d{{"message", s.stop_message}, {"step", f.step}, {"time", f.time}};
    if (f.quantity.empty()) return d;
    d["quantity"] = f.quantity;
    d["value"] = f.value;
    d["limit"] = f.limit;
    if (f.particle < 0) return d;
    d["particle"] = f.particle;
    d["species"] = f.species;
    d["position"] = f.position;
    d["velocity"] = f.velocity;
    return d;
}

} // namespace

void Summary::add_species(std::string const& species, std::size_t count, Words const& its_fields)
{
    particles.emplace_back(species, count);
    fields.emplace_back(species, its_fields);
}

void Summary::add_choice(std::string const& role, std::string const& choice) { composition.emplace_back(role, choice); }

std::size_t Summary::total() const
{
    std::size_t n = 0;
    for (auto const& [species, count] : particles) n += count;
    return n;
}
double Summary::energy_drift() const
{
    const double reference = energy_reference > 0 ? energy_reference : std::abs(energy_start);
    return over(energy_end - energy_start, reference);
}
double Summary::ns_per_particle_step() const { return over(1e9 * wall, double(steps) * double(total())); }
double Summary::ns_per_pair() const { return over(1e9 * wall, double(pairs)); }

void Summary::write(std::filesystem::path const& file) const
{
    Json j;
    j["scene"] = scene;
    for (auto const& [species, count] : particles) j["particles"][species] = count;
    j["steps"] = steps;
    j["time"] = time;
    j["force_evaluations"] = force_evaluations;
    j["pairs"] = pairs;
    j["neighbours_mean"] = over(double(pairs), double(force_evaluations) * double(total()));
    j["wall_s"] = wall;
    j["cpu_s"] = cpu;
    j["ns_per_particle_step"] = ns_per_particle_step();
    j["ns_per_pair"] = ns_per_pair();
    j["bytes_per_particle"] = over(double(bytes), double(total()));
    j["energy_drift"] = energy_drift();
    j["energy_start_J"] = energy_start;
    j["energy_end_J"] = energy_end;
    j["energy_reference_J"] = energy_reference;
    if (mach > 0) j["mach_max"] = mach, j["density_change_max"] = density_change;
    j["stop"] = stop;
    j["stop_detail"] = detail_of(*this);
    j["state_hash"] = hexadecimal(state_hash);
    for (auto const& [role, name] : composition) j["composition"][role] = name;
    j["composition"]["terms"] = terms;
    for (auto const& [species, names] : fields) j["fields"][species] = names;
    for (auto const& [name, value] : measures) j["measures"][name] = value;
    j["warnings"] = warnings;
    j["files"] = files;
    j["versions"] = versions();
    j["compiler"] = compiler();
    j["cpu"] = example::cpu();
    j["threads"] = threads;
    j["ranks"] = ranks;
    j["seed"] = seed;
    spate::io::detail::replace_file(file, j.dump(2) + "\n");
}

std::string type_name(char const* mangled)
{
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(mangled, nullptr, nullptr, &status),
                                                      std::free);
    return std::regex_replace(std::string(status == 0 ? name.get() : mangled),
                              std::regex("(\\w+|\\(anonymous namespace\\))::"), "");
}

} // namespace example
