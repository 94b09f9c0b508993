// SPDX-License-Identifier: GPL-3.0-or-later
// Forces between two spheres in a liquid, as values: parameters, energy and force by the gap between the surfaces. SI units.
// The gap is the distance of the centres minus both radii; forces are positive where they push apart, F = -dE/dgap.
#pragma once

#include <coagula/common/checks.hpp>

#include <variant>
#include <vector>

namespace coagula::generators {

inline constexpr double boltzmann_constant = 1.380649e-23;       ///< [J/K]
inline constexpr double elementary_charge = 1.602176634e-19;     ///< [C]
inline constexpr double vacuum_permittivity = 8.8541878128e-12;  ///< [F/m]
inline constexpr double avogadro_constant = 6.02214076e23;       ///< [1/mol]

/// Radii of the two spheres [m], > 0.
struct PairRadii {
    double first = unset;
    double second = unset;
    double sum() const { return first + second; }
    double reduced() const { return first * second / (first + second); }
};

/// Van der Waals attraction of two spheres without the limit of small gaps (Hamaker, Physica 4 (1937) 1058, eq. 15):
/// E = -A/6 [2 R1 R2 / (r^2 - (R1 + R2)^2) + 2 R1 R2 / (r^2 - (R1 - R2)^2) + ln((r^2 - (R1 + R2)^2) / (r^2 - (R1 - R2)^2))].
/// Diverges at contact: for gaps > 0.
class HamakerAttraction {
public:
    /// @param hamaker_constant A [J], >= 0.
    HamakerAttraction(double hamaker_constant, const PairRadii& radii);
    double energy(double gap) const;
    double force(double gap) const;

private:
    double sixth_;  ///< A / 6
    PairRadii radii_;
};

/// The diffuse double layers of two equally charged spheres.
struct DoubleLayer {
    double surface_potential = unset;      ///< psi0 [V]
    double debye_length = unset;           ///< 1/kappa [m], > 0
    double relative_permittivity = unset;  ///< > 0
    double temperature = unset;            ///< [K], > 0
    int valency = 1;                       ///< z of the z:z electrolyte, >= 1
};

/// Debye length of a z:z electrolyte [m].
/// @param ionic_strength I = 1/2 sum c z^2 [mol/m^3], > 0.
double debye_length(double ionic_strength, double relative_permittivity, double temperature);

/// Double layers whose potentials add up (linear superposition; Bell, Levine, McCartney, J. Colloid Interface Sci. 33 (1970) 335):
/// E = 64 pi eps R1 R2/(R1 + R2) (kB T/(z e))^2 tanh^2(z e psi0/(4 kB T)) exp(-gap/debye_length).
class LinearSuperposition {
public:
    LinearSuperposition(const DoubleLayer& layer, const PairRadii& radii);
    double energy(double gap) const;
    double force(double gap) const;

private:
    double at_contact_;
    double inverse_length_;
};

/// Double layers at constant and small surface potential (Hogg, Healy, Fuerstenau, Trans. Faraday Soc. 62 (1966) 1638, eq. 27
/// for equal potentials): E = 4 pi eps R1 R2/(R1 + R2) psi0^2 ln(1 + exp(-gap/debye_length)).
class HoggHealyFuerstenau {
public:
    HoggHealyFuerstenau(const DoubleLayer& layer, const PairRadii& radii);
    double energy(double gap) const;
    double force(double gap) const;

private:
    double prefactor_;
    double inverse_length_;
};

/// Screened repulsion or attraction E = E_0 (R1 + R2)/r exp(-gap/length).
class Yukawa {
public:
    /// @param contact_energy E_0 [J], of either sign.
    /// @param length of the screening [m], > 0.
    Yukawa(double contact_energy, double length, const PairRadii& radii);
    double energy(double gap) const;
    double force(double gap) const;

private:
    double contact_energy_;
    double inverse_length_;
    double contact_distance_;
};

/// Morse's well (Phys. Rev. 34 (1929) 57), E = depth [exp(-2 (gap - rest)/length) - 2 exp(-(gap - rest)/length)]. It stands for the
/// attraction of particles by a polymer that does not adsorb (depletion.hpp).
class Morse {
public:
    /// @param depth of the well [J], > 0. @param rest the gap at its bottom [m]. @param length by which the attraction falls off
    /// [m], > 0.
    Morse(double depth, double rest, double length);
    double energy(double gap) const;
    double force(double gap) const;

private:
    double depth_;
    double rest_;
    double inverse_length_;
};

/// A law given by numbers: the natural cubic spline of an energy, zero beyond the last gap. Energies count from that of the last
/// gap. Below the first gap the force keeps its first value.
class TabulatedLaw {
public:
    /// @param gaps at least four, each 1e-15 m larger than the one before or more [m]. @param energies one for each [J].
    TabulatedLaw(std::vector<double> gaps, std::vector<double> energies);
    double energy(double gap) const;
    double force(double gap) const;
    double first_gap() const { return gaps_.front(); }

private:
    std::size_t interval(double gap) const;

    std::vector<double> gaps_;
    std::vector<double> energies_;
    std::vector<double> curvatures_;  ///< second derivatives of the spline
};

/// Any of the laws.
using PairLaw = std::variant<HamakerAttraction, LinearSuperposition, HoggHealyFuerstenau, Yukawa, Morse, TabulatedLaw>;

}  // namespace coagula::generators
