// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/frequency.hpp>

#include "bond_tangents.hpp"
#include "frequency_network.hpp"
#include "solvers/block_factor.hpp"
#include "solvers/complex_gradients.hpp"
#include "solvers/load_bearing.hpp"
#include "solvers/resisted_strains.hpp"

#include <coagula/common/blas_threads.hpp>
#include <coagula/mechanics/orientation.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

namespace coagula::mechanics {

namespace {

constexpr int blas_threads = 2;               // fixed: the bits of a factor depend on it
constexpr int most_iterations = 60;           // a good shift needs fewer than ten
constexpr int most_borrowed_iterations = 18;  // with the factor of another frequency: more would cost as much as a new one
constexpr double largest_shift = 1e-5;

void check(const Packing& packing, const ContactNetwork& bonds, std::span<const double> frequencies,
           const FrequencyOptions& options) {
    require(bonds.particles == packing.size(), "the bonds belong to a packing of " + std::to_string(bonds.particles) +
                                                   " particles, the packing has " + std::to_string(packing.size()));
    require(packing.cell.is_periodic(), "the frequency response needs a periodic cell; the packing has a free surface");
    for (const double frequency : frequencies) {
        require_positive(frequency, "the frequency", "Hz");
    }
    require_between(options.tolerance, 0.0, 1e-2, "the tolerance of the solver");
    require_between(options.shift, 0.0, largest_shift, "the shift of the preconditioner");
}

/// Every particle of a pair, for with drag a dangling one loads the network, too.
LoadBearing everything(const ContactNetwork& pairs) {
    const Eigen::VectorXi degree = contact_counts(pairs);
    LoadBearing kept;
    kept.number.assign(static_cast<std::size_t>(pairs.particles), -1);
    for (Index particle = 0; particle < pairs.particles; ++particle) {
        if (degree[particle] > 0) {
            kept.number[static_cast<std::size_t>(particle)] = static_cast<Index>(kept.particle.size());
            kept.particle.push_back(particle);
        }
    }
    for (Index pair = 0; pair < pairs.size(); ++pair) {
        kept.bond.push_back(pair);
    }
    return kept;
}

bool has_drag(const ContactModel& model) {
    return !std::isnan(model.solvent_viscosity);
}

/// Solves at one frequency after the other with one analysis of the pattern.
class SweepSolver {
public:
    SweepSolver(const FrequencyNetwork& network, const FrequencyOptions& options) : network_(network), options_(options) {
        std::vector<int> row;
        std::vector<int> column;
        network.scalar_pattern(row, column);
        const EliminationOrder order = elimination_order(network.upper(), Ordering::nested_dissection);
        factor_ = std::make_unique<ComplexSymmetricFactor>(row, column, order.permutation());
    }

    ComplexSolution solve(const Ratios& ratios) {
        const ComplexBlocks matrix = network_.matrix(ratios);
        if (serves(ratios)) {
            ComplexSolution solution = iterate(matrix, ratios);
            if (solution.residual <= 2 * options_.tolerance) {
                return solution;
            }
        }
        ComplexSolution best;
        for (double shift = options_.shift; shift <= largest_shift; shift *= 100) {
            factorise(matrix, ratios, shift);
            best = iterate(matrix, ratios);
            if (best.residual <= 2 * options_.tolerance) {
                return best;
            }
        }
        throw std::runtime_error("the residual " + to_text(options_.tolerance) + " was not reached, only " +
                                 to_text(best.residual) +
                                 "; the network is too close to losing its stiffness, or the tolerance is too small");
    }

private:
    /// Whether the factor of an earlier frequency is a good preconditioner: the stiffnesses along, across and of the drag have
    /// changed by factors between 1 and z, and conjugate gradients then gain tanh(|log z| / 4) per iteration. Not so without drag,
    /// where free motions slow them down: a new factor is cheaper there.
    bool serves(const Ratios& ratios) const {
        const auto is_damped = [&](const Ratios& r) { return translation_drag(std::abs(r.drag)) >= options_.shift; };
        if (!factorised_ || !is_damped(ratios) || !is_damped(*factorised_)) {
            return false;
        }
        return std::pow(std::tanh(network_.change(ratios, *factorised_) / 4), most_borrowed_iterations) < options_.tolerance;
    }

    ComplexSolution iterate(const ComplexBlocks& matrix, const Ratios& ratios) const {
        return conjugate_orthogonal_gradients([&](const ComplexLoads& x, ComplexLoads& y) { network_.multiply(matrix, x, y); },
                                              network_.loads(ratios), network_.load_scale(),
                                              [&](const ComplexLoads& r, ComplexLoads& z) { factor_->solve(r, z); },
                                              options_.tolerance, most_iterations);
    }

    /// Without drag some motions have no stiffness and get the shift. With drag none is free, but at low frequency the drag may
    /// drown in rounding errors beside the bonds; the preconditioner then has more of the same drag.
    void factorise(const ComplexBlocks& matrix, const Ratios& ratios, double shift) {
        factorised_ = ratios;
        const double drag = translation_drag(std::abs(ratios.drag));
        if (drag == 0) {
            factor_->factorise(network_.scalar_values(matrix, shift));
        } else if (drag >= shift) {
            factor_->factorise(network_.scalar_values(matrix, 0));
        } else {
            const Complex phase = ratios.drag / std::abs(ratios.drag);
            Ratios damped = ratios;
            damped.drag = phase * (shift / translation_drag(1));
            factor_->factorise(network_.scalar_values(network_.matrix(damped), 0));
        }
    }

