// SPDX-License-Identifier: GPL-3.0-or-later
// Amplitude sweeps with bonds that break, by the explicit rheometer.
#pragma once

#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include "yield_curves.hpp"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace coagula::diagnose {

/// Modulus G at one amplitude after bonds have broken.
struct Yielded {
    std::complex<double> first;  ///< G* / G in the first oscillation
    double settled = 0;          ///< G' / G in the next one, in which nothing breaks any more
};

/// G* / G in the first oscillation of this amplitude for finite bond strength, where `before` was the largest before on the sample
/// (0: none). A bond breaks once: at an amplitude not above that, nothing is lost any more. That of a large sample as the
/// structures tell it comes first (population_curve.hpp), then the same moved by each of the independent standard errors that so
/// few structures leave; these are missing where there is one structure or nothing breaks.
Eigen::VectorXcd amplitude_response(Simulator& simulator, const Settings& settings, double before, double amplitude);

/// Degrees of freedom from which the common scale of these errors is known.
double yield_degrees(const Simulator& simulator);

/// The mean over the structures alone, by a run at these amplitudes, each larger than the one before.
std::vector<Yielded> exact_amplitude_response(Simulator& simulator, const Settings& settings,
                                              const std::vector<double>& amplitudes);

/// The same run as a curve, for parts of the sample whose strains lie between. Where amplitudes are far from each other, there are
/// more nodes.
YieldCurves exact_yield_curve(Simulator& simulator, const Settings& settings, const std::vector<double>& amplitudes);

/// G' / G of bonds that break while the strain amplitude x sin(phase) runs for the first time, `before` being the largest before:
/// in each quarter of that oscillation where |sin(phase)| is `sine`.
std::array<double, 4> storage_in_quarters(Simulator& simulator, const Settings& settings, double before, double amplitude,
                                          double sine);

}  // namespace coagula::diagnose
