// SPDX-License-Identifier: GPL-3.0-or-later
// Relations that must hold between the columns of a table, such as that of stress, strain and modulus. The check of data asks in
// which rows they fail, and which cell is wrong there.
#pragma once

#include <coagula/diagnose/check_data.hpp>

#include <functional>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// A quantity that can be computed from the columns in two ways, which must agree.
struct Relation {
    /// The values of `columns` in a row, in their order.
    using Cells = std::vector<double>;

    std::string name;
    std::vector<const Column*> columns;
    /// The column that only repeats the others; null where all of them are measured.
    const Column* redundant;
    /// One way divided by the other.
    std::function<double(const Cells&)> ratio;
    /// Largest |ln ratio|.
    std::function<double(const Cells&)> tolerance;
    /// Where it fails, the redundant column alone is doubted: a torque that also turns the tool says nothing against moduli that
    /// were corrected for its inertia.
    bool is_of_raw_torque() const { return redundant != nullptr && redundant->name == "torque"; }

    Cells cells(std::size_t row) const;
    bool readable(std::size_t row) const;
    bool holds(const Cells& values) const;
    /// Whether the relation holds in this row and would not if the cell of that column were off by a factor of two: then the cell
    /// is right unless others are wrong in just the way that hides it.
    bool vouches_for(std::size_t column, std::size_t row) const;
};

/// The relations between the columns that this table has. They hold pointers into it.
std::vector<Relation> relations_of(const Measurement& measurement, const DataCheckOptions& options);

}  // namespace coagula::diagnose
