// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief What one process puts into an HDF5 file: groups, attributes, texts, a few numbers, and the room for all rows of the
///        others. Not the rows: io/detail/hdf5_rows.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "spate/io/detail/hdf5.hpp"

namespace spate::io::detail {

/// The bytes of a file without content, made in memory.
inline std::vector<std::byte> empty_hdf5(std::filesystem::path const& named)
{
    const Hdf5Silence silence;
    const Hdf5Properties access(hdf5_check(H5Pcreate(H5P_FILE_ACCESS), named, "H5Pcreate"));
    hdf5_check(H5Pset_fapl_core(access, 1 << 16, false), named, "H5Pset_fapl_core");
    const Hdf5File file(hdf5_check(H5Fcreate((named.string() + ".core").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access),
                                   named, "H5Fcreate"));
    hdf5_check(H5Fflush(file, H5F_SCOPE_GLOBAL), named, "H5Fflush");
    const auto size = hdf5_check(H5Fget_file_image(file, nullptr, 0), named, "H5Fget_file_image");
    std::vector<std::byte> image(static_cast<std::size_t>(size));
    hdf5_check(H5Fget_file_image(file, image.data(), image.size()), named, "H5Fget_file_image");
    return image;
}

class Hdf5Outline {
public:
    /// Goes on with a file that is there; `named` is how errors call it.
    Hdf5Outline(std::filesystem::path const& file, std::filesystem::path const& named)
        : path_(named), access_(hdf5_access()), file_(check(H5Fopen(file.c_str(), H5F_ACC_RDWR, access_), "H5Fopen"))
    {}

    hid_t root() const { return file_; }

    Hdf5Group group(hid_t parent, std::string const& name) const
    {
        return Hdf5Group(check(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), name));
    }

    /// For so many rows of type T: rank 1 for one component, rank 2 (rows x components) else.
    template <class T>
    Hdf5Dataset room(hid_t parent, std::string const& name, std::uint64_t rows, std::size_t components = 1) const
    {
        const Hdf5Properties creation = properties(name);
        check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY), name);
        check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER), name);
        return make<T>(parent, name, creation, rows, components);
    }
    template <class T>
    void dataset(hid_t parent, std::string const& name, std::span<T const> values, std::size_t components = 1) const
    {
        const Hdf5Dataset set = room<T>(parent, name, values.size() / components, components);
        if (!values.empty()) check(H5Dwrite(set, hdf5_type(T{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
    }
    /// Row k is value(k); compressed, chunk by chunk, so that the whole is never in memory.
    template <class T>
    void formula(hid_t parent, std::string const& name, std::uint64_t rows, auto const& value) const
    {
        const Hdf5Properties creation = properties(name);
        const hsize_t chunk = std::min(std::uint64_t{1} << 16, rows);
        if (rows > 0) {
            check(H5Pset_chunk(creation, 1, &chunk), name);
            check(H5Pset_shuffle(creation), name);
            check(H5Pset_deflate(creation, 1), name);
        }
        const Hdf5Dataset set = make<T>(parent, name, creation, rows, 1);
        const Hdf5Space space(check(H5Dget_space(set), name));
        std::vector<T> values;
        for (hsize_t first = 0; first < rows; first += chunk) {
            const hsize_t count = std::min<hsize_t>(chunk, rows - first);
            values.clear();
            for (hsize_t k = first; k < first + count; ++k) values.push_back(value(k));
            const Hdf5Space here(check(H5Screate_simple(1, &count, nullptr), name));
            check(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &count, nullptr), name);
            check(H5Dwrite(set, hdf5_type(T{}), here, space, H5P_DEFAULT, values.data()), name);
        }
    }

    void attribute(hid_t parent, std::string const& name, std::span<std::int64_t const> values) const
    {
        const hsize_t size = values.size();
        const Hdf5Space space(check(H5Screate_simple(1, &size, nullptr), name));
        write_attribute(parent, name, H5T_NATIVE_INT64, space, values.data());
    }

    /// Fixed length, ASCII: VTK 9.3 refuses strings of variable length.
    void attribute(hid_t parent, std::string const& name, std::string const& text) const
    {
        const Hdf5Type type = text_type(name, text.size());
        check(H5Tset_cset(type, H5T_CSET_ASCII), name);
        const Hdf5Space space(check(H5Screate(H5S_SCALAR), name));
        write_attribute(parent, name, type, space, text.data());
    }

    /// A text, filled up with zeros.
    void text(hid_t parent, std::string const& name, std::string const& text) const
    {
        const Hdf5Type type = text_type(name, text.size() + 1);
        const Hdf5Space space(check(H5Screate(H5S_SCALAR), name));
        const Hdf5Properties creation = properties(name);
        const Hdf5Dataset set(
            check(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), name));
        check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), name);
    }

    /// What is written is in the file.
    void flush() const { check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "H5Fflush"); }

private:
    template <class Code>
    Code check(Code code, std::string const& where) const
    {
        return hdf5_check(code, path_, where);
    }
    /// Without times: same content, same bytes.
    Hdf5Properties properties(std::string const& name) const
    {
        const hid_t creation = check(H5Pcreate(H5P_DATASET_CREATE), name);
        check(H5Pset_obj_track_times(creation, false), name);
        return Hdf5Properties(creation);
    }
    template <class T>
    Hdf5Dataset make(hid_t parent, std::string const& name, hid_t creation, std::uint64_t rows,
                     std::size_t components) const
    {
        const std::array<hsize_t, 2> shape{rows, components};
        const Hdf5Space space(check(H5Screate_simple(components == 1 ? 1 : 2, shape.data(), nullptr), name));
        return Hdf5Dataset(
            check(H5Dcreate2(parent, name.c_str(), hdf5_type(T{}), space, H5P_DEFAULT, creation, H5P_DEFAULT), name));
    }
    Hdf5Type text_type(std::string const& name, std::size_t size) const
    {
        const hid_t type = check(H5Tcopy(H5T_C_S1), name);
        check(H5Tset_size(type, size), name);
        check(H5Tset_strpad(type, H5T_STR_NULLPAD), name);
        return Hdf5Type(type);
    }
    void write_attribute(hid_t parent, std::string const& name, hid_t type, hid_t space, void const* data) const
    {
        const Hdf5Attribute made(check(H5Acreate2(parent, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), name));
        check(H5Awrite(made, type, data), name);
    }

    Hdf5Silence silence_;
    std::filesystem::path path_;
    Hdf5Properties access_;
    Hdf5File file_;
};

} // namespace spate::io::detail
