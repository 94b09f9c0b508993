// SPDX-License-Identifier: GPL-3.0-or-later
// Volume of a right tetrahedron inside a ball about its apex: the closed form behind the exact pore-size curve.
#pragma once

namespace coagula::characterize {

/// Volume inside the ball of radius rho about O of the orthoscheme O F E V, whose edges OF, FE, EV are mutually perpendicular and
/// have the signed lengths a, b, c. The volume is odd in each of them, so that a power cell is the signed sum of such pieces
/// also where a foot point lies outside its face or edge.
double volume_inside_ball(double a, double b, double c, double rho);

/// The part of that volume which depends on rho through more than a polynomial, for d1 = sqrt(a^2 + b^2) < rho < d2 =
/// sqrt(d1^2 + c^2) and a, b > 0. It does not depend on c: for that range
///   volume = phi a (3 rho^2 - a^2) / 6 - psi rho^3 / 3 + arc_term,
/// with phi = atan(c / b) the angle of the triangle F E V at F and psi = atan(a c / (b d2)).
/// @param half_chord sqrt(rho^2 - d1^2).
double arc_term(double a, double b, double rho, double half_chord);

}  // namespace coagula::characterize
