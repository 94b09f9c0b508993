// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of torque, deflection and the phase between them into stress, strain and moduli.
#pragma once

#include <coagula/diagnose/measurement.hpp>

namespace coagula::diagnose {

/// NaN where a size of the tool is not known.
struct ToolConstants {
    double stress = unset;  ///< over torque [Pa/(N.m)]
    double strain = unset;  ///< over deflection [1/rad]

    /// Torque per deflection over the modulus [m^3].
    double torque_per_modulus() const { return strain / stress; }
};

/// Stated constants; else those of cylinders (Newtonian flow in a thin gap), of a cone, or of plates at their rim, by Macosko,
/// Rheology (1994), chapter 5.
ToolConstants tool_constants(const Instrument& instrument);

/// The same with the gap, radius and cone of a row; unset: those of the instrument. Stated constants are those of the instrument's
/// own gap, radius and cone, and of rows with others where a size of the tool is not known.
ToolConstants tool_constants(const Instrument& instrument, double gap, double plate_radius, double cone_angle);

/// Gives a table of moduli that lacks them storage and loss modulus from what it has: phase or loss tangent, and |G*| or |eta*| and
/// the angular frequency; else torque, deflection and phase (the raw one, if there is one), which also give the strain; else
/// stress, strain and phase. Moduli of torque and deflection are raw: inertia and compliance of the tool, and the friction of its
/// bearing, are in them.
/// @param raw replace moduli that the instrument has corrected by those of torque, deflection and raw phase. Throws InputError
/// where these, or a size of the tool, are missing.
void derive_moduli(Measurement& table, const Instrument& instrument, bool raw);

}  // namespace coagula::diagnose
