// SPDX-License-Identifier: BSD-3-Clause
#include "support/pictures.hpp"

namespace example {

void write_picture(std::filesystem::path const& file, spate::io::Picture const& picture,
                   std::vector<spate::io::Ball> const& balls)
{
    spate::io::write_png(file, picture, balls);
}

} // namespace example
