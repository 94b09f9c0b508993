// SPDX-License-Identifier: GPL-3.0-or-later
// Third harmonic of the stress: from what makes the stiffness depend on the momentary strain.
#include "forward.hpp"

#include "plate_field.hpp"
#include "responses/contact_response.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

constexpr int phases_of_quarter = 24;

/// Phases of the same momentary strain, up to the sign, in every quarter of an oscillation.
struct Phases {
    double sine;
    std::array<std::complex<double>, 4> first;  ///< what a stress at the phase adds to G*, times the sign of the strain
    std::array<std::complex<double>, 4> third;
};

std::vector<Phases> all_phases() {
    using std::numbers::pi;
    std::vector<Phases> all;
    for (int k = 0; k < phases_of_quarter; ++k) {
        const double phase = 0.5 * pi * (k + 0.5) / phases_of_quarter;
        Phases one{.sine = std::sin(phase), .first = {}, .third = {}};
        const std::array quarters{phase, pi - phase, pi + phase, 2 * pi - phase};
        for (std::size_t quarter = 0; quarter < 4; ++quarter) {
            const double sign = quarter < 2 ? 1 : -1;
            const double here = quarters[quarter];
            one.first[quarter] = sign * std::complex<double>(std::sin(here), std::cos(here));
            one.third[quarter] = sign * std::complex<double>(std::sin(3 * here), std::cos(3 * here));
        }
        all.push_back(one);
    }
    return all;
}

/// Stress over strain of bonds that hold, at a momentary strain, over that of small strains.
double secant_of(const Model& model, Simulator& simulator, const Settings& settings, double strain) {
    double secant = contact_secant(simulator, settings, strain);
    model.for_each<BendsStress>([&](const BendsStress& effect, Values values) { secant *= effect.secant(strain, values); });
    return secant;
}

}  // namespace

/// G' / G in the quarters of an oscillation in which bonds break, between plates as the torque shows it.
std::array<double, 4> Forward::storage_while_breaking(const Settings& settings, const Observation& observation,
                                                      const BondStrain& strain, double sine) const {
    if (!strain_varies(settings, observation)) {
        return storage_in_quarters(simulator_, settings, strain.before, strain.amplitude, sine);
    }
    static const std::vector<Ring> rings = plate_rings(1);
    std::array<double, 4> mean{};
    for (const Ring& ring : rings) {
        const auto own =
            storage_in_quarters(simulator_, settings, ring.radius * strain.before, ring.radius * strain.amplitude, sine);
        for (std::size_t quarter = 0; quarter < own.size(); ++quarter) {
            mean[quarter] += ring.weight * own[quarter];
        }
    }
    return mean;
}

/// G3* / |G*| of the material at the strain of an observation: Hertz contacts, other laws of the stress and breaking bonds make the
/// secant stiffness change within an oscillation; all else is linear and changes both harmonics alike.
std::complex<double> Forward::third_harmonic(const Model& model, const Settings& given, const Observation& observation,
                                             const BondStrain& bonds) const {
    const Settings settings = with_weakest_bonds(given);
    const double strain = observation.strain;
    const bool bends = settings.contact_preload > 0 || model.has<BendsStress>();
    if (!std::isfinite(strain) || (!bends && !std::isfinite(settings.critical_strain))) {
        return 0;
    }
    std::complex<double> first = 0;
    std::complex<double> third = 0;
    static const std::vector<Phases> phases = all_phases();
    for (const Phases& phase : phases) {
        const double secant = phase.sine * secant_of(model, simulator_, settings, strain * phase.sine);
        const std::array<double, 4> storage = storage_while_breaking(settings, observation, bonds, phase.sine);
        for (std::size_t quarter = 0; quarter < storage.size(); ++quarter) {
            first += secant * storage[quarter] * phase.first[quarter];
            third += secant * storage[quarter] * phase.third[quarter];
        }
    }
    return std::abs(first) > 0 ? third / std::abs(first) : 0.0;
}

}  // namespace coagula::diagnose
