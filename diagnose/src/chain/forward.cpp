// SPDX-License-Identifier: GPL-3.0-or-later
#include "forward.hpp"

#include "data/median.hpp"
#include "responses/fundamental.hpp"
#include "responses/imaged_centres.hpp"
#include "responses/pore_response.hpp"
#include "shared_errors.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <map>
#include <utility>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;

/// What the simulation of the material depends on, for unit normal stiffness: of the viscosity, its ratio to the stiffness.
Settings of_material(Settings settings) {
    settings.felt_viscosity /= settings.normal_stiffness;
    settings.normal_stiffness = 1;
    return settings;
}

/// Returns the moduli of a viscosity of 1 Pa.s; in steady flow the viscosity itself.
Eigen::VectorXcd newtonian_moduli(const std::vector<Observation>& observations) {
    Eigen::VectorXcd moduli(static_cast<Index>(observations.size()));
    for (Index row = 0; row < moduli.size(); ++row) {
        const Observation& one = observations[static_cast<std::size_t>(row)];
        moduli[row] = Complex(0, is<Viscosity>(one) ? 1 : one.angular_frequency);
    }
    return moduli;
}

Conditions conditions_of(const Observation& observation) {
    return {observation.strain, observation.angular_frequency, observation.structures};
}

/// Whether the material's own modulus is in the number.
bool shows_network(const Observation& observation) {
    return is_modulus_or_viscosity(observation) && !is_fluid(observation);
}

/// Returns for every observation the first one with the same key; itself where it has none.
template <class Has, class Key>
std::vector<std::size_t> firsts(const std::vector<Observation>& observations, const Has& has_key, const Key& key_of) {
    std::map<decltype(key_of(observations.front())), std::size_t> found;
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const Observation& one = observations[k];
        all.push_back(has_key(one) ? found.try_emplace(key_of(one), k).first->second : k);
    }
    return all;
}

/// The first one that shows the same G*, as G' does beside G'' of a row.
std::vector<std::size_t> first_of_rows(const std::vector<Observation>& observations) {
    return firsts(observations, is_modulus_or_viscosity, [](const Observation& one) {
        return std::pair{one.measurement, one.row};
    });
}

/// The first one at the same frequency, of the same structures.
std::vector<std::size_t> first_of_frequencies(const std::vector<Observation>& observations) {
    return firsts(observations, shows_network, [](const Observation& one) {
        return std::pair{std::isfinite(one.angular_frequency) ? one.angular_frequency : -1.0, one.structures};
    });
}

/// Selects the mechanisms that change the material.
std::vector<ActingMechanism> acting_on_material(const Model& model) {
    std::vector<ActingMechanism> some;
    std::copy_if(model.acting.begin(), model.acting.end(), std::back_inserter(some), [](const ActingMechanism& one) {
        return std::holds_alternative<ScalesMaterial>(one.mechanism->effect) ||
               std::holds_alternative<BendsStress>(one.mechanism->effect);
    });
    return some;
}

}  // namespace

void check_structure_series(const Experiment& experiment, const std::vector<Observation>& observations) {
    for (const Observation& observation : observations) {
        const Measurement& table = experiment.measurements[observation.measurement];
        if (table.kind != MeasurementKind::structure_series) {
            continue;
        }
        if (experiment.structure_groups.empty()) {
            throw InputError(table.label +
                             ": a structure series needs structures.groups, which says what rows a structure stands for");
        }
        const auto& groups = experiment.structure_groups;
        if (std::find(groups.begin(), groups.end(), observation.structures) == groups.end()) {
            throw InputError(table.label + ": no structure stands for row " + std::to_string(observation.row + 1) + ", structure " +
                             std::to_string(observation.structures));
        }
    }
}

Forward::Forward(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator)
    : experiment_(experiment),
      observations_(observations),
      first_of_row_(first_of_rows(observations)),
      first_of_frequency_(first_of_frequencies(observations)),
      simulator_(simulator),
      runs_(run_times(experiment)),
      history_(experiment) {
    bond_strains_ = bond_strains(Settings{});
    check_structure_series(experiment_, observations_);
    if (experiment_.material.kind == MaterialKind::smooth) {
        smooth_.emplace(observations_, experiment_.material.ages);
    }
    shared_ = shared_errors(experiment_, observations_, simulator_);
}

