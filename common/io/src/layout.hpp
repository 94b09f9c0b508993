// SPDX-License-Identifier: GPL-3.0-or-later
// Where things lie in a structure file, and the lengths as they are stored there.
#pragma once

#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::io::layout {

inline constexpr const char* metadata = "/h5md";
inline constexpr const char* particles = "/particles";
inline constexpr const char* trajectory = "/particles/trajectory";
inline constexpr const char* connectivity = "/connectivity";
inline constexpr const char* mechanics = "/mechanics";
inline constexpr const char* bonds = "/connectivity/bonds";
inline constexpr const char* branch_vectors = "/connectivity/branch_vectors";
inline constexpr const char* view = "/VTKHDF";
inline constexpr const char* provenance = "/provenance";
inline constexpr const char* format_of_sets = "coagula data set";  ///< the attribute format of a data set

/// MDAnalysis refuses metres, so the group /particles is in nanometres. Reading divides by the same number: then storing what was
/// read gives the stored value again, bit for bit.
inline constexpr double nanometres = 1e9;

/// Positions [nm] as the file holds them: inside the half-open periodic box also after rounding.
Eigen::Matrix3Xd stored_positions(const Packing& packing);

}  // namespace coagula::io::layout
