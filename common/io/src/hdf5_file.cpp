// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdf5_file.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/io/input_file.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <numeric>

#include <coagula/io/printable.hpp>

namespace coagula::io::hdf5 {

namespace {

/// More bytes than that for each byte of the file are taken for a damaged header: deflate makes at most 1032 of one.
constexpr std::size_t largest_growth = 2048;
constexpr std::size_t always_plausible = std::size_t{1} << 20;

Handle file_access() {
    Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(properties.get(), true, true);  // not every file system can lock
    return properties;
}

herr_t append_name(hid_t /*group*/, const char* name, const H5L_info_t* /*info*/, void* names) {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
}

/// Whether another program has the file open for writing, which HDF5 locks.
bool is_locked(const std::string& path) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    const bool locked = descriptor >= 0 && flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (descriptor >= 0) {
        close(descriptor);
    }
    return locked;
}

std::string why_not_opened(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        return "does not exist";
    }
    if (!std::filesystem::is_regular_file(status)) {
        return "is not a regular file";
    }
    if (is_locked(path)) {
        return "is open for writing in another program";
    }
    const htri_t is_hdf5 = H5Fis_hdf5(path.c_str());
    if (is_hdf5 == 0) {
        const bool named_so = std::filesystem::path(path).extension() == ".h5";
        return named_so ? "is not an HDF5 file" : "is not an HDF5 file; coagula import makes one of coordinates in other formats";
    }
    return is_hdf5 > 0 ? "is truncated or damaged" : "cannot be read";
}

Content content_of(const Handle& opened) {
    const Handle type(H5Dget_type(opened.get()), H5Tclose);
    switch (H5Tget_class(type.get())) {
        case H5T_FLOAT:
            return Content::real;
        case H5T_INTEGER:
            return Content::integer;
        case H5T_STRING:
            return Content::text;
        default:
            return Content::other;
    }
}

Shape extent_of(const Handle& space) {
    const int rank = H5Sget_simple_extent_ndims(space.get());
    std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
    H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
    return {extent.begin(), extent.end()};
}

}  // namespace

