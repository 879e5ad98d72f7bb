// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// \brief Reads the tables and texts of an HDF5 file from its bytes in memory, whatever they are called.
///        Only for bytes whose checksum is right: HDF5 is not made for those of a stranger.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "spate/io/detail/hdf5.hpp"
#include "spate/io/state.hpp"

namespace spate::io::detail {

using Hdf5Object = Hdf5Handle<H5Oclose>;

class Hdf5Contents {
public:
    /// Adds all that the bytes hold to the state; throws BadInput.
    Hdf5Contents(std::span<std::byte const> bytes, State& state)
        : state_(state), most_(bytes.size()), access_(check(H5Pcreate(H5P_FILE_ACCESS))), file_(open(bytes))
    {
        read_group(file_, "");
    }

private:
    template <class Code>
    Code check(Code code) const
    {
        if (code < 0) state_.refuse("not what its name says: HDF5 cannot read it");
        return code;
    }
    hid_t open(std::span<std::byte const> bytes) const
    {
        check(H5Pset_fapl_core(access_, 1 << 16, false));
        check(H5Pset_file_image(access_, const_cast<std::byte*>(bytes.data()), bytes.size())); // it makes a copy
        return check(H5Fopen("checkpoint", H5F_ACC_RDONLY, access_));
    }
    void read_group(hid_t group, std::string const& prefix) const
    {
        H5G_info_t info{};
        check(H5Gget_info(group, &info));
        for (hsize_t k = 0; k < info.nlinks; ++k) {
            std::string name(std::size_t(check(H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, nullptr, 0,
                                                                  H5P_DEFAULT))),
                             '\0');
            check(H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name.data(), name.size() + 1,
                                     H5P_DEFAULT));
            const Hdf5Object object(check(H5Oopen(group, name.c_str(), H5P_DEFAULT)));
            const auto kind = H5Iget_type(object);
            if (kind == H5I_GROUP && prefix.size() < 100) read_group(object, prefix + name + "/");
            else if (kind == H5I_DATASET) read_dataset(object, prefix + name);
            else state_.refuse("with something strange, " + prefix + name);
        }
    }
    void read_dataset(hid_t set, std::string const& name) const
    {
        const Hdf5Type type(check(H5Dget_type(set)));
        const Hdf5Space space(check(H5Dget_space(set)));
        const int rank = check(H5Sget_simple_extent_ndims(space));
        if (rank > 2) state_.refuse("with a " + name + " of another shape");
        std::array<hsize_t, 2> shape{1, 1};
        check(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
        const std::size_t size = H5Tget_size(type);
        if (size == 0 || shape[1] == 0 || shape[1] > 64 || shape[0] > most_ / (size * shape[1]))
            state_.refuse("with a " + name + " larger than itself");
        switch (H5Tget_class(type)) {
        case H5T_STRING: return read_text(set, name, type, rank, size);
        case H5T_FLOAT: return size == 4 ? read<float>(set, name, shape) : read<double>(set, name, shape);
        case H5T_INTEGER:
            if (size == 8) return read<std::int64_t>(set, name, shape);
            if (H5Tget_sign(type) == H5T_SGN_NONE) return read<std::uint32_t>(set, name, shape);
            return read<std::int32_t>(set, name, shape);
        default: state_.refuse("with a " + name + " of another type");
        }
    }
    void read_text(hid_t set, std::string const& name, hid_t type, int rank, std::size_t size) const
    {
        if (rank != 0 || H5Tis_variable_str(type) != 0) state_.refuse("with a " + name + " of another type");
        std::string text(size, '\0');
        check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()));
        text.resize(text.find_last_not_of('\0') + 1);
        state_.texts[name] = std::move(text);
    }
    template <class T>
    void read(hid_t set, std::string const& name, std::array<hsize_t, 2> shape) const
    {
        std::vector<T> values(std::size_t(shape[0] * shape[1]));
        if (!values.empty()) check(H5Dread(set, hdf5_type(T{}), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
        state_.put(name, std::move(values), std::size_t(shape[1]));
    }

    Hdf5Silence silence_;
    State& state_;
    std::size_t most_;
    Hdf5Properties access_;
    Hdf5File file_;
};

} // namespace spate::io::detail
