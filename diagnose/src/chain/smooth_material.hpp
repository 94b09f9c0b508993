// SPDX-License-Identifier: GPL-3.0-or-later
// A material without a model: any smooth G* of frequency and strain, and of its age.
#pragma once

#include "observables/observations.hpp"
#include "uncertain_moduli.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// G* = sum of functions with independent normal coefficients of zero mean. Along the frequency Maxwell elements, three a decade of
/// the frequencies measured, a spring and a dashpot, so that G' and G'' belong to one relaxation spectrum (Ferry 1980, ch. 3); each
/// as large as |G*| at its frequency. Along the logarithms of the strain that was set (not one that follows a stress) and of the
/// age bumps of each modulus, of the middle size of |G*|, and of the viscosity along that of the shear rate, of its size there; as
/// many a decade. The common size of the coefficients is known from a few degrees of freedom only.
class SmoothMaterial {
public:
    /// @param ages whether it varies with its age, too.
    SmoothMaterial(const std::vector<Observation>& observations, bool ages);

    /// Moduli as the coefficients change them: without these there are none.
    UncertainModuli moduli() const;

    /// Where a fit begins: what meets the data best if the instrument shows the material as it is.
    const Eigen::VectorXd& start() const { return start_; }

    /// The coefficients that meet the data best where the instrument shows `seen` at some of them, and so much more by one of each.
    Eigen::VectorXd best(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& seen, const Eigen::MatrixXd& changes) const;

private:
    Eigen::MatrixXcd functions_;
    Eigen::VectorXd values_;
    Eigen::VectorXd weights_;
    Eigen::VectorXd start_;
};

}  // namespace coagula::diagnose
