// SPDX-License-Identifier: GPL-3.0-or-later
#include "sphere_in_orthoscheme.hpp"

#include <cmath>

namespace coagula::characterize {

Orthoscheme::Orthoscheme(double a_, double b_, double c_)
    : a(a_),
      b(b_),
      c(c_),
      d1(std::sqrt(a * a + b * b)),
      d2(std::sqrt(d1 * d1 + c * c)),
      phi(std::atan2(c, b)),
      psi(std::atan2(a * c, b * d2)) {}

// The volume is that of volume_inside_ball (ball_orthoscheme.cpp). Its derivative by rho is the area: rho^2 times the solid angle
// in which the tetrahedron reaches beyond the sphere. The circle on the plane has the radius s = sqrt(rho^2 - a^2); of its angle
// phi at F the part theta = acos(b / s) lies beyond the edge E V.
SpherePart sphere_part(const Orthoscheme& tetrahedron, double rho) {
    const auto& [a, b, c, d1, d2, phi, psi] = tetrahedron;
    if (rho >= d2) {
        return {a * b * c / 6, 0, 0};
    }
    const double squared = rho * rho;
    if (rho <= a) {
        return {squared * rho / 3 * (phi - psi), squared * (phi - psi), 0};
    }
    double volume = phi * a * (3 * squared - a * a) / 6 - psi * squared * rho / 3;
    double area = phi * a * rho - psi * squared;
    double arc = phi;
    if (rho > d1) {
        const double half_chord = std::sqrt((rho - d1) * (rho + d1));
        const double theta = std::atan(half_chord / b);
        const double beyond = std::atan(a * half_chord / (b * rho));
        volume += a * b * half_chord / 6 - theta * a * (3 * squared - a * a) / 6 + beyond * squared * rho / 3;
        area += beyond * squared - theta * a * rho;
        arc -= theta;
    }
    return {volume, area, arc * std::sqrt((rho - a) * (rho + a)) * std::asin(a / rho)};
}

}  // namespace coagula::characterize
