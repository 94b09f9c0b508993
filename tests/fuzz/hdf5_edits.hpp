// SPDX-License-Identifier: GPL-3.0-or-later
// Files whose HDF5 is sound and whose contents are not: a file of ours, with objects and attributes changed as the input says.
//
// libhdf5 itself crashes on damaged structures, for which the program reads in a child process. Here everything runs in one process
// (direct_reading.cpp), so that the sanitizers see the code of coagula.
#pragma once

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "reader_contract.hpp"

namespace coagula::fuzz {

/// Takes small decisions from the input; zeros when it is used up.
class Choices {
public:
    Choices(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    bool any() const { return size_ > 0; }
    std::size_t below(std::size_t count) {
        const std::size_t value = size_ > 0 ? *data_ : 0;
        data_ += any() ? 1 : 0;
        size_ -= any() ? 1 : 0;
        return value % count;
    }
    std::string text() {
        const std::size_t length = std::min(below(24), size_);
        std::string taken(text_of(data_, length));
        data_ += length;
        size_ -= length;
        return taken;
    }
    double number() {
        static const std::vector<double> numbers{
            0, 1, -1, 2, 3, 7, 0.5, 1e-7, 1e300, -1e300, 1e99, 5e-324, 4294967296.0, -9e18, std::nan(""), HUGE_VAL, 1e18};
        return numbers[below(numbers.size())];
    }

private:
    const std::uint8_t* data_;
    std::size_t size_;
};

/// Changes the objects of a file.
class Hdf5Editor {
public:
    Hdf5Editor(hid_t file, Choices& choices) : file_(file), choices_(choices) {
        H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, append_name, &names_);
    }

    void edit() {
        for (int edits = 0; edits < 6 && choices_.any(); ++edits) {
            const std::string& name = names_[choices_.below(names_.size())];
            switch (choices_.below(7)) {
                case 0:
                    H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
                    break;
                case 1:
                    H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
                    make_dataset(name);
                    break;
                case 2:
                    set_attribute(name);
                    break;
                case 3:
                    H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
                    H5Gclose(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
                    break;
                case 4:
                    replace_by_link(name);
                    break;
                default:
                    change_value(name);
            }
        }
    }

private:
    static herr_t append_name(hid_t /*group*/, const char* name, const H5L_info_t* /*info*/, void* names) {
        static_cast<std::vector<std::string>*>(names)->emplace_back(name);
        return 0;
    }

    void replace_by_link(const std::string& name) {
        const std::string& other = names_[choices_.below(names_.size())];
        H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
        if (choices_.below(2) == 0) {
            H5Lcreate_soft(other.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        } else {
            H5Lcreate_hard(file_, other.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        }
    }

    /// Numbers or texts of any shape.
    void make_dataset(const std::string& name) {
        std::vector<hsize_t> shape(choices_.below(4));
        std::generate(shape.begin(), shape.end(), [&] { return choices_.below(10) == 9 ? hsize_t{1} << 40 : choices_.below(9); });
        const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
        const std::vector<hid_t> types{H5T_NATIVE_DOUBLE, H5T_NATIVE_INT64, H5T_NATIVE_FLOAT, H5T_NATIVE_UINT8, H5T_NATIVE_ULLONG};
        const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
        if (!shape.empty() && choices_.below(2) == 1) {
            const std::vector<hsize_t> chunk(shape.size(), 4);
            H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
        }
        const double number = choices_.number();
        H5Pset_fill_value(properties, H5T_NATIVE_DOUBLE, &number);
        const std::size_t kind = choices_.below(types.size() + 1);
        const hid_t type = kind < types.size() ? H5Tcopy(types[kind]) : text_type();
        const hid_t dataset = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
        H5Dclose(dataset);
        H5Pclose(properties);
        H5Tclose(type);
        H5Sclose(space);
        set_attribute(name);
    }

    hid_t text_type() {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, choices_.below(2) == 0 ? H5T_VARIABLE : 1 + choices_.below(16));
        return type;
    }

    void set_attribute(const std::string& name) {
        static const std::vector<std::string> attributes{"unit", "description", "boundary", "dimension", "version", "creator"};
        const std::string& attribute = attributes[choices_.below(attributes.size())];
        H5Adelete_by_name(file_, name.c_str(), attribute.c_str(), H5P_DEFAULT);
        const hsize_t count = choices_.below(4);
        const hid_t space = count == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
        const std::string text = choices_.text();
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, std::max<std::size_t>(1, text.size()));
        const hid_t made =
            H5Acreate_by_name(file_, name.c_str(), attribute.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        std::string all(std::max<std::size_t>(1, text.size()) * (count + 1), '\0');
        for (std::size_t i = 0; i < all.size() && !text.empty(); ++i) {
            all[i] = text[i % text.size()];
        }
        H5Awrite(made, type, all.data());
        H5Aclose(made);
        H5Tclose(type);
        H5Sclose(space);
    }

    /// One of the numbers of a small dataset.
    void change_value(const std::string& name) {
        const hid_t dataset = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
        const hid_t space = H5Dget_space(dataset);
        const hssize_t count = dataset >= 0 ? H5Sget_simple_extent_npoints(space) : 0;
        if (count > 0 && count < 10000) {
            std::vector<double> values(static_cast<std::size_t>(count));
            if (H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0) {
                values[choices_.below(256) * 7 % values.size()] = choices_.number();
                H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
            }
        }
        H5Sclose(space);
        H5Dclose(dataset);
    }

    hid_t file_;
    Choices& choices_;
    std::vector<std::string> names_;
};

/// Changes the file `path`.
inline void edit_hdf5(const std::string& path, Choices& choices) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    expect(file >= 0, path + " cannot be opened");
    Hdf5Editor(file, choices).edit();
    H5Fclose(file);
}

inline std::string contents_of(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace coagula::fuzz
