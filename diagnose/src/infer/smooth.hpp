// SPDX-License-Identifier: GPL-3.0-or-later
// Smooth departures from a prediction: Gaussian processes of one or both moduli along one coordinate, the sum of two of these, or
// one along all coordinates together, in proportion to |G*|; a correlation length is a part of the range of a coordinate, which is
// taken as a rank.
#pragma once

#include "detection.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace coagula::diagnose {

/// Standard deviations over |G*|, and lengths over the range, that are equally probable.
inline constexpr std::array smooth_amplitudes{0.03, 0.15, 0.75};
inline constexpr std::array smooth_lengths{0.2, 0.7};

/// Observable of a deviation.
enum class Departing { storage, loss, both };

/// A smooth departure of unit size: of which moduli, and along which coordinates, as the sum of a part along each or along all
/// together.
struct SmoothDeparture {
    Departing departing;
    std::vector<Coordinate> along;  ///< none: the level
    Eigen::MatrixXd factor;         ///< columns U with U U^T = its covariance over |G*|, as far as a ten-thousandth of it
};

/// Ranks 0 .. 1 of a coordinate among its values; 0 where it is unknown or does not vary.
Eigen::VectorXd rank_along(const std::vector<Observation>& observations, Coordinate coordinate);
/// The same among any values, NaN where one is unknown.
Eigen::VectorXd ranks_of(const std::vector<double>& values);
/// Whether two ranks rise and fall together, so that a function of one is one of the other.
bool run_together(const Eigen::VectorXd& one, const Eigen::VectorXd& other);

/// Columns U with U U^T = the covariance of a departure of unit size, as far as a ten-thousandth of it: smooth along these ranks,
/// the same everywhere where there are none. None where nothing departs.
/// @param together the product of the correlations along all ranks, else their mean.
Eigen::MatrixXd smooth_factor(const std::vector<Observation>& observations, Departing departing, std::vector<Eigen::VectorXd> ranks,
                              bool together, double length);

/// In groups that are equally probable, of every length; the level alone where no coordinate varies.
using SmoothDepartures = std::vector<std::vector<SmoothDeparture>>;
SmoothDepartures smooth_departures(const std::vector<Observation>& observations);

}  // namespace coagula::diagnose
