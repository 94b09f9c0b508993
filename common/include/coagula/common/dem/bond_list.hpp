// SPDX-License-Identifier: GPL-3.0-or-later
// The simple bonds of a part of space, stored so that several can be computed at a time.
#pragma once

#include <coagula/common/dem/bond_loop.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace coagula::dem {

/// Two slots (see Slots) whose particles may touch.
struct SlotPair {
    std::int32_t first;
    std::int32_t second;
};

/// A bond between two slots and its memory.
struct SlotBond {
    SlotPair ends;
    double rest_length;      ///< centre distance without normal force [m]
    Eigen::Vector3d shear;   ///< shear displacement of second against first at the contact point [m]
    Eigen::Vector3d branch;  ///< centre of second minus centre of first when `shear` was last brought up to date [m]
};

/// Bonds in blocks of four. They are read and written as values.
class BondList {
public:
    /// Reads one bond after the other.
    class Iterator {
    public:
        Iterator(const BondList& list, std::size_t bond) : list_(&list), bond_(bond) {}
        SlotBond operator*() const { return (*list_)[bond_]; }
        Iterator& operator++() {
            ++bond_;
            return *this;
        }
        bool operator==(const Iterator& other) const { return bond_ == other.bond_; }

    private:
        const BondList* list_;
        std::size_t bond_;
    };
    Iterator begin() const { return {*this, 0}; }
    Iterator end() const { return {*this, size_}; }

    std::size_t size() const { return size_; }
    SlotBond operator[](std::size_t bond) const {
        const detail::BondBlock& block = blocks_[bond / width];
        const std::size_t lane = bond % width;
        // NOLINTNEXTLINE(cppcoreguidelines-avoid-c-arrays,modernize-avoid-c-arrays): what the block has
        const auto vector = [lane](const double(&values)[3][width]) {
            return Eigen::Vector3d(values[0][lane], values[1][lane], values[2][lane]);
        };
        return {ends(bond), block.rest_length[lane], vector(block.shear), vector(block.branch)};
    }
    SlotPair ends(std::size_t bond) const {
        const detail::BondBlock& block = blocks_[bond / width];
        const std::size_t lane = bond % width;
        return {block.ends[2 * lane], block.ends[2 * lane + 1]};
    }
    double rest_length(std::size_t bond) const { return blocks_[bond / width].rest_length[bond % width]; }

    void set(std::size_t bond, const SlotBond& value) {
        detail::BondBlock& block = blocks_[bond / width];
        const std::size_t lane = bond % width;
        block.ends[2 * lane] = value.ends.first;
        block.ends[2 * lane + 1] = value.ends.second;
        block.rest_length[lane] = value.rest_length;
        for (int axis = 0; axis < 3; ++axis) {
            block.shear[axis][lane] = value.shear[axis];
            block.branch[axis][lane] = value.branch[axis];
        }
    }
    void push_back(const SlotBond& bond) {
        resize(size_ + 1);
        set(size_ - 1, bond);
    }
    void reserve(std::size_t size) { blocks_.reserve((size + width - 1) / width); }
    void resize(std::size_t size) {
        size_ = size;
        blocks_.resize((size + width - 1) / width);
    }

    detail::BondBlock* blocks() { return blocks_.data(); }

private:
    static constexpr std::size_t width = detail::BondBlock::width;
    std::vector<detail::BondBlock> blocks_;
    std::size_t size_ = 0;
};

}  // namespace coagula::dem
