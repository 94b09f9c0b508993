// SPDX-License-Identifier: GPL-3.0-or-later
// Values as bytes, to bring them from one process to another of the same program.
#pragma once

#include <coagula/io/structure_file.hpp>

#include <array>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace coagula::io {

/// Appends values to bytes. What it packs, Unpacker gives back in the same order.
class Packer {
public:
    template <class... Values>
    void operator()(const Values&... values) {
        (put(values), ...);
    }
    std::string take() { return std::move(bytes_); }

private:
    void put_raw(const void* values, std::size_t size) { bytes_.append(static_cast<const char*>(values), size); }

    template <class T>
    requires std::is_arithmetic_v<T>
    void put(T value) { put_raw(&value, sizeof value); }
    void put(const std::string& text) {
        put(text.size());
        put_raw(text.data(), text.size());
    }
    template <class T>
    void put(const std::vector<T>& values) {
        put(values.size());
        if constexpr (std::is_arithmetic_v<T>) {
            put_raw(values.data(), values.size() * sizeof(T));
        } else {
            for (const T& value : values) {
                put(value);
            }
        }
    }
    template <class T, int Rows, int Columns>
    void put(const Eigen::Matrix<T, Rows, Columns>& matrix) {
        (*this)(matrix.rows(), matrix.cols());
        put_raw(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(T));
    }
    template <class T, std::size_t count>
    void put(const std::array<T, count>& values) {
        for (const T& value : values) {
            put(value);
        }
    }
    template <class T>
    void put(const std::optional<T>& value) {
        put(value.has_value());
        if (value) {
            put(*value);
        }
    }
    template <class... Types>
    void put(const std::variant<Types...>& value) {
        put(value.index());
        std::visit([&](const auto& held) { put(held); }, value);
    }
    void put(const Cell& cell) { (*this)(cell.origin(), cell.edges(), cell.periodicity()); }
    void put(const ContactNetwork& bonds) { (*this)(bonds.particles, bonds.ends, bonds.branch); }
    void put(const Frame& frame) { (*this)(frame.time, frame.positions); }
    void put(const Structure& found) {
        (*this)(found.packing.cell, found.packing.positions, found.packing.radii, found.bonds, found.earlier, found.time);
    }
    void put(const Dataset& dataset) { (*this)(dataset.path, dataset.shape, dataset.values, dataset.unit, dataset.description); }

    std::string bytes_;
};

/// Takes values from bytes; throws std::runtime_error where there are too few.
class Unpacker {
public:
    explicit Unpacker(std::string bytes) : bytes_(std::move(bytes)) {}
    template <class... Values>
    void operator()(Values&... values) {
        (get(values), ...);
    }
    template <class T>
    T take() {
        T value{};
        get(value);
        return value;
    }

private:
    void require_left(std::size_t count, std::size_t size) const {
        if (count > (bytes_.size() - place_) / size) {
            throw std::runtime_error("a child process sent less than it should");
        }
    }
    void get_raw(void* values, std::size_t count, std::size_t size) {
        require_left(count, size);
        if (count > 0) {
            std::memcpy(values, bytes_.data() + place_, count * size);
        }
        place_ += count * size;
    }

    template <class T>
    requires std::is_arithmetic_v<T>
    void get(T& value) { get_raw(&value, 1, sizeof value); }
    void get(std::string& text) {
        const auto size = take<std::size_t>();
        require_left(size, 1);
        text.resize(size);
        get_raw(text.data(), size, 1);
    }
    template <class T>
    void get(std::vector<T>& values) {
        const auto size = take<std::size_t>();
        if constexpr (std::is_arithmetic_v<T>) {
            require_left(size, sizeof(T));
            values.resize(size);
            get_raw(values.data(), size, sizeof(T));
        } else {
            require_left(size, 1);
            for (std::size_t k = 0; k < size; ++k) {
                get(values.emplace_back());
            }
        }
    }
    template <class T, int Rows, int Columns>
    void get(Eigen::Matrix<T, Rows, Columns>& matrix) {
        const auto rows = take<Eigen::Index>();
        const auto columns = take<Eigen::Index>();
        if (rows < 0 || columns < 0 || (Rows >= 0 && rows != Rows) || (Columns >= 0 && columns != Columns)) {
            throw std::runtime_error("a child process sent a matrix of impossible size");
        }
        const auto size = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
        require_left(size, sizeof(T));
        matrix.resize(rows, columns);
        get_raw(matrix.data(), size, sizeof(T));
    }
    template <class T, std::size_t count>
    void get(std::array<T, count>& values) {
        for (T& value : values) {
            get(value);
        }
    }
    template <class T>
    void get(std::optional<T>& value) {
        if (take<bool>()) {
            get(value.emplace());
        }
    }
    template <class... Types>
    void get(std::variant<Types...>& value) {
        const auto index = take<std::size_t>();
        std::size_t type = 0;
        ((type++ == index ? get(value.template emplace<Types>()) : void()), ...);
    }
    void get(Cell& cell) {
        const auto origin = take<Eigen::Vector3d>();
        const auto edges = take<Eigen::Matrix3d>();
        cell = Cell::of_edges(origin, edges, take<std::array<bool, 3>>());
    }
    void get(ContactNetwork& bonds) { (*this)(bonds.particles, bonds.ends, bonds.branch); }
    void get(Frame& frame) { (*this)(frame.time, frame.positions); }
    void get(Structure& found) {
        (*this)(found.packing.cell, found.packing.positions, found.packing.radii, found.bonds, found.earlier, found.time);
    }
    void get(Dataset& dataset) { (*this)(dataset.path, dataset.shape, dataset.values, dataset.unit, dataset.description); }

    std::string bytes_;
    std::size_t place_ = 0;
};

}  // namespace coagula::io
