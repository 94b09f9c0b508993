// SPDX-License-Identifier: GPL-3.0-or-later
// The half of hdf5::File that writes.
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "hdf5_file.hpp"
#include "layout.hpp"

namespace coagula::io::hdf5 {

namespace {

// The callbacks by which HDF5 handles the memory of a file that lies there. They leave it behind when the file is closed.

void* allocate_image(std::size_t size, H5FD_file_image_op_t /*why*/, void* image) {
    return static_cast<FileImage*>(image)->resize(size);
}

void* copy_image(void* to, const void* from, std::size_t size, H5FD_file_image_op_t /*why*/, void* /*image*/) {
    return std::memcpy(to, from, size);
}

void* resize_image(void* /*memory*/, std::size_t size, H5FD_file_image_op_t /*why*/, void* image) {
    return static_cast<FileImage*>(image)->resize(size);
}

herr_t leave_image(void* /*memory*/, H5FD_file_image_op_t /*why*/, void* /*image*/) {
    return 0;
}

void* share_image(void* image) {
    return image;
}

herr_t forget_image(void* /*image*/) {
    return 0;
}

Handle file_access_in_memory(FileImage& image) {
    constexpr std::size_t growth = std::size_t{1} << 20;
    Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(properties.get(), growth, false);
    H5Pset_libver_bounds(properties.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);  // object headers carry checksums
    H5FD_file_image_callbacks_t callbacks{allocate_image, copy_image, resize_image, leave_image, share_image, forget_image, &image};
    H5Pset_file_image_callbacks(properties.get(), &callbacks);
    return properties;
}

/// A new text type; H5T_VARIABLE or a length in bytes.
Handle text_type(std::size_t length) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), length);
    if (length != H5T_VARIABLE) {
        H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    }
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    return type;
}

/// HDF5 has no texts of length zero.
Handle fixed_text_type(const std::string& text) {
    return text_type(std::max<std::size_t>(text.size(), 1));
}

bool is_read_as_python_text(const std::string& object) {
    return object.starts_with(layout::metadata) || object.starts_with(layout::particles);
}

Handle scalar_space() {
    return {H5Screate(H5S_SCALAR), H5Sclose};
}

Handle array_space(const Shape& shape) {
    if (shape.empty()) {
        return scalar_space();
    }
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    return {H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose};
}

/// No time stamps, so that equal values give equal bytes; arrays over 1 kB in compressed chunks of at most 1 MB or so.
Handle creation_properties(const Shape& shape, std::size_t value_size) {
    constexpr std::size_t smallest_compressed = 1024;
    constexpr std::size_t largest_chunk = std::size_t{1} << 20;
    Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties.get(), false);
    const std::size_t bytes = File::count(shape) * value_size;
    if (shape.empty() || bytes <= smallest_compressed) {
        return properties;
    }
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    for (std::size_t axis = 0, size = bytes; axis < chunk.size() && size > largest_chunk; ++axis) {
        const std::size_t slice = size / chunk[axis];
        chunk[axis] = std::max<std::size_t>(1, largest_chunk / slice);
        size = slice * chunk[axis];
    }
    H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), 4);
    return properties;
}

Handle group_creation() {
    Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(properties.get(), false);
    return properties;
}

/// Copies what is attached to one object to another one of the same file.
void copy_attributes(const Handle& from, const Handle& to) {
    const int number = std::max(H5Aget_num_attrs(from.get()), 0);
    for (int i = 0; i < number; ++i) {
        const Handle source(
            H5Aopen_by_idx(from.get(), ".", H5_INDEX_NAME, H5_ITER_INC, static_cast<hsize_t>(i), H5P_DEFAULT, H5P_DEFAULT),
            H5Aclose);
        const Handle type(H5Aget_type(source.get()), H5Tclose);
        const Handle space(H5Aget_space(source.get()), H5Sclose);
        std::vector<char> name(static_cast<std::size_t>(H5Aget_name(source.get(), 0, nullptr)) + 1);
        H5Aget_name(source.get(), name.size(), name.data());
        std::vector<char> values(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.get()), 0)) *
                                 H5Tget_size(type.get()));
        const Handle copy(H5Acreate2(to.get(), name.data(), type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
        if (copy && !values.empty() && H5Aread(source.get(), type.get(), values.data()) >= 0) {
            H5Awrite(copy.get(), type.get(), values.data());
            H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, values.data());
        }
    }
}

