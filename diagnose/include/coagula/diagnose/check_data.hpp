// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of measured data before any physics. A cell that fails is listed and left out, never repaired.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <string>
#include <vector>

namespace coagula::diagnose {

struct DataCheckOptions {
    /// Relative misfit that the printed digits and the smoothing of instruments explain: columns that repeat each other agree to a
    /// few parts in a thousand (cement_laos), and a slipped decimal separator is a factor of ten.
    double tolerance = 0.05;
    /// In an amplitude sweep the stress column may be the peak, whereas |G*| belongs to the first harmonic, which is up to 4/pi
    /// times the peak (a rectangular wave, the plastic limit).
    double peak_tolerance = 0.3;
    /// Loss tangents are printed with three decimals.
    double loss_tangent_resolution = 0.001;
    /// Parts of the rows above which what fails is not single cells: the order of the rows, the relation between two columns.
    double most_out_of_order = 0.1;
    double most_failing = 0.5;
    /// Tables of oscillations need the loss modulus only.
    bool liquid = false;
};

/// Check of a relation between columns of a table.
struct RelationResult {
    std::string name;  ///< "|G*| x strain = stress"
    std::size_t rows;  ///< where all its cells are readable
    std::size_t failed;
};

struct CheckedMeasurement {
    Measurement measurement;  ///< failed cells are NaN and listed in `left_out`
    std::vector<RelationResult> relations;
    std::vector<std::string> problems;  ///< sentences; if there are any, the table cannot be used
};

/// Checks one table:
/// - the axis and the columns that its kind requires are there, with SI units, and are not empty;
/// - values are possible (an angular frequency > 0, ...); impossible cells are left out;
/// - the axis of a sweep runs in one direction (time: upwards); cells that break it are left out, many of them are a problem;
/// - columns that repeat each other agree row by row: |G*| x strain amplitude = stress amplitude, G''/G' = tan delta,
///   |G*| = angular frequency x |eta*|, torque proportional to stress, ...; where they do not, the cells are left out that no other
///   relation and no evenly stepped axis vouches for. Rows that all disagree by one factor are a problem of units. A column that
///   only repeats others and contradicts them in most rows is left out; two such columns are a problem: the others are wrong;
/// - no required column is constant, and enough rows are left.
CheckedMeasurement check_data(const Measurement& measurement, const DataCheckOptions& options = {});

}  // namespace coagula::diagnose