/// Modulus that plates or cone and the tool show of one of the material.
Complex Forward::seen_by_instrument(const Model& model, std::size_t number, Complex modulus) const {
    const Observation& observation = observations_[number];
    model.for_each<ChangesGeometry>(
        [&](const ChangesGeometry& effect, Values values) { modulus = effect.apparent(modulus, observation, values); });
    model.for_each<ChangesTool>(
        [&](const ChangesTool& effect, Values values) { modulus = effect.apparent(modulus, observation, values); });
    return modulus;
}

/// Factor of a response at every observation of the network; 1 where it does not act.
Eigen::VectorXcd Forward::factors_of(const Response& response, const Settings& settings, bool exact) const {
    Eigen::VectorXcd factors = Eigen::VectorXcd::Ones(static_cast<Index>(observations_.size()));
    const std::vector<std::size_t>& alike = first_alike(response);
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Conditions here = conditions_of(observations_[k]);
        if (const std::size_t first = alike[k]; first < k) {
            factors[static_cast<Index>(k)] = factors[static_cast<Index>(first)];
        } else if (shows_network(observations_[k]) && response.acts(settings, here)) {
            factors[static_cast<Index>(k)] = response.factor(simulator_, settings, here, exact);
        }
    }
    return factors;
}

/// G* / G of what acts in the contacts and between the particles while no bond breaks.
Eigen::VectorXcd Forward::linear_responses(const Settings& settings, bool exact) const {
    Eigen::VectorXcd factors = Eigen::VectorXcd::Ones(static_cast<Index>(observations_.size()));
    for (const Response& response : network_responses()) {
        factors.array() *= factors_of(response, settings, exact).array();
    }
    return factors;
}

/// G* of the material at every observation for a scale of 1, to which it is proportional; of a fluid as it is.
UncertainModuli Forward::material(const Model& model, bool exact) const {
    UncertainModuli moduli;
    switch (experiment_.material.kind) {
        case MaterialKind::network:
            moduli = network(model, exact);
            break;
        case MaterialKind::newtonian:
            moduli = UncertainModuli(newtonian_moduli(observations_));
            break;
        case MaterialKind::smooth:
            moduli = smooth_->moduli();
            break;
    }
    replace_fluids(moduli);
    scale(moduli, model, exact);
    return moduli;
}

/// Multiplies the moduli by the factors of the causes that change the material in a row.
void Forward::scale(UncertainModuli& moduli, const Model& model, bool exact) const {
    const Settings settings = of_material(model.simulated());
    const SimulatedSample sample{experiment_, simulator_, settings, history_, exact};
    Eigen::VectorXcd factors = Eigen::VectorXcd::Ones(moduli.mean.size());
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        Complex& factor = factors[static_cast<Index>(k)];
        if (const std::size_t first = first_of_row_[k]; first < k) {
            factor = factors[static_cast<Index>(first)];
        } else if (is_modulus_or_viscosity(observations_[k])) {
            const bool fluid = is_fluid(observations_[k]);
            model.for_each<ScalesMaterial>([&](const ScalesMaterial& effect, Values values) {
                factor *= fluid && !effect.in_oil ? 1 : effect.factor(observations_[k], values, sample);
            });
            if (const double amplitude = observations_[k].strain; std::isfinite(amplitude) && !fluid) {
                model.for_each<BendsStress>([&](const BendsStress& effect, Values values) {
                    factor *= fundamental(amplitude, [&](double strain) { return effect.secant(strain, values); });
                });
            }
        }
    }
    moduli.mean.array() *= factors.array();
    moduli.changes = factors.asDiagonal() * moduli.changes;
}

/// A fluid where one was in place of the sample.
void Forward::replace_fluids(UncertainModuli& moduli) const {
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        if (const Observation& observation = observations_[k]; is_fluid(observation)) {
            const double per_viscosity = is<Viscosity>(observation) ? 1 : observation.angular_frequency;
            moduli.mean[static_cast<Index>(k)] = Complex(0, observation.fluid_viscosity * per_viscosity);
            moduli.changes.row(static_cast<Index>(k)).setZero();
            moduli.dragged[static_cast<Index>(k)] = 0;
        }
    }
}

