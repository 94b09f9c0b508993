// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a sphere inside a right tetrahedron at its centre. Internal.
#pragma once

namespace coagula::characterize {

/// The tetrahedron F, E, V and the centre O of the sphere, where OF is normal to the plane F E V, and FE is normal to EV.
struct Orthoscheme {
    double a, b, c;   ///< |OF|, |FE|, |EV|, not negative
    double d1, d2;    ///< |OE|, |OV|
    double phi, psi;  ///< angle at F of the triangle F E V; phi - psi is the solid angle at O

    Orthoscheme(double a, double b, double c);
};

struct SpherePart {
    double volume = 0;  ///< of the ball inside the tetrahedron
    double area = 0;    ///< of the sphere inside it
    double bend = 0;    ///< length of the circle on F E V inside the triangle times the angle asin(a / rho) between the sphere's
                        ///< normal on it and the plane
};

/// @param rho radius of the sphere, > 0.
SpherePart sphere_part(const Orthoscheme& tetrahedron, double rho);

}  // namespace coagula::characterize
