// SPDX-License-Identifier: GPL-3.0-or-later
// Moduli of a material of which something is open.
#pragma once

#include <Eigen/Core>

#include <limits>

namespace coagula::diagnose {

/// G* of every number that was measured, by independent standard errors: first those that add to it, then those of what a solvent
/// drags along, which is known up to factors and differs from structure to structure by powers of ten. Without the drag
///
///     G* = mean + changes e,    and with it    G* (1 + dragged (exp(excess + logarithms e') - 1))
struct UncertainModuli {
    Eigen::VectorXcd mean;
    Eigen::MatrixXcd changes;                                  ///< numbers x errors that add
    Eigen::VectorXcd dragged;                                  ///< part of the mean that the drag adds
    Eigen::VectorXcd excess;                                   ///< logarithm of the factor on that part that is expected
    Eigen::MatrixXcd logarithms;                               ///< numbers x errors of the drag
    double degrees = std::numeric_limits<double>::infinity();  ///< of freedom from which the scale of all errors is known

    /// Moduli without errors.
    explicit UncertainModuli(const Eigen::VectorXcd& known = {});
    UncertainModuli(Eigen::VectorXcd expected, Eigen::MatrixXcd added);

    Eigen::Index errors() const { return changes.cols() + logarithms.cols(); }

    /// Moduli with these errors.
    Eigen::VectorXcd with(const Eigen::VectorXd& errors) const;
    /// The same, and the slope by each error.
    Eigen::MatrixXcd tangents(const Eigen::VectorXd& errors) const;

private:
    struct Parts {
        Eigen::VectorXcd moduli;  ///< without errors of the drag
        Eigen::VectorXcd growth;  ///< of the dragged part
        Eigen::VectorXcd factor;  ///< on these
    };
    Parts parts(const Eigen::VectorXd& errors) const;
};

}  // namespace coagula::diagnose
