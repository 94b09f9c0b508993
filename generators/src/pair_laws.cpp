// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/generators/pair_laws.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace coagula::generators {

namespace {

using std::numbers::pi;

void check(const PairRadii& radii) {
    require_positive(radii.first, "the radius of the first particle", "m");
    require_positive(radii.second, "the radius of the second particle", "m");
}

void check(const DoubleLayer& layer) {
    require(std::isfinite(layer.surface_potential),
            "the surface potential is " + to_text(layer.surface_potential) + " V, but it must be a finite number");
    require_positive(layer.debye_length, "the Debye length", "m");
    require_positive(layer.relative_permittivity, "the relative permittivity");
    require_positive(layer.temperature, "the temperature", "K");
    require(layer.valency >= 1, "the valency is " + std::to_string(layer.valency) + ", but it must be at least 1");
}

}  // namespace

HamakerAttraction::HamakerAttraction(double hamaker_constant, const PairRadii& radii)
    : sixth_(require_non_negative(hamaker_constant, "the Hamaker constant", "J") / 6), radii_(radii) {
    check(radii);
}

double HamakerAttraction::energy(double gap) const {
    // r^2 - (R1 + R2)^2 and r^2 - (R1 - R2)^2, written so that small gaps keep their digits.
    const double outer = gap * (gap + 2 * radii_.sum());
    const double product = radii_.first * radii_.second;
    const double inner = outer + 4 * product;
    return -sixth_ * (2 * product / outer + 2 * product / inner + std::log1p(-4 * product / inner));
}

double HamakerAttraction::force(double gap) const {
    const double outer = gap * (gap + 2 * radii_.sum());
    const double product = radii_.first * radii_.second;
    const double inner = outer + 4 * product;
    const double slope = 2 * (gap + radii_.sum());  // of both squares
    return sixth_ * slope * (-2 * product / (outer * outer) - 2 * product / (inner * inner) + 4 * product / (outer * inner));
}

double debye_length(double ionic_strength, double relative_permittivity, double temperature) {
    require_positive(ionic_strength, "the ionic strength", "mol/m^3");
    require_positive(relative_permittivity, "the relative permittivity");
    require_positive(temperature, "the temperature", "K");
    return std::sqrt(vacuum_permittivity * relative_permittivity * boltzmann_constant * temperature /
                     (2 * elementary_charge * elementary_charge * avogadro_constant * ionic_strength));
}

LinearSuperposition::LinearSuperposition(const DoubleLayer& layer, const PairRadii& radii) {
    check(layer);
    check(radii);
    const double thermal = boltzmann_constant * layer.temperature / (layer.valency * elementary_charge);
    const double steepness = std::tanh(layer.surface_potential / (4 * thermal));
    at_contact_ =
        64 * pi * vacuum_permittivity * layer.relative_permittivity * radii.reduced() * thermal * thermal * steepness * steepness;
    inverse_length_ = 1 / layer.debye_length;
}

double LinearSuperposition::energy(double gap) const {
    return at_contact_ * std::exp(-gap * inverse_length_);
}

double LinearSuperposition::force(double gap) const {
    return inverse_length_ * energy(gap);
}

HoggHealyFuerstenau::HoggHealyFuerstenau(const DoubleLayer& layer, const PairRadii& radii) {
    check(layer);
    check(radii);
    prefactor_ = 4 * pi * vacuum_permittivity * layer.relative_permittivity * radii.reduced() * layer.surface_potential *
                 layer.surface_potential;
    inverse_length_ = 1 / layer.debye_length;
}

double HoggHealyFuerstenau::energy(double gap) const {
    return prefactor_ * std::log1p(std::exp(-gap * inverse_length_));
}

double HoggHealyFuerstenau::force(double gap) const {
    return prefactor_ * inverse_length_ / (1 + std::exp(gap * inverse_length_));
}

Yukawa::Yukawa(double contact_energy, double length, const PairRadii& radii)
    : contact_energy_(contact_energy),
      inverse_length_(1 / require_positive(length, "the screening length", "m")),
      contact_distance_(radii.sum()) {
    check(radii);
    require(std::isfinite(contact_energy),
            "the contact energy is " + to_text(contact_energy) + " J, but it must be a finite number");
}

double Yukawa::energy(double gap) const {
    return contact_energy_ * contact_distance_ / (contact_distance_ + gap) * std::exp(-gap * inverse_length_);
}