void require_written(bool done, const std::string& path, const std::string& object) {
    if (!done) {
        throw std::runtime_error("cannot write " + path + ": HDF5 refuses " + object);
    }
}

}  // namespace

File File::create(const std::string& path, int descriptor) {
    silence_errors();
    auto image = std::make_unique<FileImage>(descriptor);
    const Handle access = file_access_in_memory(*image);
    const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation.get(), false);
    Handle id(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
    File file(path, std::move(image), std::move(id));
    file.require_room();
    require_written(static_cast<bool>(file.id_), path, "a new file");
    file.length_ = SIZE_MAX;  // what is read from it was written here
    return file;
}

void File::require_room() const {
    if (image_->error() != 0) {
        throw std::runtime_error("cannot write " + path_ + ": " + std::generic_category().message(image_->error()));
    }
}

std::span<const char> File::close() {
    last_ = Handle();
    require_written(H5Fflush(id_.get(), H5F_SCOPE_GLOBAL) >= 0, path_, "to flush");
    id_ = Handle();
    require_room();
    require_written(image_->data() != nullptr, path_, "to close");
    // The end of the file by its superblock (HDF5 File Format Specification, version 2: bytes 28 to 35); the memory is larger.
    // H5Fget_file_image is of no use: the superblock that it gives has a wrong checksum in HDF5 1.10.
    std::uint64_t size = 0;
    std::memcpy(&size, image_->data() + 28, sizeof size);
    return {image_->data(), size};
}

void File::create_group(const std::string& group) {
    if (group.empty() || group == last_group_) {
        return;
    }
    if (!has(group)) {
        create_group(group.substr(0, group.rfind('/')));
        const Handle created(H5Gcreate2(id_.get(), group.c_str(), H5P_DEFAULT, group_creation().get(), H5P_DEFAULT), H5Gclose);
        require_written(static_cast<bool>(created), path_, group);
    }
    last_group_ = group;
}

/// Removes what bears the name and makes the groups on the way to it. (HDF5 would make them, too, but with time stamps.)
void File::make_room(const std::string& object) {
    create_group(object.substr(0, object.rfind('/')));
    if (H5Lexists(id_.get(), object.c_str(), H5P_DEFAULT) > 0) {
        remove(object);
    }
}

