// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief An HDF5 file built in memory: handles that close themselves, return codes that are checked.
///        Not a wrapper of HDF5; only what snapshots and checkpoints need, and no write to a disk, so that a full one cannot
///        leave the library with a file that it can neither flush nor close.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <hdf5.h>

#include "spate/io/output_error.hpp"

namespace spate::io::detail {

/// Keeps HDF5 from printing its error stack; the exception says it.
class Hdf5Silence {
public:
    Hdf5Silence()
    {
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    Hdf5Silence(Hdf5Silence const&) = delete;
    Hdf5Silence& operator=(Hdf5Silence const&) = delete;
    ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

private:
    H5E_auto2_t print_ = nullptr;
    void* data_ = nullptr;
};

template <herr_t (*Close)(hid_t)>
class Hdf5Handle {
public:
    explicit Hdf5Handle(hid_t id) : id_(id) {}
    Hdf5Handle(Hdf5Handle const&) = delete;
    Hdf5Handle& operator=(Hdf5Handle const&) = delete;
    ~Hdf5Handle()
    {
        if (id_ >= 0) Close(id_);
    }
    operator hid_t() const { return id_; }

private:
    hid_t id_;
};

using Hdf5File = Hdf5Handle<H5Fclose>;
using Hdf5Group = Hdf5Handle<H5Gclose>;
using Hdf5Dataset = Hdf5Handle<H5Dclose>;
using Hdf5Attribute = Hdf5Handle<H5Aclose>;
using Hdf5Space = Hdf5Handle<H5Sclose>;
using Hdf5Type = Hdf5Handle<H5Tclose>;
using Hdf5Properties = Hdf5Handle<H5Pclose>;

inline hid_t hdf5_type(float) { return H5T_NATIVE_FLOAT; }
inline hid_t hdf5_type(double) { return H5T_NATIVE_DOUBLE; }
inline hid_t hdf5_type(std::int32_t) { return H5T_NATIVE_INT32; }
inline hid_t hdf5_type(std::uint32_t) { return H5T_NATIVE_UINT32; }
inline hid_t hdf5_type(std::int64_t) { return H5T_NATIVE_INT64; }
inline hid_t hdf5_type(std::uint8_t) { return H5T_NATIVE_UINT8; }

class Hdf5Image {
public:
    /// `file` names the errors and is not touched; `bytes` is the size to expect.
    Hdf5Image(std::filesystem::path const& file, std::size_t bytes)
        : path_(file), access_(check(H5Pcreate(H5P_FILE_ACCESS), "H5Pcreate")), file_(create(bytes))
    {}

    hid_t root() const { return file_; }

    Hdf5Group group(hid_t parent, std::string const& name) const
    {
        return Hdf5Group(check(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), name));
    }

    /// Rank 1 for one component, rank 2 (rows x components) else.
    template <class T>
    void dataset(hid_t parent, std::string const& name, std::span<T const> values, std::size_t components = 1,
                 bool compressed = false) const
    {
        const std::array<hsize_t, 2> shape{values.size() / components, components};
        const int rank = components == 1 ? 1 : 2;
        const Hdf5Space space(check(H5Screate_simple(rank, shape.data(), nullptr), name));
        const Hdf5Properties creation(check(H5Pcreate(H5P_DATASET_CREATE), name));
        check(H5Pset_obj_track_times(creation, false), name); // same cloud, same bytes
        if (compressed && !values.empty()) compress(creation, rank, shape, name);
        const hid_t type = hdf5_type(T{});
        const Hdf5Dataset set(
            check(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), name));
        if (!values.empty()) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
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
        const Hdf5Type type(check(H5Tcopy(H5T_C_S1), name));
        check(H5Tset_size(type, text.size()), name);
        check(H5Tset_strpad(type, H5T_STR_NULLPAD), name);
        check(H5Tset_cset(type, H5T_CSET_ASCII), name);
        const Hdf5Space space(check(H5Screate(H5S_SCALAR), name));
        write_attribute(parent, name, type, space, text.data());
    }

    /// A text, filled up with zeros.
    void text(hid_t parent, std::string const& name, std::string const& text) const
    {
        const Hdf5Type type(check(H5Tcopy(H5T_C_S1), name));
        check(H5Tset_size(type, text.size() + 1), name);
        check(H5Tset_strpad(type, H5T_STR_NULLPAD), name);
        const Hdf5Space space(check(H5Screate(H5S_SCALAR), name));
        const Hdf5Properties creation(check(H5Pcreate(H5P_DATASET_CREATE), name));
        check(H5Pset_obj_track_times(creation, false), name);
        const Hdf5Dataset set(
            check(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT), name));
        check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()), name);
    }

    /// The bytes of the file.
    std::vector<std::byte> bytes() const
    {
        check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "H5Fflush");
        const auto size = check(H5Fget_file_image(file_, nullptr, 0), "H5Fget_file_image");
        std::vector<std::byte> image(static_cast<std::size_t>(size));
        check(H5Fget_file_image(file_, image.data(), image.size()), "H5Fget_file_image");
        return image;
    }

private:
    template <class Code>
    Code check(Code code, std::string const& where) const
    {
        if (code < 0) throw OutputError(path_, "HDF5 failed at " + where, "check the free memory and the HDF5 library");
        return code;
    }

    hid_t create(std::size_t bytes) const
    {
        constexpr std::size_t smallest = 1 << 16;
        check(H5Pset_fapl_core(access_, std::max(bytes, smallest), false), "H5Pset_fapl_core");
        const std::string name = path_.string() + ".tmp";
        return check(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_), "H5Fcreate");
    }

    void compress(hid_t creation, int rank, std::array<hsize_t, 2> shape, std::string const& name) const
    {
        constexpr hsize_t rows = 1 << 16;
        shape[0] = std::min(shape[0], rows);
        check(H5Pset_chunk(creation, rank, shape.data()), name);
        check(H5Pset_shuffle(creation), name);
        check(H5Pset_deflate(creation, 1), name);
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
