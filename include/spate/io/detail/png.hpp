// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief The bytes of a PNG file: the same pixels give the same bytes. Writes no file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <png.h>

#include "spate/io/detail/canvas.hpp"
#include "spate/io/output_error.hpp"

namespace spate::io::detail {

/// `file` names the errors and is not touched.
inline std::vector<std::byte> png_bytes(std::filesystem::path const& file, Canvas const& canvas)
{
    static_assert(sizeof(Rgb) == 3);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(canvas.width());
    image.height = static_cast<png_uint_32>(canvas.height());
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::byte> bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, canvas.pixels().data(), 0, nullptr) == 0)
        throw OutputError(file, "libpng: " + std::string(image.message), "check the size of the picture");
    bytes.resize(size);
    return bytes;
}

} // namespace spate::io::detail
