// SPDX-License-Identifier: GPL-3.0-or-later
// A thin layer over the HDF5 C API: handles that close themselves, typed arrays, attributes, sentences instead of error stacks.
#pragma once

#include "file_image.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace coagula::io::hdf5 {

using Shape = std::vector<std::size_t>;

/// An HDF5 identifier that is closed at the end of its life.
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        Handle old(std::move(*this));
        id_ = std::exchange(other.id_, H5I_INVALID_HID);
        close_ = other.close_;
        return *this;
    }
    ~Handle() {
        if (id_ >= 0) {
            close_(id_);
        }
    }
    hid_t get() const { return id_; }
    explicit operator bool() const { return id_ >= 0; }

private:
    hid_t id_ = H5I_INVALID_HID;
    Close close_ = nullptr;
};

/// Keeps HDF5 from printing its error stack, for good: what it would say is said in sentences.
void silence_errors();

/// The type of a number in memory and (little endian) in the file.
template <class T>
struct NumberType;
template <>
struct NumberType<double> {
    static hid_t memory() { return H5T_NATIVE_DOUBLE; }
    static hid_t file() { return H5T_IEEE_F64LE; }
};
template <>
struct NumberType<float> {
    static hid_t memory() { return H5T_NATIVE_FLOAT; }
    static hid_t file() { return H5T_IEEE_F32LE; }
};
template <>
struct NumberType<std::int64_t> {
    static hid_t memory() { return H5T_NATIVE_INT64; }
    static hid_t file() { return H5T_STD_I64LE; }
};
template <>
struct NumberType<std::int32_t> {
    static hid_t memory() { return H5T_NATIVE_INT32; }
    static hid_t file() { return H5T_STD_I32LE; }
};
template <>
struct NumberType<std::uint8_t> {
    static hid_t memory() { return H5T_NATIVE_UINT8; }
    static hid_t file() { return H5T_STD_U8LE; }
};

/// What a dataset holds, as far as coagula reads it.
enum class Content { real, integer, text, other };

/// An open file. What cannot be read throws InputError ("FILE: OBJECT rule"); a new file is built in memory, so that neither a full
/// disk nor an interruption can leave a part of it behind, and is written as a whole; one that is too large for that, in a hidden
/// file.
class File {
public:
    /// Opens and inspects a file. HDF5 crashes on some damaged files, so this belongs into run_in_child.
    static File open(const std::string& path);
    /// Opens a file that this program has made and nobody else changes: it is read at once and not inspected.
    static File open_own(const std::string& path);
    /// @param descriptor of an empty file that is to hold it, which must stay open; none: memory.
    static File create(const std::string& path, int descriptor = -1);

    /// Closes a created file; its bytes, which last as long as this object.
    std::span<const char> close();
    /// Throws std::runtime_error ("cannot write FILE: reason") where there was no room for what was written.
    void require_room() const;

    [[noreturn]] void fail(const std::string& object, const std::string& rule) const;

    const std::string& path() const { return path_; }
    bool has(const std::string& object) const;
    bool is_group(const std::string& object) const;
    bool is_dataset(const std::string& object) const;
    /// Names of the links of a group, sorted.
    std::vector<std::string> children(const std::string& group) const;
    /// Calls `visit` with the path of every dataset at or below an object, sorted.
    void for_each_dataset(const std::string& object, const std::function<void(const std::string&)>& visit) const;
    std::vector<std::string> datasets_below(const std::string& object) const;

