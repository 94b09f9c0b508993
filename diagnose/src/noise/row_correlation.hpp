// SPDX-License-Identifier: GPL-3.0-or-later
// Correlation of neighbouring errors, from the rows themselves and from prior knowledge.
#pragma once

#include "data_set.hpp"

#include <Eigen/Core>

#include <array>

namespace coagula::diagnose {

struct RowCorrelation {
    double mean;
    double deviation;  ///< standard error
};

/// Correlations of torque and of phase.
using RowCorrelations = std::array<RowCorrelation, 2>;

/// Correlations that the departures of the data from a fitted model show, torque and phase apart. Departures are freed from all
/// that a cubic in the place of the row can follow, so that a smooth effect does not count as correlation: restricted
/// likelihood (Patterson and Thompson 1971) of a first-order autoregression, whatever the size of the errors, times the normal
/// density of what is known beforehand, over 0 .. 0.9. Where the departures are larger than the errors are known to be, the model
/// fails, and they count by the share that errors make. Tables of fewer than eight rows say nothing. Zero where no row's
/// correlation is uncertain.
RowCorrelations correlations_shown(const DataSet& data, const Eigen::VectorXd& departures);

/// Takes these for rows whose correlation is uncertain.
void set_correlations(const RowCorrelations& correlations, DataSet& data);

}  // namespace coagula::diagnose
