// SPDX-License-Identifier: GPL-3.0-or-later
// Observations with their noise: y = m (1 + b) + e with the prediction m, an effect b of each sample and an error e of each row.
#pragma once

#include "observables/observations.hpp"

#include <coagula/diagnose/noise.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// Errors of the rows, those of torque and phase along and across G*; those of neighbours in a table may be correlated (first order
/// autoregression).
struct RowNoise {
    Eigen::VectorXd deviation;
    std::vector<Index> previous;      ///< the error before it in its table, -1 if there is none
    Eigen::VectorXd correlation;      ///< with that; negative where its axis is turned the other way
    std::vector<Index> partner = {};  ///< of G', where its errors are turned: G'' of the same row; else -1
    Eigen::VectorXd cosine = {};      ///< of the angle by which G' is turned towards that
    Eigen::VectorXd sine = {};

    /// Values over the deviation and freed from the correlation: independent with unit variance if they are such errors.
    Eigen::VectorXd whiten(const Eigen::VectorXd& values) const;
    Eigen::MatrixXd whitened(Eigen::MatrixXd columns) const;
    /// Errors of which these are the whitened ones.
    Eigen::VectorXd coloured(const Eigen::VectorXd& white) const;
    /// Deviation of each value.
    Eigen::VectorXd marginal_deviation() const;
    double log_determinant() const;
    /// Further independent errors with these deviations.
    void widen(const Eigen::VectorXd& further);
};

/// One experiment's moduli, or some of its rows.
struct DataSet {
    std::vector<Observation> observations;
    Eigen::VectorXd values;
    RowNoise noise;
    std::vector<Index> sample;  ///< of each observation, from 0; -1: no effect, what is a share has no scale
    std::vector<std::string> sample_names;
    double effect = 0;                                                ///< standard deviation of b
    double effect_degrees = std::numeric_limits<double>::infinity();  ///< of freedom from which it was estimated

    Index size() const { return values.size(); }
    Index samples() const { return static_cast<Index>(sample_names.size()); }
    DataSet part(const std::vector<Index>& rows) const;
};

/// Throws InputError when there are too few observations to say anything.
/// @param errors beside those that tables state.
DataSet data_set_of(const Experiment& experiment, const ErrorSpec& errors);

/// Chi-square over its degrees of freedom at a standard normal number, by the cube root (Wilson and Hilferty 1931).
double scaled_chi_square(double degrees, double normal);

}  // namespace coagula::diagnose