void silence_errors() {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

File File::opened(const std::string& path, const Handle& access) {
    silence_errors();
    Handle id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
    if (!id) {
        throw InputError(path + " " + why_not_opened(path));
    }
    File file{path, nullptr, std::move(id)};
    file.length_ = std::filesystem::file_size(path);
    return file;
}

File File::open(const std::string& path) {
    check_input(path);
    File file = opened(path, file_access());
    file.inspect();
    return file;
}

File File::open_own(const std::string& path) {
    constexpr std::size_t growth = std::size_t{1} << 20;
    const Handle access = file_access();
    H5Pset_fapl_core(access.get(), growth, false);
    return opened(path, access);
}

void File::fail(const std::string& object, const std::string& rule) const {
    throw InputError(path_ + ": " + object + " " + rule);
}

std::size_t File::count(const Shape& shape) {
    return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

bool File::has(const std::string& object) const {
    for (std::size_t end = object.find('/', 1);; end = object.find('/', end + 1)) {
        const std::string part = object.substr(0, end);
        if (part != "/" && !part.empty() && H5Lexists(id_.get(), part.c_str(), H5P_DEFAULT) <= 0) {
            return false;
        }
        if (end == std::string::npos) {
            return true;
        }
    }
}

Handle File::open_object(const std::string& object) const {
    if (!last_ || last_name_ != object) {
        keep_open(object, {H5Oopen(id_.get(), object.c_str(), H5P_DEFAULT), H5Oclose});
    }
    if (last_) {
        H5Iinc_ref(last_.get());
    }
    return {last_.get(), H5Oclose};
}

void File::keep_open(const std::string& object, Handle opened) const {
    last_ = std::move(opened);
    last_name_ = object;
}

bool File::is_group(const std::string& object) const {
    const Handle opened = open_object(object);
    return opened && H5Iget_type(opened.get()) == H5I_GROUP;
}

bool File::is_dataset(const std::string& object) const {
    const Handle opened = open_object(object);
    return opened && H5Iget_type(opened.get()) == H5I_DATASET;
}

std::vector<std::string> File::children(const std::string& group) const {
    std::vector<std::string> names;
    const Handle opened = open_object(group);
    if (opened && H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, append_name, &names) < 0) {
        fail(group, "cannot be listed: the file is damaged");
    }
    return names;
}

void File::for_each_dataset(const std::string& object, const std::function<void(const std::string&)>& visit) const {
    if (is_dataset(object)) {
        visit(object);
        return;
    }
    std::vector<std::string> names;
    const Handle opened = open_object(object);
    if (opened && H5Lvisit(opened.get(), H5_INDEX_NAME, H5_ITER_INC, append_name, &names) < 0) {
        fail(object, "cannot be listed: the file is damaged");
    }
    std::sort(names.begin(), names.end());
    const std::string folder = object.ends_with('/') ? object : object + '/';
    for (const std::string& name : names) {
        const std::string full = folder + name;
        if (is_dataset(full)) {
            visit(full);
        }
    }
}

std::vector<std::string> File::datasets_below(const std::string& object) const {
    std::vector<std::string> datasets;
    for_each_dataset(object, [&](const std::string& dataset) { datasets.push_back(dataset); });
    return datasets;
}

Handle File::open_dataset(const std::string& dataset) const {
    Handle opened = open_object(dataset);
    if (!opened && !has(dataset)) {
        fail(dataset, "is missing");
    }
    if (!opened || H5Iget_type(opened.get()) != H5I_DATASET) {
        fail(dataset, "is not a dataset");
    }
    return opened;
}

Content File::content(const std::string& dataset) const {
    return content_of(open_dataset(dataset));
}

Shape File::shape(const std::string& dataset) const {
    return shape_of(open_dataset(dataset), dataset);
}

Shape File::shape_of(const Handle& opened, const std::string& dataset) const {
    const Handle space(H5Dget_space(opened.get()), H5Sclose);
    if (H5Sget_simple_extent_type(space.get()) == H5S_NULL) {
        fail(dataset, "is empty");
    }
    const Handle type(H5Dget_type(opened.get()), H5Tclose);
    Shape shape = extent_of(space);
    std::size_t bytes = std::max(H5Tget_size(type.get()), sizeof(double));  // as they are read
    for (const std::size_t length : shape) {
        bytes = length > 0 && bytes > SIZE_MAX / length ? SIZE_MAX : bytes * length;
    }
    require_plausible(dataset, bytes);
    return shape;
}

void File::require_plausible(const std::string& object, std::size_t bytes) const {
    if (bytes > always_plausible && bytes / largest_growth > length_) {
        fail(object, "has an impossible size: the file is damaged");
    }
}

Handle File::slice_of(const Handle& opened, std::size_t frame) {
    Handle space(H5Dget_space(opened.get()), H5Sclose);
    const Shape shape = extent_of(space);
    std::vector<hsize_t> start(shape.size(), 0);
    std::vector<hsize_t> extent(shape.begin(), shape.end());
    start[0] = frame;
    extent[0] = 1;
    H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
    return space;
}

void File::read_numbers(const Handle& opened, const std::string& dataset, hid_t memory_type, void* values,
                        const Handle& slice) const {
    const Content found = content_of(opened);
    if (found != Content::real && found != Content::integer) {
        fail(dataset, "does not hold numbers");
    }
    const Handle properties(H5Dget_create_plist(opened.get()), H5Pclose);
    const bool chunked = H5Pget_layout(properties.get()) == H5D_CHUNKED;
    const Handle type(H5Dget_type(opened.get()), H5Tclose);
    const std::size_t stored = H5Dget_storage_size(opened.get());
    if (!chunked && stored > 0 && stored < count(shape_of(opened, dataset)) * H5Tget_size(type.get())) {
        fail(dataset, "is stored in less room than it needs: the file is damaged");  // HDF5 1.10 would read past the end
    }
    Handle memory;
    if (slice) {
        const auto selected = static_cast<hsize_t>(H5Sget_select_npoints(slice.get()));
        memory = Handle(H5Screate_simple(1, &selected, nullptr), H5Sclose);
    }
    if (H5Dread(opened.get(), memory_type, slice ? memory.get() : H5S_ALL, slice ? slice.get() : H5S_ALL, H5P_DEFAULT, values) <
        0) {
        fail(dataset, "cannot be read: the file is damaged");
    }
}

/// Texts of a dataset or attribute of strings, of fixed or variable length. `read(type, buffer)` fills the buffer.
template <class Read>
std::vector<std::string> File::read_texts(const std::string& object, const Handle& type, const Handle& space, Read&& read) const {
    std::vector<std::string> texts;
    if (H5Tget_class(type.get()) != H5T_STRING) {
        return texts;
    }
    const auto number = static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.get()), 0));
    const std::size_t length = H5Tget_size(type.get());
    require_plausible(object, length > 0 && number > SIZE_MAX / length ? SIZE_MAX : number * length);
    if (H5Tis_variable_str(type.get()) > 0) {
        std::vector<char*> pointers(number, nullptr);
        if (read(type.get(), pointers.data()) < 0) {
            fail(object, "cannot be read: the file is damaged");
        }
        for (const char* pointer : pointers) {
            texts.emplace_back(pointer == nullptr ? "" : pointer);
        }
        H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, pointers.data());
    } else {
        std::vector<char> characters(number * length);
        if (read(type.get(), characters.data()) < 0) {
            fail(object, "cannot be read: the file is damaged");
        }
        const bool blanks_fill = H5Tget_strpad(type.get()) == H5T_STR_SPACEPAD;
        for (std::size_t i = 0; i < number; ++i) {
            const std::string padded(characters.data() + i * length, length);
            const std::string text = padded.substr(0, padded.find('\0'));
            texts.push_back(blanks_fill ? text.substr(0, text.find_last_not_of(' ') + 1) : text);
        }
    }
    for (const std::string& text : texts) {
        require_text(object, text);
    }
    return texts;
}

