// SPDX-License-Identifier: GPL-3.0-or-later
// Rows and samples that no law of the errors makes: a slipped decimal point, a bubble, a sample that slid.
#pragma once

#include <coagula/diagnose/measurement.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace coagula::diagnose {

struct Outlier {
    std::size_t measurement;         ///< from 0
    std::optional<std::size_t> row;  ///< from 0; none: the whole sample, of which this is one table
    double factor;                   ///< value over what neighbours or the other samples say
    std::string size;                ///< the same in words: "3.2 times as large as"
};

/// Leaves out, with a reason, the moduli of
/// - a row that lies beside both of its neighbours to the same side, and beside the same row of the other samples where three or
///   more were measured alike, by more than eight robust standard deviations and a fifth; likewise the first row that was measured
///   where it lies above the next one by more than a factor of three, and by more than four times as much as these by each other;
/// - every table of a sample whose level lies beside that of two or more others by more than six times their scatter, or the tenth
///   by which samples may differ.
/// A difference between two samples is attributed to neither of them.
std::vector<Outlier> leave_out_outliers(std::vector<Measurement>& tables);

}  // namespace coagula::diagnose