/// Moduli of the network for a normal stiffness of 1 N/m, and third harmonics over the first: means over the structures, with
/// errors in how these yield and are dragged on.
UncertainModuli Forward::network(const Model& model, bool exact) const {
    const Settings settings = of_material(model.simulated());
    const std::vector<BondStrain> bonds = bond_strains(settings);
    std::map<std::size_t, double> linear;  // moduli by group
    const Eigen::VectorXcd responses = linear_responses(settings, exact);
    Eigen::VectorXcd moduli = Eigen::VectorXcd::Zero(static_cast<Index>(observations_.size()));
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        Complex& modulus = moduli[static_cast<Index>(k)];
        if (const std::size_t first = first_of_row_[k]; first < k) {
            modulus = moduli[static_cast<Index>(first)];
        } else if (is<Harmonic>(observation)) {
            modulus = third_harmonic(model, settings, observation, bonds[k]);
        } else if (shows_network(observation)) {
            const Conditions here = conditions_of(observation);
            const auto [found, added] = linear.try_emplace(here.group, 0.0);
            if (added) {
                found->second = exact ? exact_linear_modulus(simulator_, settings, here.group)
                                      : linear_modulus(simulator_, settings, here.group);
            }
            modulus = found->second * responses[static_cast<Index>(k)];
        }
    }
    const Eigen::MatrixXcd yielding = moduli.asDiagonal() * amplitude_factors(settings, exact);
    const Eigen::Index yield_errors = yielding.cols() - 1;
    UncertainModuli all(yielding.col(0), yielding.rightCols(yield_errors).colwise() - yielding.col(0));
    if (yield_errors > 0) {
        all.degrees = yield_degrees(simulator_);
    }
    for (const Response& response : network_responses()) {
        if (!exact && response.scatter != nullptr) {
            add_scatter(response, settings, all);
        }
    }
    return all;
}

/// Adds the errors of a response, also where no row shows them: other rows of the same structures may.
void Forward::add_scatter(const Response& response, const Settings& settings, UncertainModuli& moduli) const {
    const Conditions anywhere{.strain = 1, .angular_frequency = 1};
    if (!response.acts(settings, anywhere)) {
        return;
    }
    const Scatter any = response.scatter(simulator_, settings, anywhere);
    const Index rows = moduli.mean.size();
    Eigen::MatrixXcd changes = Eigen::MatrixXcd::Zero(rows, moduli.changes.cols() + any.relative.size());
    changes.leftCols(moduli.changes.cols()) = moduli.changes;
    moduli.changes = std::move(changes);
    moduli.logarithms.conservativeResizeLike(Eigen::MatrixXcd::Zero(rows, moduli.logarithms.cols() + any.logarithmic.size()));
    moduli.degrees = std::min(moduli.degrees, response.degrees(simulator_));
    const Eigen::VectorXcd factors = any.logarithmic.size() > 0 ? factors_of(response, settings, false) : Eigen::VectorXcd();
    std::map<std::size_t, Scatter> known;
    for (Index row = 0; row < rows; ++row) {
        const auto number = static_cast<std::size_t>(row);
        const Conditions here = conditions_of(observations_[number]);
        if (!shows_network(observations_[number]) || !response.acts(settings, here)) {
            continue;
        }
        const auto [found, added] = known.try_emplace(first_alike(response)[number]);
        if (added) {
            found->second = response.scatter(simulator_, settings, here);
        }
        const Scatter& scatter = found->second;
        moduli.changes.row(row).tail(scatter.relative.size()) = moduli.mean[row] * scatter.relative;
        if (scatter.logarithmic.size() > 0) {
            moduli.dragged[row] = 1.0 - 1.0 / factors[row];
            moduli.excess[row] = scatter.expected;
            moduli.logarithms.row(row) = scatter.logarithmic;
        }
    }
}

const UncertainModuli& Forward::remembered_material(const Model& model, bool exact) const {
    const Settings settings = of_material(model.simulated());
    const std::vector<ActingMechanism> acting = acting_on_material(model);
    if (exact || last_material_.mean.size() == 0 || !(settings == last_settings_ && acting == last_acting_)) {
        last_material_ = material(model, exact);
        last_settings_ = exact ? Settings{.normal_stiffness = unset} : settings;  // what is exact serves once
        last_acting_ = acting;
    }
    return last_material_;
}