double Yukawa::force(double gap) const {
    return energy(gap) * (inverse_length_ + 1 / (contact_distance_ + gap));
}

Morse::Morse(double depth, double rest, double length)
    : depth_(require_positive(depth, "the depth of the well", "J")),
      rest_(rest),
      inverse_length_(1 / require_positive(length, "the length of the well", "m")) {
    require(std::isfinite(rest), "the gap at the bottom of the well is " + to_text(rest) + " m, but it must be a finite number");
}

double Morse::energy(double gap) const {
    const double x = std::exp(-(gap - rest_) * inverse_length_);
    return depth_ * x * (x - 2);
}

double Morse::force(double gap) const {
    const double x = std::exp(-(gap - rest_) * inverse_length_);
    return 2 * depth_ * inverse_length_ * x * (x - 1);
}

constexpr double least_step = 1e-15;  ///< between gaps of a table [m]: slopes and curvatures stay finite

TabulatedLaw::TabulatedLaw(std::vector<double> gaps, std::vector<double> energies)
    : gaps_(std::move(gaps)), energies_(std::move(energies)) {
    require(gaps_.size() == energies_.size() && gaps_.size() >= 4,
            "a tabulated law has " + std::to_string(gaps_.size()) + " gaps and " + std::to_string(energies_.size()) +
                " energies, but it needs at least four gaps and an energy for each");
    for (std::size_t row = 0; row < gaps_.size(); ++row) {
        require(std::isfinite(gaps_[row]) && std::isfinite(energies_[row]),
                "row " + std::to_string(row + 1) + " of the tabulated law holds a value that is not a finite number");
        require(row == 0 || gaps_[row] - gaps_[row - 1] >= least_step,
                "row " + std::to_string(row + 1) + " of the tabulated law has a gap that is not at least " + to_text(least_step) +
                    " m larger than the one before it");
    }
    const double last = energies_.back();
    for (double& energy : energies_) {
        energy -= last;
    }
    // Tridiagonal system of the second derivatives, solved by elimination; zero at both ends.
    const std::size_t count = gaps_.size();
    curvatures_.assign(count, 0.0);
    std::vector<double> share(count, 0.0);
    for (std::size_t row = 1; row + 1 < count; ++row) {
        const double left = gaps_[row] - gaps_[row - 1];
        const double right = gaps_[row + 1] - gaps_[row];
        const double bend = 6 * ((energies_[row + 1] - energies_[row]) / right - (energies_[row] - energies_[row - 1]) / left);
        const double pivot = 2 * (left + right) - left * share[row - 1];
        share[row] = right / pivot;
        curvatures_[row] = (bend - left * curvatures_[row - 1]) / pivot;
    }
    for (std::size_t row = count - 2; row > 0; --row) {
        curvatures_[row] -= share[row] * curvatures_[row + 1];
    }
}

std::size_t TabulatedLaw::interval(double gap) const {
    const auto above = std::upper_bound(gaps_.begin() + 1, gaps_.end() - 1, gap);
    return static_cast<std::size_t>(above - gaps_.begin()) - 1;
}

double TabulatedLaw::energy(double gap) const {
    if (gap >= gaps_.back()) {
        return 0;
    }
    if (gap < gaps_.front()) {
        return energies_.front() + force(gaps_.front()) * (gaps_.front() - gap);
    }
    const std::size_t row = interval(gap);
    const double width = gaps_[row + 1] - gaps_[row];
    const double right = (gap - gaps_[row]) / width;
    const double left = 1 - right;
    return left * energies_[row] + right * energies_[row + 1] +
           width * width / 6 *
               ((left * left * left - left) * curvatures_[row] + (right * right * right - right) * curvatures_[row + 1]);
}

double TabulatedLaw::force(double gap) const {
    if (gap >= gaps_.back()) {
        return 0;
    }
    const double inside = std::max(gap, gaps_.front());
    const std::size_t row = interval(inside);
    const double width = gaps_[row + 1] - gaps_[row];
    const double right = (inside - gaps_[row]) / width;
    const double left = 1 - right;
    return (energies_[row] - energies_[row + 1]) / width +
           width / 6 * ((3 * left * left - 1) * curvatures_[row] - (3 * right * right - 1) * curvatures_[row + 1]);
}

}  // namespace coagula::generators
