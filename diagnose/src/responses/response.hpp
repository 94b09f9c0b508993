// SPDX-License-Identifier: GPL-3.0-or-later
// What acts in the network besides its springs: one declaration for each, which the chain reads.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <span>

namespace coagula::diagnose {

/// Conditions of a measured oscillation; NaN where they are not known.
struct Conditions {
    double strain = unset;             ///< amplitude
    double angular_frequency = unset;  ///< [rad/s]
    std::size_t group = 0;             ///< of the structures
};

/// What so few structures leave open in a response R, as independent standard errors.
struct Scatter {
    Eigen::RowVectorXcd relative = {};     ///< each adds this part of R
    Eigen::RowVectorXcd logarithmic = {};  ///< each adds this to the logarithm of R - 1 ...
    std::complex<double> expected = 0;     ///< ... and so much is added to it in the mean
};

/// A factor on the linear modulus.
struct Response {
    bool (*acts)(const Settings& settings, const Conditions& at) = nullptr;
    /// @param exact run the solver at the settings themselves instead of between the nodes of a grid.
    std::complex<double> (*factor)(Simulator& simulator, const Settings& settings, const Conditions& at, bool exact) = nullptr;
    Scatter (*scatter)(Simulator& simulator, const Settings& settings, const Conditions& at) = nullptr;  ///< null: known
    double (*degrees)(Simulator& simulator) = nullptr;  ///< of freedom from which the scale of the scatter is known
    bool follows_strain = false;                        ///< else conditions that differ by their strain alone give the same
};

/// All of them, in the order in which they multiply the linear modulus. Breaking bonds are none, as they remember the strains
/// before. At most one has a logarithmic scatter.
std::span<const Response> network_responses();

}  // namespace coagula::diagnose
