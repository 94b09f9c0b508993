// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints whose contents are wrong and whose checksum is right: what a run in error, or somebody with an editor, writes.
#pragma once

#include <coagula/io/structure_file.hpp>

#include "hdf5_edits.hpp"

namespace coagula::fuzz {

inline void put_checksum(const std::string& path) {
    std::vector<io::Dataset> all = io::read_results(path, "/");
    std::erase_if(all, [](const io::Dataset& dataset) { return dataset.path == "/checksum"; });
    const std::string sum = io::datasets_sha256(all);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, "/checksum", H5P_DEFAULT);
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, sum.size());
    const hid_t dataset = H5Dcreate2(file, "/checksum", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, sum.data());
    H5Dclose(dataset);
    H5Tclose(type);
    H5Sclose(space);
    H5Fclose(file);
}

/// Edits the checkpoint `sound` as the input says and lets `read` take the file.
template <class Read>
void read_edited_checkpoint(const InputFolder& folder, const std::string& sound, Choices choices, Read&& read) {
    const std::string path = folder.write("checkpoint.h5", sound);
    edit_hdf5(path, choices);
    expect_value_or_sentence(path, [&] {
        put_checksum(path);
        read(path);
    });
}

}  // namespace coagula::fuzz
