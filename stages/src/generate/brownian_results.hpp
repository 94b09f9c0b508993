// SPDX-License-Identifier: GPL-3.0-or-later
// Results of a Brownian run, for the file and for the table.
#pragma once

#include <coagula/stages/findings.hpp>

#include <coagula/generators/brownian_dynamics.hpp>

namespace coagula::stages {

/// Data sets below /generation/brownian: time step, end, time series, potential.
Results datasets_of(const generators::BrownianRun& run, const generators::PairPotential& potential,
                    const generators::BrownianOptions& options);

/// The degree of heterogeneity at the start, at the snapshots and at the end: data sets below /generation/brownian/heterogeneity.
Results heterogeneity_of(const generators::BrownianRun& run, const Packing& start, const generators::BrownianOptions& options,
                         const Progress& progress);

Table table_of(const generators::BrownianRun& run, const generators::BrownianOptions& options);

}  // namespace coagula::stages