    Content content(const std::string& dataset) const;
    Shape shape(const std::string& dataset) const;
    template <class T>
    std::vector<T> read(const std::string& dataset) const {
        const Handle opened = open_dataset(dataset);
        std::vector<T> values(count(shape_of(opened, dataset)));
        read_numbers(opened, dataset, NumberType<T>::memory(), values.data(), Handle());
        return values;
    }
    /// The last slice along the first axis.
    template <class T>
    std::vector<T> read_last(const std::string& dataset) const {
        const Handle opened = open_dataset(dataset);
        Shape slice = shape_of(opened, dataset);
        const std::size_t frames = slice.at(0);
        slice[0] = 1;
        std::vector<T> values(count(slice));
        read_numbers(opened, dataset, NumberType<T>::memory(), values.data(), slice_of(opened, frames - 1));
        return values;
    }
    std::string read_text(const std::string& dataset) const;
    /// A list of texts.
    std::vector<std::string> read_text_list(const std::string& dataset) const;
    /// The text of an attribute; empty when there is none (or none that is text).
    std::string attribute(const std::string& object, const std::string& name) const;
    std::vector<std::string> texts_attribute(const std::string& object, const std::string& name) const;

    void create_group(const std::string& group);
    /// Writes numbers, replacing what was there; groups on the way are made. Arrays over 1 kB are chunked, shuffled and deflated.
    template <class T>
    void write(const std::string& dataset, const Shape& shape, const T* values) {
        write_numbers(dataset, shape, NumberType<T>::file(), NumberType<T>::memory(), values);
    }
    void write_text(const std::string& dataset, const std::string& text);
    /// Writes a list of texts, each with the length of the longest.
    void write_text_list(const std::string& dataset, const std::vector<std::string>& texts);
    void describe(const std::string& object, const std::string& unit, const std::string& description);
    /// Texts have a fixed length. Below /h5md and /particles the length is variable: MDAnalysis compares these with Python texts,
    /// and h5py makes byte strings of those of fixed length.
    void set_attribute(const std::string& object, const std::string& name, const std::string& text);
    void set_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& texts);
    /// Small vectors; one value without brackets is a scalar.
    void set_attribute(const std::string& object, const std::string& name, std::int64_t value);
    void set_attribute(const std::string& object, const std::string& name, const std::vector<std::int64_t>& values);
    void set_reference(const std::string& object, const std::string& name, const std::string& referred);
    void link(const std::string& existing, const std::string& name);
    void remove(const std::string& object);
    /// Everything in `source`, or in a group of it: groups, links, references and attributes of the root.
    void copy_all_from(const File& source, const std::string& group = "/");
    /// Copies a group of `source` into this file, under a name that nothing has.
    void copy_group_from(const File& source, const std::string& group, const std::string& name);
    std::vector<std::string> attribute_names(const std::string& object) const;

    static std::size_t count(const Shape& shape);

private:
    File(std::string path, std::unique_ptr<FileImage> image, Handle id)
        : path_(std::move(path)), image_(std::move(image)), id_(std::move(id)) {}
    static File opened(const std::string& path, const Handle& access);
    void inspect() const;
    void require_plausible(const std::string& object, std::size_t bytes) const;
    void require_text(const std::string& object, const std::string& text) const;
    template <class Read>
    std::vector<std::string> read_texts(const std::string& object, const Handle& type, const Handle& space, Read&& read) const;
    void make_room(const std::string& object);
    Handle open_object(const std::string& object) const;
    void keep_open(const std::string& object, Handle opened) const;
    Handle open_dataset(const std::string& dataset) const;
    Shape shape_of(const Handle& opened, const std::string& dataset) const;
    static Handle slice_of(const Handle& opened, std::size_t frame);
    void read_numbers(const Handle& opened, const std::string& dataset, hid_t memory_type, void* values, const Handle& slice) const;
    void write_numbers(const std::string& dataset, const Shape& shape, hid_t file_type, hid_t memory_type, const void* values);
    void write_attribute(const std::string& object, const std::string& name, hid_t type, const Handle& space, const void* values);

    std::string path_;
    std::size_t length_ = 0;            ///< of an opened file [byte]
    std::unique_ptr<FileImage> image_;  ///< of a created file; outlives the handle
    Handle id_;
    mutable std::string last_name_;
    mutable Handle last_;     ///< the object that was opened or made last, as one asks for its parts one after another
    std::string last_group_;  ///< that was made or found last
};

}  // namespace coagula::io::hdf5