void File::write_numbers(const std::string& dataset, const Shape& shape, hid_t file_type, hid_t memory_type, const void* values) {
    make_room(dataset);
    Handle created(H5Dcreate2(id_.get(), dataset.c_str(), file_type, array_space(shape).get(), H5P_DEFAULT,
                              creation_properties(shape, H5Tget_size(file_type)).get(), H5P_DEFAULT),
                   H5Dclose);
    require_written(
        created && (count(shape) == 0 || H5Dwrite(created.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0), path_,
        dataset);
    keep_open(dataset, std::move(created));
}

void File::write_text(const std::string& dataset, const std::string& text) {
    make_room(dataset);
    const Handle type = fixed_text_type(text);
    Handle created(H5Dcreate2(id_.get(), dataset.c_str(), type.get(), scalar_space().get(), H5P_DEFAULT,
                              creation_properties({}, 1).get(), H5P_DEFAULT),
                   H5Dclose);
    require_written(created && H5Dwrite(created.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) >= 0, path_,
                    dataset);
    keep_open(dataset, std::move(created));
}

void File::write_attribute(const std::string& object, const std::string& name, hid_t type, const Handle& space,
                           const void* values) {
    const Handle opened = open_object(object);
    if (H5Aexists(opened.get(), name.c_str()) > 0) {
        H5Adelete(opened.get(), name.c_str());
    }
    const Handle attribute(H5Acreate2(opened.get(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    require_written(attribute && H5Awrite(attribute.get(), type, values) >= 0, path_, object + " attribute " + name);
}

void File::describe(const std::string& object, const std::string& unit, const std::string& description) {
    set_attribute(object, "unit", unit);
    set_attribute(object, "description", description);
}

void File::set_attribute(const std::string& object, const std::string& name, const std::string& text) {
    if (is_read_as_python_text(object)) {
        const char* pointer = text.c_str();
        write_attribute(object, name, text_type(H5T_VARIABLE).get(), scalar_space(), static_cast<const void*>(&pointer));
    } else {
        write_attribute(object, name, fixed_text_type(text).get(), scalar_space(), text.c_str());
    }
}

void File::set_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& texts) {
    std::vector<const char*> pointers;
    std::transform(texts.begin(), texts.end(), std::back_inserter(pointers), [](const std::string& text) { return text.c_str(); });
    write_attribute(object, name, text_type(H5T_VARIABLE).get(), array_space({texts.size()}), pointers.data());
}

void File::set_attribute(const std::string& object, const std::string& name, std::int64_t value) {
    write_attribute(object, name, H5T_NATIVE_INT64, scalar_space(), &value);
}

void File::set_attribute(const std::string& object, const std::string& name, const std::vector<std::int64_t>& values) {
    write_attribute(object, name, H5T_NATIVE_INT64, array_space({values.size()}), values.data());
}

void File::set_reference(const std::string& object, const std::string& name, const std::string& referred) {
    hobj_ref_t reference{};
    require_written(H5Rcreate(&reference, id_.get(), referred.c_str(), H5R_OBJECT, H5I_INVALID_HID) >= 0, path_, referred);
    write_attribute(object, name, H5T_STD_REF_OBJ, scalar_space(), &reference);
}

void File::link(const std::string& existing, const std::string& name) {
    make_room(name);
    require_written(H5Lcreate_hard(id_.get(), existing.c_str(), id_.get(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0, path_,
                    name);
}

void File::remove(const std::string& object) {
    last_ = Handle();
    last_group_.clear();
    require_written(!has(object) || H5Ldelete(id_.get(), object.c_str(), H5P_DEFAULT) >= 0, path_, object);
}

void File::write_text_list(const std::string& dataset, const std::vector<std::string>& texts) {
    std::size_t length = 1;
    for (const std::string& text : texts) {
        length = std::max(length, text.size());
    }
    std::string characters(length * texts.size(), '\0');
    for (std::size_t k = 0; k < texts.size(); ++k) {
        characters.replace(k * length, texts[k].size(), texts[k]);
    }
    make_room(dataset);
    const Handle type = text_type(length);
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    const Handle written(H5Dcreate(id_.get(), dataset.c_str(), type.get(), array_space({texts.size()}).get(), links.get(),
                                   creation_properties({texts.size()}, length).get(), H5P_DEFAULT),
                         H5Dclose);
    require_written(written && H5Dwrite(written.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, characters.data()) >= 0, path_,
                    dataset);
}

void File::copy_group_from(const File& source, const std::string& group, const std::string& name) {
    make_room(name);
    const std::vector<std::string> before = children("/");
    const Handle properties(H5Pcreate(H5P_OBJECT_COPY), H5Pclose);
    H5Pset_copy_object(properties.get(), H5O_COPY_EXPAND_REFERENCE_FLAG);
    if (H5Ocopy(source.id_.get(), group.c_str(), id_.get(), name.c_str(), properties.get(), H5P_DEFAULT) < 0) {
        source.fail(group, "cannot be copied: the file is damaged");
    }
    for (const std::string& other : children("/")) {
        if (("/" + other != name) && std::find(before.begin(), before.end(), other) == before.end()) {
            remove("/" + other);  // H5Ocopy gives every object that a reference points to a second name, "~obj_pointed_by_..."
        }
    }
}

void File::copy_all_from(const File& source, const std::string& group) {
    const std::string staging = "/.copy";
    const std::string staged = staging + '/';
    copy_group_from(source, group, staging);
    for (const std::string& name : children(staging)) {
        const std::string from = staged + name;
        require_written(H5Lmove(id_.get(), from.c_str(), id_.get(), ("/" + name).c_str(), H5P_DEFAULT, H5P_DEFAULT) >= 0, path_,
                        name);
    }
    copy_attributes(open_object(staging), open_object("/"));
    remove(staging);
}

}  // namespace coagula::io::hdf5
