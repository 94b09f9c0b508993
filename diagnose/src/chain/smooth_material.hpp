// SPDX-License-Identifier: GPL-3.0-or-later
// A material of which no structures are known: its G* may be any smooth function of frequency, strain and age.
#pragma once

#include "observables/observations.hpp"
#include "uncertain_moduli.hpp"

#include <Eigen/Core>

#include <vector>

namespace coagula::diagnose {

/// G* is a sum of functions whose coefficients are independent normal numbers of zero mean. There are three functions for each
/// decade that was measured.
///
/// Along the frequency the functions are a spring, a dashpot and Maxwell elements, so that G' and G'' belong to one relaxation
/// spectrum (Ferry 1980, ch. 3). A few elements beyond either end relax slower or faster than was measured; their coefficients are
/// not negative, as no spectrum is: less than nothing of a fast one would be an inertia. Each element is as large as |G*| at its
/// frequency. Along the logarithm of the strain they are bumps of each modulus, as large as the median of |G*|, and so they are
/// along the logarithm of the age. The strain counts where it was set, not where it follows from a stress. In steady flow they are
/// bumps of the viscosity along the logarithm of the shear rate, as large as the viscosity there.
///
/// The common size of the coefficients is known from a few degrees of freedom only.
class SmoothMaterial {
public:
    /// @param ages whether it varies with its age, too.
    SmoothMaterial(const std::vector<Observation>& observations, bool ages);

    /// The moduli as a linear function of the coefficients. They are zero where all coefficients are.
    UncertainModuli moduli() const;

    /// Coefficients at which a fit begins: those that meet the data best if the instrument shows the material as it is.
    const Eigen::VectorXd& start() const { return start_; }

    /// The coefficients that meet the data best.
    /// @param seen what the instrument shows at `coefficients`. @param changes how that grows with each coefficient, in columns.
    Eigen::VectorXd best(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& seen, const Eigen::MatrixXd& changes) const;
    /// Returns the numbers of those coefficients that would be negative if they could.
    std::vector<Eigen::Index> at_end(const Eigen::VectorXd& coefficients) const;

private:
    Eigen::MatrixXcd functions_;
    Eigen::VectorXd values_;
    Eigen::VectorXd weights_;
    Eigen::VectorXd start_;
    Eigen::Array<bool, Eigen::Dynamic, 1> not_negative_;  ///< of each coefficient
};

}  // namespace coagula::diagnose