/// What coordinates and pore curves show.
double Forward::seen_of_structure(const Settings& settings, const Observation& observation, bool exact) const {
    if (const auto* seen = as<Neighbours>(observation)) {
        double sum = 0;
        for (std::size_t shell = observation.row; shell < observation.row + seen->shells; ++shell) {
            sum += neighbours(simulator_, settings, shell, exact);
        }
        return sum;
    }
    if (const auto* images = as<ImageDifference>(observation)) {
        return repeated_images(simulator_, settings, exact)[static_cast<std::size_t>(images->quantity)];
    }
    return exclusion_probability(simulator_, settings,
                                 std::get<Pore>(observation.what).radius * simulator_.radius() / experiment_.sample.particle_radius,
                                 exact);
}

/// What the instrument shows of every observation, of these moduli of the material at a normal stiffness of 1 N/m.
Eigen::VectorXd Forward::seen(const Model& model, const Eigen::VectorXcd& moduli, bool exact) const {
    const Settings settings = model.simulated();
    Eigen::VectorXd predicted(static_cast<Index>(observations_.size()));
    Eigen::VectorXcd shown(predicted.size());
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        const auto i = static_cast<Index>(k);
        if (is<Harmonic>(observation)) {
            predicted[i] = part_of(moduli[i], observation);
        } else if (!is_modulus_or_viscosity(observation)) {
            predicted[i] = seen_of_structure(settings, observation, exact);
        } else {
            const double scale = scales(observation) ? settings.normal_stiffness : 1.0;
            const auto first = static_cast<Index>(first_of_row_[k]);
            const bool known = first < i && moduli[i] == moduli[first];
            shown[i] = known ? shown[first] : seen_by_instrument(model, k, scale * moduli[i]);
            predicted[i] = part_of(shown[i], observation);
        }
    }
    return predicted;
}

Eigen::VectorXd Forward::predict(const Model& model, bool exact) const {
    const Settings settings = model.simulated();
    if (exact && settings.structures != StructureChange{}) {
        Model stated(as_stated(settings));
        std::copy_if(model.acting.begin(), model.acting.end(), std::back_inserter(stated.acting),
                     [](const ActingMechanism& one) { return !std::holds_alternative<ChangesSimulation>(one.mechanism->effect); });
        return Forward(experiment_, observations_, simulator_.remade(settings.structures)).predict(stated, true);
    }
    return smooth_ ? predict(model, smooth_->start()) : seen(model, remembered_material(model, exact).mean, exact);
}

/// Errors that all rows share, of structures as the model has them.
const Eigen::MatrixXd& Forward::shared_errors_of(const Model& model) const {
    const StructureChange change = model.simulated().structures;
    if (change != shared_change_) {
        const Eigen::MatrixXd pores = errors_of_pores(experiment_, observations_, simulator_, change);
        shared_.rightCols(pores.cols()) = pores;
        shared_change_ = change;
    }
    return shared_;
}

Eigen::VectorXd Forward::predict(const Model& model, const Eigen::VectorXd& errors) const {
    const Eigen::MatrixXd& shared = shared_errors_of(model);
    return seen(model, remembered_material(model, false).with(errors.head(errors.size() - shared.cols())), false) +
           shared * errors.tail(shared.cols());
}

Eigen::VectorXd Forward::structure_deviation(const Eigen::VectorXd& values) const {
    Eigen::VectorXd deviation = Eigen::VectorXd::Zero(values.size());
    if (experiment_.structure_groups.empty()) {
        return deviation;
    }
    const Eigen::VectorXd base = predict(Model{});
    std::vector<double> ratios;
    for (Index row = 0; row < values.size(); ++row) {
        const std::size_t group = observations_[static_cast<std::size_t>(row)].structures;
        if (group > 0 && base[row] != 0) {
            ratios.push_back(std::abs(values[row] / base[row]));
            deviation[row] = structure_error(simulator_, group) * std::abs(base[row]);
        }
    }
    if (!ratios.empty()) {
        deviation *= median(std::move(ratios));
    }
    return deviation;
}

}  // namespace coagula::diagnose
