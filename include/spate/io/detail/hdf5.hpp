// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Handles of HDF5 that close themselves, its types and its return codes. Not a wrapper of HDF5; only what snapshots
///        and checkpoints need. Who writes a file: io/detail/shared_file.hpp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

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

/// Throws OutputError with the name of a file where HDF5 has failed.
template <class Code>
Code hdf5_check(Code code, std::filesystem::path const& file, std::string const& where)
{
    if (code < 0) throw OutputError(file, "HDF5 failed at " + where, "check the free memory and the HDF5 library");
    return code;
}

/// How a file of our own is opened: nobody else looks at it, and some file systems have no locks.
inline Hdf5Properties hdf5_access()
{
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_file_locking(access, false, true);
    return Hdf5Properties(access);
}

} // namespace spate::io::detail