    const FrequencyNetwork& network_;
    FrequencyOptions options_;
    std::unique_ptr<ComplexSymmetricFactor> factor_;
    std::optional<Ratios> factorised_;  ///< what the factor was made for
};

/// What turns the reduced sums into moduli at one angular frequency w.
struct Scales {
    double per_volume;        ///< r0^2 / V [1/m]
    double springs;           ///< reference stiffness of the springs [N/m]
    ContactStiffness losses;  ///< of a contact
    Complex drag;             ///< i w eta r0 [N/m]; 0: no solvent
    Complex drag_rate;        ///< its derivative by eta

    Complex reference() const { return springs + losses.normal; }
    Ratios ratios() const {
        const Complex whole = reference();
        return {springs / whole, losses.normal / whole, losses.shear / whole, drag / whole};
    }
};

Scales scales_of(const Packing& packing, const ContactModel& model, double springs, double w) {
    ContactModel without_springs = model;
    without_springs.normal_stiffness = without_springs.shear_stiffness = 0;
    const double r0 = mean_radius(packing);
    const Complex rate(0, w * r0);
    return {.per_volume = r0 * r0 / packing.cell.volume(),
            .springs = springs,
            .losses = complex_stiffness(without_springs, w),
            .drag = has_drag(model) ? rate * model.solvent_viscosity : Complex(0),
            .drag_rate = rate};
}

/// Derivative of the modulus by a loss.
ComplexTensor loss_derivative(const Forms& forms, const ContactModel& model, const Scales& scales, double w,
                              const ContactParameter& parameter) {
    if (parameter.value == &ContactModel::solvent_viscosity) {
        return scales.per_volume * scales.drag_rate * forms.drag;
    }
    if (parameter.value == &ContactModel::lubrication_gap) {
        return -scales.per_volume / model.lubrication_gap * scales.drag * forms.rough;
    }
    const ContactStiffness k = stiffness_derivative(model, w, parameter.value);
    return scales.per_volume * (k.normal * forms.along + k.shear * forms.across);
}

void fill_point(FrequencyPoint& point, const Forms& forms, const ContactModel& model, const Scales& scales,
                std::span<const ContactParameter> parameters) {
    const double w = 2 * std::numbers::pi * point.frequency;
    const ContactStiffness& losses = scales.losses;
    point.modulus = scales.per_volume * (scales.springs * forms.springs + losses.normal * forms.along +
                                         losses.shear * forms.across + scales.drag * forms.drag);
    std::size_t change = 0;
    for (const ContactParameter& parameter : parameters) {
        const bool is_spring = parameter.role == ContactRole::spring;
        point.derivative.push_back(is_spring ? ComplexTensor(scales.per_volume * scales.springs * forms.changes.at(change++))
                                             : loss_derivative(forms, model, scales, w, parameter));
    }
    point.dissipation = std::numbers::pi * scales.per_volume *
                        (losses.normal.imag() * forms.along_power + losses.shear.imag() * forms.across_power +
                         scales.drag.imag() * forms.drag_power);
}

FrequencyPoint start_point(double frequency, const ContactStiffness& springs, const ContactStiffness& losses) {
    FrequencyPoint point;
    point.frequency = frequency;
    point.contact_stiffness = {springs.normal + losses.normal, springs.shear + losses.shear};
    const ContactStiffness& k = point.contact_stiffness;
    require(std::isfinite(std::norm(k.normal)) && std::isfinite(std::norm(k.shear)),
            "the stiffness of a contact at " + to_text(frequency) + " Hz is too large a number: the frequency is out of range");
    return point;
}

/// Nothing is stored or lost under strains that no cluster of bonds resists.
void clear_unresisted(const std::array<bool, 6>& resisted, FrequencyPoint& point) {
    clear_others(resisted, point.modulus);
    for (auto& derivative : point.derivative) {
        clear_others(resisted, derivative);
    }
    for (std::size_t strain = 0; strain < resisted.size(); ++strain) {
        point.dissipation[static_cast<Index>(strain)] *= resisted[strain] ? 1 : 0;
    }
}

/// No result is better than one that is no number.
void check_finite(const FrequencyPoint& point) {
    const bool finite = point.modulus.allFinite() &&
                        std::all_of(point.derivative.begin(), point.derivative.end(), [](const auto& d) { return d.allFinite(); });
    require(finite, "the response at " + to_text(point.frequency) +
                        " Hz is not a finite number: the frequency or a parameter of the contact model is out of range");
}

/// The parameters that the model has and that act at vanishing strain.
std::vector<ContactParameter> acting_parameters(const ContactModel& model) {
    std::vector<ContactParameter> acting;
    const auto all = contact_parameters();
    std::copy_if(all.begin(), all.end(), std::back_inserter(acting),
                 [&](const auto& p) { return p.is_set(model) && p.role != ContactRole::limit; });
    return acting;
}

/// Mean stiffness of the springs of the bonds.
ContactStiffness mean_springs(const FrequencyPairs& pairs, const ContactModel& model) {
    if (pairs.bonds == 0) {
        return {model.normal_stiffness / 2, model.shear_stiffness / 2};
    }
    const ContactTangent mean = mean_tangent(std::span(pairs.tangents).first(static_cast<std::size_t>(pairs.bonds)));
    return {mean.normal, mean.shear};
}

/// Derivatives of the springs by each parameter of the role `spring`, reduced, by the bonds of the network.
std::vector<std::vector<ContactTangent>> spring_changes(const Packing& packing, const ContactNetwork& bonds,
                                                        const FrequencyPairs& pairs, const LoadBearing& kept,
                                                        const ContactModel& model, std::span<const ContactParameter> parameters) {
    std::vector<std::vector<ContactTangent>> changes;
    for (const ContactParameter& parameter : parameters) {
        if (parameter.role == ContactRole::spring) {
            std::vector<ContactTangent> tangents = tangent_derivatives(packing, bonds, model, parameter);
            tangents.resize(pairs.tangents.size());
            const LinearNetwork network(packing, pairs.network, kept, tangents, mean_springs(pairs, model).normal.real());
            changes.emplace_back();
            for (const LinearBond& bond : network.bonds()) {
                changes.back().push_back(bond.tangent);
            }
        }
    }
    return changes;
}

/// Harmonic motion about an unstable state means nothing. Prestress can make a state unstable: then the springs have no factor.
void check_stability(const FrequencyNetwork& network, const FrequencyPairs& pairs, const FrequencyOptions& options) {
    if (may_be_unstable(pairs.tangents)) {
        try {
            const CholeskyFactor factor(shifted(network.upper(), options.shift),
                                        elimination_order(network.upper(), Ordering::nested_dissection));
        } catch (const std::runtime_error& error) {
            throw std::runtime_error(std::string("the bonded network is not stable under its prestress: ") + error.what());
        }
    }
}

}  // namespace

FrequencyResponse solve_frequency_sweep(const Packing& packing, const ContactNetwork& bonds, const ContactModel& model,
                                        std::span<const double> frequencies, const FrequencyOptions& options,
                                        const Progress& progress) {
    coagula::check(model);
    check(packing, bonds, frequencies, options);
    FrequencyResponse response;
    response.parameters = acting_parameters(model);
    const FrequencyPairs pairs = find_frequency_pairs(packing, bonds, model);
    const ContactStiffness springs = mean_springs(pairs, model);
    check_tangents(bonds, {pairs.tangents.begin(), pairs.tangents.begin() + bonds.size()});
    const LoadBearing kept =
        has_drag(model) ? everything(pairs.network) : find_load_bearing(bonds, {}, resist_moments(pairs.tangents));
    response.contacts = bonds.size();
    response.rattlers = packing.size() - static_cast<Index>(kept.particle.size());

    std::array<bool, 6> resisted{};
    resisted.fill(true);
    if (!has_drag(model)) {
        resisted = resisted_strains(packing, bonds);
    }

    const BlasThreads threads(blas_threads);
    const FrequencyNetwork network(packing, pairs, kept, springs.normal.real());
    const auto changes = spring_changes(packing, bonds, pairs, kept, model, response.parameters);
    std::unique_ptr<SweepSolver> solver;
    if (!kept.particle.empty()) {
        check_stability(network, pairs, options);
        solver = std::make_unique<SweepSolver>(network, options);
    }
    for (const double frequency : frequencies) {
        progress.update("frequency sweep", static_cast<double>(response.points.size()) / static_cast<double>(frequencies.size()),
                        to_text(frequency) + " Hz");
        const Scales scales = scales_of(packing, model, springs.normal.real(), 2 * std::numbers::pi * frequency);
        FrequencyPoint point = start_point(frequency, springs, scales.losses);
        Forms forms;
        forms.changes.assign(changes.size(), Forms::Tensor::Zero());
        if (solver) {
            const ComplexSolution solution = solver->solve(scales.ratios());
            point.iterations = solution.iterations;
            point.residual = solution.residual;
            forms = network.forms(solution.motion, changes);
        }
        fill_point(point, forms, model, scales, response.parameters);
        clear_unresisted(resisted, point);
        check_finite(point);
        response.points.push_back(std::move(point));
    }
    return response;
}

Complex FrequencyPoint::shear_modulus(int a, int b) const {
    require(a >= 0 && a < 3 && b >= 0 && b < 3 && a != b, "a shear orientation is named by two different axes of 0, 1, 2");
    const int place = ShearOrientation{a, b}.voigt();
    return modulus(place, place);
}

Complex FrequencyPoint::mean_shear_modulus() const {
    return modulus.diagonal().tail<3>().mean();
}

Complex FrequencyPoint::mean_derivative(std::size_t parameter) const {
    return derivative.at(parameter).diagonal().tail<3>().mean();
}

}  // namespace coagula::mechanics
