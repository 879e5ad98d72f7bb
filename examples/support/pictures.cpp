// SPDX-License-Identifier: BSD-3-Clause
#include "support/pictures.hpp"

#include <cstdio>

#include <spate/core/errors.hpp>
#include <spate/io/picture.hpp>

namespace example {

Pictures::Pictures(std::filesystem::path directory, std::string name, double every, std::string const& colour)
    : directory_(std::move(directory)), name_(std::move(name)), interval_(every), every_(every),
      by_pressure_(colour == "pressure")
{
    spate::require_non_negative("picture-every", every, "s");
}

std::filesystem::path Pictures::file() const { return directory_ / (name_ + ".png"); }

std::filesystem::path Pictures::numbered()
{
    std::string number = std::to_string(count_++);
    number.insert(0, 6 - std::min<std::size_t>(6, number.size()), '0');
    return directory_ / (name_ + "_" + number + ".png");
}

void Pictures::write(std::filesystem::path const& file, double time, int dim, double fastest,
                     std::vector<spate::io::Ball> const& balls) const
{
    spate::io::Picture picture;
    std::array<char, 80> title{};
    std::snprintf(title.data(), title.size(), "%.40s   t = %.3f s", name_.c_str(), time);
    picture.title = title.data();
    picture.value_name = by_pressure_ ? "pressure" : "speed";
    picture.unit = by_pressure_ ? "Pa" : "m/s";
    picture.dim = dim < 3 ? 2 : 3;
    if (!by_pressure_) picture.value_min = 0, picture.value_max = fastest;
    spate::io::write_png(file, picture, balls);
}

} // namespace example
