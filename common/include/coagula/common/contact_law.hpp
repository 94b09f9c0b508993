// SPDX-License-Identifier: GPL-3.0-or-later
// Contact laws as values: parameters, energy, force and tangent stiffness. The loops over contacts live elsewhere and are
// templates over the law, so that every solver runs the same one.
#pragma once

#include <coagula/common/checks.hpp>

#include <Eigen/Core>

#include <algorithm>

namespace coagula {

/// Two particle stiffnesses acting in series: k_i k_j / (k_i + k_j) [N/m] (PFC3D convention, physics of the paper).
inline double stiffness_in_series(double first, double second) {
    return first + second > 0 ? first * second / (first + second) : 0.0;
}

/// Linear spring that only pushes: F = k U for overlap U > 0 (eq. 1 of Schenker et al. 2012), nothing otherwise.
class RepulsiveSpring {
public:
    /// @param stiffness of the contact [N/m], > 0.
    explicit RepulsiveSpring(double stiffness) : stiffness_(require_positive(stiffness, "the contact stiffness", "N/m")) {}

    /// Repulsive force [N] at an overlap [m] (positive when the particles overlap).
    double force(double overlap) const { return stiffness_ * std::max(overlap, 0.0); }
    /// Stored energy [J].
    double energy(double overlap) const { return 0.5 * stiffness_ * std::max(overlap, 0.0) * std::max(overlap, 0.0); }
    /// Tangent dF/dU [N/m].
    double tangent(double overlap) const { return overlap > 0 ? stiffness_ : 0.0; }

private:
    double stiffness_;
};

/// The same spring acting both ways: a contact bond's normal part (F = k U also in tension, U < 0).
class BondSpring {
public:
    /// @param stiffness of the contact [N/m], > 0.
    explicit BondSpring(double stiffness) : stiffness_(require_positive(stiffness, "the bond stiffness", "N/m")) {}

    double force(double overlap) const { return stiffness_ * overlap; }
    double energy(double overlap) const { return 0.5 * stiffness_ * overlap * overlap; }
    double tangent(double /*overlap*/) const { return stiffness_; }

private:
    double stiffness_;
};

/// Bonded contact with a normal and a shear spring (the paper's contact bond below its strength; no moment).
///
/// The argument is delta, the displacement of the second particle relative to the first at their contact point,
/// delta = u_j - u_i - (R_i theta_i + R_j theta_j) x n, and n the unit vector from the first to the second particle.
class BondedContact {
public:
    /// @param normal,shear stiffnesses of the contact (not of the particles) [N/m]; normal > 0, shear >= 0.
    BondedContact(double normal, double shear)
        : normal_(require_positive(normal, "the normal contact stiffness", "N/m")),
          shear_(require_non_negative(shear, "the shear contact stiffness", "N/m")) {}

    double normal_stiffness() const { return normal_; }
    double shear_stiffness() const { return shear_; }

    /// 1/2 [k_n (delta.n)^2 + k_s |delta - (delta.n) n|^2] [J].
    double energy(const Eigen::Vector3d& delta, const Eigen::Vector3d& n) const { return 0.5 * delta.dot(force(delta, n)); }

    /// Derivative of the energy by delta [N]: the force that pulls the first particle along and the second one back.
    Eigen::Vector3d force(const Eigen::Vector3d& delta, const Eigen::Vector3d& n) const {
        return shear_ * delta + (normal_ - shear_) * delta.dot(n) * n;
    }

    /// Derivative of the force by delta: k_n n n^T + k_s (I - n n^T) [N/m].
    Eigen::Matrix3d tangent(const Eigen::Vector3d& n) const {
        return shear_ * Eigen::Matrix3d::Identity() + (normal_ - shear_) * n * n.transpose();
    }

private:
    double normal_;
    double shear_;
};

}  // namespace coagula
