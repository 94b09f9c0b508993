// Third harmonic of the stress: from what makes the stiffness depend on the momentary strain.
#include "forward.hpp"

#include "plate_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

constexpr int phases_of_oscillation = 96;  ///< of an oscillation; a multiple of 4

}  // namespace

/// G' / G at a phase of an oscillation in which bonds break, between plates as the torque shows it.
double Forward::storage_while_breaking(const Settings& settings, const Observation& observation, const BondStrain& strain,
                                       double phase) const {
    if (!strain_varies(settings, observation)) {
        return simulator_.storage_while_breaking(settings, strain.before, strain.amplitude, phase);
    }
    static const std::vector<Ring> rings = plate_rings(1);
    double mean = 0;
    for (const Ring& ring : rings) {
        mean += ring.weight *
                simulator_.storage_while_breaking(settings, ring.radius * strain.before, ring.radius * strain.amplitude, phase);
    }
    return mean;
}

/// G3* / |G*| of the material at the strain of an observation: Hertz contacts and breaking bonds make the
/// secant stiffness change within an oscillation; all else is linear and changes both harmonics alike.
std::complex<double> Forward::third_harmonic(const Settings& given, const Observation& observation, const BondStrain& bonds) const {
    const Settings settings = with_weakest_bonds(given);
    const double strain = observation.strain;
    if (!std::isfinite(strain) || (settings.contact_preload <= 0 && !std::isfinite(settings.critical_strain))) {
        return 0;
    }
    std::complex<double> first = 0;
    std::complex<double> third = 0;
    for (int k = 0; k < phases_of_oscillation; ++k) {
        const double phase = 2 * std::numbers::pi * (k + 0.5) / phases_of_oscillation;
        const double stress = std::sin(phase) * simulator_.contact_secant(settings, strain * std::sin(phase)) *
                              storage_while_breaking(settings, observation, bonds, phase);
        first += stress * std::complex<double>(std::sin(phase), std::cos(phase));
        third += stress * std::complex<double>(std::sin(3 * phase), std::cos(3 * phase));
    }
    return std::abs(first) > 0 ? third / std::abs(first) : 0.0;
}

}  // namespace coagula::diagnose
