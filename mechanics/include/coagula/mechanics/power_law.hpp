// SPDX-License-Identifier: GPL-3.0-or-later
// Power law G' = c (a - a0)^beta through the moduli of structures, and what the data say about the critical value a0.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/packing.hpp>
#include <coagula/common/progress.hpp>

#include <Eigen/Core>

#include <vector>

namespace coagula::mechanics {

/// One structure per entry.
struct PowerLawData {
    Eigen::VectorXd a;               ///< degree of heterogeneity
    Eigen::VectorXd modulus;         ///< [Pa], > 0
    Eigen::VectorXd standard_error;  ///< of the moduli [Pa], > 0; empty: unknown and the same for all
};

struct PowerLaw {
    double a0 = unset;              ///< critical value, below the smallest a
    double beta = unset;            ///< exponent
    double log_c = unset;           ///< ln(c / Pa): c itself leaves the range of numbers where a0 lies far from the data
    double sum_of_squares = unset;  ///< of the residuals [Pa^2]; of residuals over standard errors where these are known [1]

    /// Modulus where a - a0 = 1 [Pa].
    double c() const;
    /// [Pa], for a > a0.
    double modulus(double a) const;
};

/// Where the sum of squares is smallest.
enum class PowerLawMinimum {
    inside,    ///< at a finite distance below the smallest a
    far_away,  ///< it falls as far as a0 is sought downwards: the moduli grow like an exponential, without a threshold
    lowest_a,  ///< it falls until a0 reaches the smallest a: the lowest structure stands apart and the others decide beta
};

struct PowerLawFit {
    PowerLaw law;
    PowerLawMinimum minimum = PowerLawMinimum::inside;
    Index degrees_of_freedom = 0;  ///< structures less three parameters
    /// Standard errors, from the curvature of the sum of squares at its minimum. They are unset where the minimum lies at an end,
    /// and where nothing tells the error of the moduli (three structures without standard errors).
    double a0_stderr = unset;
    double beta_stderr = unset;
    double log_c_stderr = unset;
    /// Confidence interval of a0 from the profile; an end that the data do not bound is unset below and the smallest a above.
    double a0_low = unset;
    double a0_high = unset;
    bool bounded_below = false;
    bool bounded_above = false;
};

/// Best law at each a0.
struct PowerLawProfile {
    std::vector<PowerLaw> laws;  ///< a0 rising; the best of all is among them
    Eigen::VectorXd confidence;  ///< at which a0 is an end of the confidence interval, 0 to 1; empty where there is none
};

struct PowerLawOptions {
    double confidence = 0.95;   ///< of the interval of a0, between 0 and 1
    Index points = 300;         ///< of the profile, at logarithmic distances below the smallest a; >= 10
    bool leave_one_out = true;  ///< fit without each structure in turn
};

struct PowerLawAnalysis {
    PowerLawFit fit;
    PowerLawProfile profile;
    std::vector<PowerLawFit> without;  ///< the fit without structure k; its law is unset where too little is left
    Index decisive = -1;               ///< the structure without which a0 moves most; -1: none left out
};

/// The law that fits best with this a0, c and beta free. Throws std::invalid_argument as fit_power_law does, and when a0 is not
/// below the smallest a.
PowerLaw fit_power_law_at(const PowerLawData& data, double a0);

/// Least squares in the modulus itself (not its logarithm), weighted by 1 / standard_error^2 where these are given. For each a0 the
/// problem is linear in c and has one unknown, beta, which lies between the logarithmic slopes of neighbouring structures. a0 is
/// sought from 1e-6 to 30 times the range of a below the smallest a.
///
/// The confidence interval of a0 holds the values whose sum of squares S exceeds the least, S_min, by a factor of at most
/// 1 + F / m, with F the quantile of the F distribution with 1 and m degrees of freedom; with standard errors by at most the
/// quantile of chi^2 with one degree of freedom (likelihood ratio). Where this set has gaps, the interval covers them.
/// Law: Schenker et al. 2012, sec. 3.2; intervals: Bates & Watts, Nonlinear Regression Analysis (1988), ch. 6.
///
/// Throws std::invalid_argument for fewer than three structures or values of a, values of a beyond 1e6 or alike within rounding (a
/// may be negative), moduli or errors that do not lie between 1e-60 and 1e60 Pa, or moduli that are all the same.
PowerLawAnalysis fit_power_law(const PowerLawData& data, const PowerLawOptions& options = {}, const Progress& progress = {});

}  // namespace coagula::mechanics
