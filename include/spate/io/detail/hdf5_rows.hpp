// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Writes a stretch of the rows of datasets for which a file has room: the file is open on this process alone, or, by
///        MPI, on all at once. Not the room: io/detail/hdf5_outline.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "spate/io/detail/hdf5.hpp"

namespace spate::io::detail {

/// Whether this HDF5 can open a file on all processes of MPI.
#ifdef H5_HAVE_PARALLEL
inline constexpr bool hdf5_knows_mpi = true;
inline herr_t hdf5_by_mpi(hid_t access, int communicator)
{
    return H5Pset_fapl_mpio(access, MPI_Comm_f2c(communicator), MPI_INFO_NULL);
}
inline herr_t hdf5_together(hid_t transfer) { return H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE); }
#else
inline constexpr bool hdf5_knows_mpi = false;
inline herr_t hdf5_by_mpi(hid_t /*access*/, int /*communicator*/) { return -1; }
inline herr_t hdf5_together(hid_t /*transfer*/) { return -1; }
#endif

/// Throws nothing: one that is opened by MPI is left by all, or others wait for ever. All write the same datasets in the same
/// order, also those of which they have no row.
class Hdf5Rows {
public:
    /// \param communicator  of MPI, by its Fortran handle, if the file is to be opened by all of it
    Hdf5Rows(std::filesystem::path const& file, std::optional<int> communicator)
        : access_(hdf5_access()), transfer_(H5Pcreate(H5P_DATASET_XFER)), file_(open(file.c_str(), communicator))
    {}
    /// Where HDF5 has failed first, empty if nowhere.
    [[nodiscard]] std::string const& failed() const { return failed_; }

    /// Rows from `first` on, of all that the dataset has room for.
    template <class T>
    void write(std::string const& name, std::span<T const> values, std::size_t components, std::uint64_t first)
    {
        const Hdf5Dataset set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
        const Hdf5Space space(H5Dget_space(set));
        const std::array<hsize_t, 2> begin{first, 0}, count{values.size() / components, components};
        const Hdf5Space here(H5Screate_simple(components == 1 ? 1 : 2, count.data(), nullptr));
        if (values.empty()) note(H5Sselect_none(space), name), note(H5Sselect_none(here), name);
        else note(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr), name);
        T const nothing{};
        note(H5Dwrite(set, hdf5_type(T{}), here, space, transfer_, values.empty() ? &nothing : values.data()), name);
    }
    void flush() { note(H5Fflush(file_, H5F_SCOPE_GLOBAL), "H5Fflush"); }

private:
    hid_t open(char const* file, std::optional<int> communicator)
    {
        if (communicator) {
            note(hdf5_by_mpi(access_, *communicator), "H5Pset_fapl_mpio");
            note(hdf5_together(transfer_), "H5Pset_dxpl_mpio");
        }
        const hid_t id = H5Fopen(file, H5F_ACC_RDWR, access_);
        note(id < 0 ? -1 : 0, "H5Fopen");
        return id;
    }
    void note(herr_t code, std::string const& where)
    {
        if (code < 0 && failed_.empty()) failed_ = where;
    }

    Hdf5Silence silence_;
    std::string failed_;
    Hdf5Properties access_, transfer_;
    Hdf5File file_;
};

} // namespace spate::io::detail
