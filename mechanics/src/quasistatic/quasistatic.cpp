// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/quasistatic.hpp>

#include "curves/loop_analysis.hpp"
#include "strain_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

namespace {

using std::numbers::pi;

constexpr double load_lost = 1e-3;  // of the peak stress

void check_model(const ContactModel& model) {
    const auto refuse = [](bool present, const std::string& what) {
        require(!present,
                "the contact model has " + what + ", which depends on the rate of strain: a quasi-static run has no rate");
    };
    const auto has = [](double value) { return !std::isnan(value) && value != 0; };
    refuse(has(model.normal_viscosity) || has(model.shear_viscosity), "a dashpot");
    refuse(has(model.normal_maxwell_stiffness) || has(model.shear_maxwell_stiffness), "a Maxwell element");
    refuse(has(model.normal_springpot_stiffness) || has(model.shear_springpot_stiffness), "a springpot");
    refuse(!std::isnan(model.solvent_viscosity) || !std::isnan(model.lubrication_gap) || !std::isnan(model.lubrication_cutoff),
           "a solvent");
}

void check_input(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                 const QuasistaticOptions& options) {
    check(packing);
    check(model);
    check_model(model);
    require(bonds.particles == packing.size(), "the bonds belong to a packing of " + std::to_string(bonds.particles) +
                                                   " particles, the packing has " + std::to_string(packing.size()));
    require(packing.cell.is_periodic(), "the packing has a free surface: quasi-static shear needs a periodic cell");
    const auto [normal, direction] = options.orientation;
    require(normal >= 0 && normal < 3 && direction >= 0 && direction < 3, "an orientation is named by two axes of 0, 1, 2");
    require_positive(options.tolerance, "the tolerance of the equilibrium");
    require_positive(options.balance_tolerance, "the tolerance of the energy balance");
    require_positive(options.event_tolerance, "the tolerance of the strain at which a bond breaks");
    require_positive(options.smallest_step, "the smallest step of strain");
}

bool is_ageing(const ContactModel& model) {
    return !std::isnan(model.ageing_rate) && model.ageing_rate > 0;
}

/// Uniaxial strain of -1 would press the cell flat.
void check_height(const ShearOrientation& orientation, double lowest_strain) {
    require(!orientation.is_uniaxial() || lowest_strain > -1,
            "the uniaxial strain is " + to_text(lowest_strain) + ", but must be above -1, where the cell has no height left");
}

/// The stress on the plates: a shear stress, or the normal stress where the strain is uniaxial.
double plate_stress(const StrainPoint& point, const ShearOrientation& orientation) {
    return point.stress(orientation.normal, orientation.direction);
}

/// Where the stress falls for good to next to nothing of its peak.
std::optional<NetworkFailure> loss_of_load(const RampResponse& ramp, const ShearOrientation& orientation) {
    double peak = 0;
    for (const StrainPoint& point : ramp.points) {
        peak = std::max(peak, std::abs(plate_stress(point, orientation)));
    }
    std::size_t first = ramp.points.size();
    while (first > 0 && std::abs(plate_stress(ramp.points[first - 1], orientation)) < load_lost * peak) {
        --first;
    }
    if (first == ramp.points.size() || ramp.broken.empty()) {
        return std::nullopt;
    }
    const double strain = ramp.points[first].strain;
    const auto before = [&](const BrokenBond& bond) { return std::abs(bond.strain) <= std::abs(strain); };
    return NetworkFailure{strain, std::count_if(ramp.broken.begin(), ramp.broken.end(), before), false};
}

/// Phase of the points of a cycle between its turning points: strain = amplitude sin(phase) on quarter 0, 1 and 2, or 3.
double phase_of(double strain, double amplitude, int quarter) {
    const double angle = std::asin(std::clamp(strain / amplitude, -1.0, 1.0));
    return quarter == 0 ? angle : (quarter == 3 ? 2 * pi + angle : pi - angle);
}

struct Loop {
    std::vector<double> phase;
    std::vector<StrainPoint> points;
};

Loop run_cycle(StrainPath& path, double amplitude, Index steps) {
    Loop loop{{0.0}, {path.point()}};
    for (Index k = 1; k <= steps && !path.failure(); ++k) {
        const int quarter = static_cast<int>(4 * (k - 1) / steps);
        const double strain = k == steps ? 0.0 : amplitude * std::sin(2 * pi * static_cast<double>(k) / static_cast<double>(steps));
        path.go_to(2 * k == steps ? 0.0 : strain, [&](const StrainPoint& point) {
            loop.phase.push_back(phase_of(point.strain, amplitude, quarter));
            loop.points.push_back(point);
        });
    }
    return loop;
}

AmplitudeResponse analyse(Loop loop, double amplitude, const ShearOrientation& orientation, double volume) {
    AmplitudeResponse response;
    std::vector<double> stress;
    for (const StrainPoint& point : loop.points) {
        stress.push_back(plate_stress(point, orientation));
        response.peak_stress = std::max(response.peak_stress, std::abs(stress.back()));
    }
    const Harmonics harmonics = analyse_loop(amplitude, loop.phase, stress);
    response.amplitude = amplitude;
    response.storage_modulus = harmonics.in_phase / amplitude;
    response.loss_modulus = harmonics.out_of_phase / amplitude;
    response.third_harmonic = harmonics.third_over_first;
    response.loop_area = harmonics.area;
    double gross = 0;
    for (std::size_t k = 1; k < stress.size(); ++k) {
        const double change = loop.points[k].strain - loop.points[k - 1].strain;
        gross += 0.5 * volume * std::abs((stress[k] + stress[k - 1]) * change);
    }
    const double imbalance = loop.points.back().imbalance(loop.points.front());
    response.balance_error = gross > 0 ? std::abs(imbalance) / gross : 0.0;
    response.bonds = loop.points.back().bonds;
    response.loop = std::move(loop.points);
    return response;
}

void check_sweep(const SweepOptions& options, const ContactModel& model) {
    require(!options.amplitudes.empty(), "an amplitude sweep needs at least one amplitude");
    for (const double amplitude : options.amplitudes) {
        require_positive(amplitude, "an amplitude of strain");
    }
    require(options.cycles >= 1, "the number of cycles is " + std::to_string(options.cycles) + ", but must be at least 1");
    require(options.steps_per_cycle >= 4 && options.steps_per_cycle % 4 == 0,
            "the number of steps per cycle is " + std::to_string(options.steps_per_cycle) + ", but must be a multiple of 4");
    require(!is_ageing(model) || options.frequency > 0,
            "the contact model ages, so an amplitude sweep needs the frequency that says how long a cycle takes");
}

double age_factor(const ContactModel& model, double time) {
    return 1 + model.ageing_rate * std::log1p(time / model.ageing_time);
}

}  // namespace

