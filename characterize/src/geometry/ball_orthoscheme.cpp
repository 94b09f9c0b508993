// SPDX-License-Identifier: GPL-3.0-or-later
#include "ball_orthoscheme.hpp"

#include <cmath>

namespace coagula::characterize {

// In polar coordinates about F in the plane at distance a, a direction meets the plane at distance t from F and the ball cuts the
// ray off when a^2 + t^2 > rho^2. Integrating min(ray, rho)^3 / 3 over the solid angle of the triangle F E V gives the cases below.
// With theta = atan(half_chord / b), the polar angle at which the sphere meets the edge line E V,
// asin(a sin(theta) / d1) = atan(a half_chord / (b rho)); the form with atan keeps its accuracy near pi / 2.
double arc_term(double a, double b, double rho, double half_chord) {
    const double theta = std::atan(half_chord / b);
    const double psi = std::atan(a * half_chord / (b * rho));
    return a * b * half_chord / 6 - theta * a * (3 * rho * rho - a * a) / 6 + psi * rho * rho * rho / 3;
}

namespace {

double volume_of_positive(double a, double b, double c, double rho) {
    const double d1 = std::hypot(a, b);
    const double d2 = std::hypot(d1, c);
    if (rho >= d2) {
        return a * b * c / 6;
    }
    const double phi = std::atan2(c, b);
    const double psi = std::atan2(a * c, b * d2);
    if (rho <= a) {
        return rho * rho * rho / 3 * (phi - psi);
    }
    const double cut_by_plane = phi * a * (3 * rho * rho - a * a) / 6 - psi * rho * rho * rho / 3;
    return rho <= d1 ? cut_by_plane : cut_by_plane + arc_term(a, b, rho, std::sqrt((rho - d1) * (rho + d1)));
}

}  // namespace

double volume_inside_ball(double a, double b, double c, double rho) {
    if (rho <= 0 || a == 0 || b == 0 || c == 0) {
        return 0;
    }
    const double volume = volume_of_positive(std::abs(a), std::abs(b), std::abs(c), rho);
    return ((std::signbit(a) != std::signbit(b)) != std::signbit(c)) ? -volume : volume;
}

}  // namespace coagula::characterize
