// SPDX-License-Identifier: GPL-3.0-or-later
// Chords: the pieces that straight lines have in the void space and in the spheres.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct ChordOptions {
    Index lines = 3000;  ///< along each axis, >= 1: on a shifted lattice across the box
    Index bins = 100;    ///< of the distributions
};

/// Chords of one phase along lines parallel to the axes of a periodic box. Each line closes upon itself, so that no chord is cut
/// off; chords along each line are exact.
struct ChordDistribution {
    Eigen::VectorXd length;        ///< middle of each bin [m]
    Eigen::VectorXd density;       ///< probability density of the length of a chord [1/m]
    double mean = unset;           ///< [m]; 4 phi / s for isotropic structures (s: surface per volume of the box)
    double mean_stderr = unset;    ///< from groups of neighbouring lines, for structures of one void fraction
    double second_moment = unset;  ///< mean of the square [m^2]
    double second_moment_stderr = unset;
    Eigen::Vector3d mean_by_axis;  ///< along x, y, z [m]: differences are anisotropy
    Eigen::Vector3d stderr_by_axis;
    Index chords = 0;
};

struct ChordLengths {
    ChordDistribution voids;
    ChordDistribution solid;       ///< through unions of overlapping spheres
    double void_fraction = unset;  ///< of the length of the lines: a check
    double void_fraction_stderr = unset;
};

/// Source: Torquato and Lu, Phys. Rev. E 47 (1993) 2950. Throws std::invalid_argument for an open packing, and if no line meets
/// both phases.
ChordLengths measure_chord_lengths(const Packing& packing, const ChordOptions& options = {}, const Progress& progress = {});

}  // namespace coagula::characterize
