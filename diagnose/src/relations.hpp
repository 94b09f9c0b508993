// Columns of one table that repeat each other.
#pragma once

#include <coagula/diagnose/check_data.hpp>

#include <functional>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// A quantity that two ways to compute it must give alike.
struct Relation {
    std::string name;
    std::vector<const Column*> columns;
    /// The column that only repeats the others; null where all of them are measured.
    const Column* redundant;
    /// One way divided by the other in a row.
    std::function<double(std::size_t row)> ratio;
    /// Largest |ln ratio| in a row.
    std::function<double(std::size_t row)> tolerance;

    bool readable(std::size_t row) const;
    bool holds(std::size_t row) const;
};

/// The relations between the columns that this table has. They hold pointers into it.
std::vector<Relation> relations_of(const Measurement& measurement, const DataCheckOptions& options);

}  // namespace coagula::diagnose