void File::require_text(const std::string& object, const std::string& text) const {
    if (!is_utf8(text)) {
        fail(object, "holds a text that is not UTF-8: the file is damaged");
    }
}

std::string File::read_text(const std::string& dataset) const {
    const Handle opened = open_dataset(dataset);
    const Handle type(H5Dget_type(opened.get()), H5Tclose);
    const Handle space(H5Dget_space(opened.get()), H5Sclose);
    const auto texts = read_texts(dataset, type, space, [&](hid_t memory, void* buffer) {
        return H5Dread(opened.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
    });
    if (texts.size() != 1) {
        fail(dataset, "is not a text");
    }
    return texts[0];
}

std::vector<std::string> File::read_text_list(const std::string& dataset) const {
    const Handle opened = open_dataset(dataset);
    const Handle type(H5Dget_type(opened.get()), H5Tclose);
    const Handle space(H5Dget_space(opened.get()), H5Sclose);
    return read_texts(dataset, type, space, [&](hid_t memory, void* buffer) {
        return H5Dread(opened.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
    });
}

std::vector<std::string> File::attribute_names(const std::string& object) const {
    const Handle opened = open_object(object);
    const int number = opened ? std::max(H5Aget_num_attrs(opened.get()), 0) : 0;
    std::vector<std::string> names;
    for (int k = 0; k < number; ++k) {
        const auto place = static_cast<hsize_t>(k);
        const ssize_t length = H5Aget_name_by_idx(opened.get(), ".", H5_INDEX_NAME, H5_ITER_INC, place, nullptr, 0, H5P_DEFAULT);
        std::string name(static_cast<std::size_t>(std::max<ssize_t>(length, 0)), '\0');
        H5Aget_name_by_idx(opened.get(), ".", H5_INDEX_NAME, H5_ITER_INC, place, name.data(), name.size() + 1, H5P_DEFAULT);
        names.push_back(std::move(name));
    }
    return names;
}

std::vector<std::string> File::texts_attribute(const std::string& object, const std::string& name) const {
    const Handle opened = open_object(object);
    const htri_t exists = opened ? H5Aexists(opened.get(), name.c_str()) : 0;
    if (exists == 0) {
        return {};
    }
    const Handle attribute(exists > 0 ? H5Aopen(opened.get(), name.c_str(), H5P_DEFAULT) : H5I_INVALID_HID, H5Aclose);
    if (!attribute) {
        fail(object + " attribute " + name, "cannot be read: the file is damaged");
    }
    const Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    return read_texts(object + " attribute " + name, type, space,
                      [&](hid_t memory, void* buffer) { return H5Aread(attribute.get(), memory, buffer); });
}

std::string File::attribute(const std::string& object, const std::string& name) const {
    const auto texts = texts_attribute(object, name);
    return texts.size() == 1 ? texts[0] : "";
}

}  // namespace coagula::io::hdf5