double StrainPoint::imbalance(const StrainPoint& start) const {
    return (work - start.work) - (stored - start.stored) - (dissipated - start.dissipated) - (breakage - start.breakage) -
           (released - start.released);
}

double RampResponse::secant_modulus(std::size_t point, const ShearOrientation& orientation) const {
    return (plate_stress(points.at(point), orientation) - plate_stress(points.front(), orientation)) / points[point].strain;
}

RampResponse shear_to(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model, const RampOptions& options,
                      const Progress& progress) {
    check_input(packing, bonds, model, options.solver);
    require(std::isfinite(options.strain) && options.strain != 0,
            "the strain of a ramp is " + to_text(options.strain) + ", but must be finite and not 0");
    check_height(options.solver.orientation, options.strain);
    require(options.steps >= 1, "the number of steps is " + std::to_string(options.steps) + ", but must be at least 1");
    StrainPath path(packing, bonds, model, options.solver, std::abs(options.strain), progress);
    path.expect(options.steps);
    RampResponse response;
    response.points.push_back(path.point());
    const auto finish = [&] {
        response.broken = path.broken();
        response.failure = path.failure() ? path.failure() : loss_of_load(response, options.solver.orientation);
        response.effort = path.effort();
    };
    try {
        for (Index k = 1; k <= options.steps && !path.failure(); ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(options.steps);
            path.go_to(k == options.steps ? options.strain : share * options.strain,
                       [&](const StrainPoint& point) { response.points.push_back(point); });
        }
    } catch (const NoEquilibrium&) {
        finish();
        if (!response.failure) {
            throw;
        }
        return response;
    }
    finish();
    return response;
}

SweepResponse sweep_amplitudes(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                               const SweepOptions& options, const Progress& progress) {
    check_input(packing, bonds, model, options.solver);
    check_sweep(options, model);
    const double largest = *std::max_element(options.amplitudes.begin(), options.amplitudes.end());
    check_height(options.solver.orientation, -largest);
    StrainPath path(packing, bonds, model, options.solver, largest, progress);
    const std::size_t sections = options.amplitudes.size();
    path.expect(static_cast<Index>(sections) * options.cycles * options.steps_per_cycle);
    SweepResponse response;
    for (std::size_t section = 0; section < sections; ++section) {
        path.begin_section(static_cast<Index>(section), options.amplitudes[section]);
        if (is_ageing(model) && section > 0) {
            path.age(age_factor(model, static_cast<double>(section) * static_cast<double>(options.cycles) / options.frequency));
        }
        const std::size_t before = path.broken().size();
        Loop loop;
        for (Index cycle = 0; cycle < options.cycles && !path.failure(); ++cycle) {
            path.remark("amplitude " + std::to_string(section + 1) + " of " + std::to_string(sections) + ", cycle " +
                        std::to_string(cycle + 1) + " of " + std::to_string(options.cycles));
            loop = run_cycle(path, options.amplitudes[section], options.steps_per_cycle);
        }
        if (path.failure()) {
            break;
        }
        response.amplitudes.push_back(
            analyse(std::move(loop), options.amplitudes[section], options.solver.orientation, packing.cell.volume()));
        response.amplitudes.back().broken = static_cast<Index>(path.broken().size() - before);
    }
    response.broken = path.broken();
    response.failure = path.failure();
    response.effort = path.effort();
    return response;
}

std::vector<double> small_strain_moduli(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                                        double strain, const QuasistaticOptions& options, const Progress& progress) {
    std::vector<double> moduli;
    for (const ShearOrientation& orientation : all_orientations()) {
        RampOptions ramp{.strain = strain, .steps = 1, .solver = options};
        ramp.solver.orientation = orientation;
        const RampResponse response = shear_to(packing, bonds, model, ramp, progress);
        if (response.failure) {
            throw std::runtime_error("the network fails at the strain " + to_text(response.failure->strain) +
                                     " and has no modulus at " + to_text(strain));
        }
        moduli.push_back(response.secant_modulus(response.points.size() - 1, orientation));
    }
    return moduli;
}

double yield_strain(const std::vector<double>& strain, const std::vector<double>& modulus, double fraction) {
    require(strain.size() == modulus.size(), "strains and moduli must be as many");
    require_between(fraction, 0, 1, "the fraction of the modulus at which the material yields");
    for (std::size_t k = 1; k < strain.size(); ++k) {
        const double limit = fraction * modulus.front();
        if (modulus[k] <= limit && modulus[k - 1] > limit) {
            const double share = (modulus[k - 1] - limit) / (modulus[k - 1] - modulus[k]);
            return strain[k - 1] + share * (strain[k] - strain[k - 1]);
        }
    }
    return unset;
}

}  // namespace coagula::mechanics
