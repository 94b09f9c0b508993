// SPDX-License-Identifier: GPL-3.0-or-later
// Effect of errors of the coordinates on the measures.
#pragma once

#include <coagula/characterize/measure.hpp>

namespace coagula::characterize {

struct PositionNoise {
    Eigen::Vector3d deviation = Eigen::Vector3d::Constant(unset);  ///< standard deviation of a coordinate along x, y, z [m], >= 0
    Index replicas = 4;                                            ///< packings with noise, 2 to 1000
};

/// The packing with independent normal noise added to every coordinate, brought back into a periodic cell.
Packing with_noise(const Packing& packing, const PositionNoise& noise, std::uint64_t seed, std::uint64_t replica);

/// Measures packings with noise and says by how much each scalar moves: "noise/shift/NAME" is the mean change,
/// "noise/shift_error/NAME" its standard error over the replicas. Coordinates that have such an error already have moved their
/// values by about as much, as the change grows with the variance of the noise (the simulation-extrapolation of Cook and Stefanski,
/// J. Am. Stat. Assoc. 89 (1994) 1314): value - change estimates the value without any error. This holds for small changes only.
/// @param measured what `run_measures` found without noise. @param options, only, seed as for that.
MeasureResult measure_noise_shifts(const Packing& packing, const MeasureResult& measured, const PositionNoise& noise,
                                   const std::map<std::string, double>& options, const std::vector<std::string>& only,
                                   std::uint64_t seed, const Progress& progress = {});

}  // namespace coagula::characterize
