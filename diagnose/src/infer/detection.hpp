// SPDX-License-Identifier: GPL-3.0-or-later
// Does a fitted model fail the data, and where?
#pragma once

#include "departures.hpp"
#include "observables/coordinate.hpp"

#include <coagula/common/progress.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// One way to fail: a smooth departure of one observable of some tables along a coordinate, the samples, a step towards a
/// mechanism, or the whole; of all tables or of those of one kind.
struct MisfitStatistic {
    std::string observable;  ///< key of an observable, "third_harmonic", "sample_effect", "normal_stiffness" or "all"
    Coordinate coordinate = Coordinate::none;
    bool autocorrelation = false;     ///< of neighbours along the coordinate, else the size of smooth components
    std::vector<Index> rows = {};     ///< observations that take part, sorted along the coordinate
    std::string tables = {};          ///< kind of the tables that take part; all where it is empty
    std::string cause = {};           ///< mechanism towards which `directions` go, orthogonal to what the fitted quantities move
    Eigen::MatrixXd directions = {};  ///< unit vectors; smooth components where there is no cause
    double value = 0;
    double score = 0;  ///< the normal number of the same probability
};

struct Detection {
    double p_value = 1;
    std::vector<MisfitStatistic> statistics;  ///< the largest score first
    std::vector<double> bootstrap;            ///< largest score of each drawn data set
};

/// The statistics of the residuals, standardised, and the p-value of the largest: the part of data sets drawn from the fitted model
/// and fitted again (linearised at the fit) whose largest one is as large.
/// @param inference, fit the model and where it was fitted. @param causes towards which steps are looked for.
Detection detect(const Inference& inference, const Fit& fit, const Hypothesis& causes, std::uint64_t seed, int bootstrap,
                 const Progress& progress = {});

}  // namespace coagula::diagnose
