// Amplitude sweeps with bonds that break, by the explicit rheometer.
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/contact_law.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include "cache_key.hpp"
#include "unit_stiffness.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Nodes of the strength curve: amplitude over critical strain, from rest on. Past the last one nothing changes any more.
constexpr std::array<double, 16> loads{0, 1, 1.5, 2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 12, 16, 32};
/// Nodes on either side over which the scatter of the curves is pooled.
constexpr Index pooled_neighbours = 4;
/// Of freedom, for the scale of the errors, that one more structure adds: what breaks at once is so uneven that a curve counts for
/// no more (sets of 2, 4 and 8 of 32 structures of 400 particles against the others).
constexpr double degrees_of_structure = 3;
/// Of the explicit runs: what a run of this rate loses without breaking is taken off, but it must not shake bonds apart.
constexpr int steps_per_oscillation = 6000;
constexpr double damping = 0.7;
/// Phases of the first quarter of an oscillation over which its mean is taken.
constexpr int phases = 4;

ContactModel breaking_model(double ratio, double strength) {
    ContactModel model;
    model.normal_stiffness = unit_stiffness;
    model.shear_stiffness = ratio * unit_stiffness;
    model.normal_strength = strength;
    model.shear_strength = strength;
    return model;
}

/// Each number as the mean of itself and its neighbours.
Eigen::ArrayXd pooled(const Eigen::ArrayXd& values) {
    Eigen::ArrayXd means(values.size());
    for (Index k = 0; k < values.size(); ++k) {
        const Index from = std::max<Index>(0, k - pooled_neighbours);
        const Index to = std::min<Index>(values.size() - 1, k + pooled_neighbours);
        means[k] = values.segment(from, to - from + 1).mean();
    }
    return means;
}

/// Standard errors of the means of numbers that belong to the nodes of a curve, a column for each structure, whose variance is in
/// proportion to what breaks on the way to a node.
Eigen::ArrayXd standard_errors(const Eigen::MatrixXd& parts, const Eigen::ArrayXd& breaks) {
    const auto structures = static_cast<double>(parts.cols());
    const Eigen::ArrayXd scatter = pooled(parts.cwiseAbs2().rowwise().sum().array() / (structures - 1));
    const Eigen::ArrayXd share = (breaks > 0).select(breaks / pooled(breaks), 0);
    return (scatter * share / structures).sqrt();
}

/// The mean of the curves of several structures and, after it, that mean moved by each of its independent standard errors: at every
/// node one of what breaks there, which goes on in proportion to what is left and loses energy, and one of what else is lost.
/// @param curves nodes x structures: settled storage and, imaginary, the loss. @return the same, nodes x mean and errors.
Eigen::MatrixXcd mean_and_errors(const Eigen::MatrixXcd& curves) {
    const Eigen::VectorXcd mean = curves.rowwise().mean();
    const Index nodes = mean.size();
    if (curves.cols() < 2) {
        return mean;
    }
    Eigen::ArrayXd before(nodes);
    before << 1, mean.head(nodes - 1).array().real();
    const Eigen::ArrayXd kept = (before > 0).select(mean.array().real() / before, 0);
    const Eigen::MatrixXcd differences = curves.colwise() - mean;
    Eigen::MatrixXd broken = differences.real();
    broken.bottomRows(nodes - 1) -= kept.tail(nodes - 1).matrix().asDiagonal() * differences.real().topRows(nodes - 1);
    const double squares = broken.squaredNorm();
    const double cost = squares > 0 ? broken.cwiseProduct(differences.imag()).sum() / squares : 0.0;
    const Eigen::ArrayXd breaks = (before - mean.array().real()).max(0);
    const Eigen::ArrayXd breaking = standard_errors(broken, breaks);
    const Eigen::ArrayXd losing = standard_errors(differences.imag() - cost * broken, breaks);
    Eigen::MatrixXcd all = mean.replicate(1, 1 + 2 * nodes);
    for (Index node = 0; node < nodes; ++node) {
        double carried = breaking[node];
        all(node, 1 + node) += Complex(carried, cost * carried);
        for (Index later = node + 1; later < nodes; ++later) {
            carried *= kept[later];
            all(later, 1 + node) += carried;
        }
        all(node, 1 + nodes + node) += Complex(0, losing[node]);
    }
    return all;
}

/// What is lost in each oscillation of a curve summed up, times the square of the load: proportional to an energy.
/// @param curves rows x loads from rest on: settled storage and, imaginary, what is lost on the way from the load before.
void sum_up_losses(Eigen::MatrixXcd& curves) {
    for (Index node = 1; node < curves.cols(); ++node) {
        const double load = loads[static_cast<std::size_t>(node)];
        const Eigen::VectorXd sum = curves.col(node - 1).imag() + load * load * curves.col(node).imag();
        curves.col(node).imag() = sum;
    }
}

/// Between the nodes of the curves.
Eigen::VectorXcd at_load(const Eigen::MatrixXcd& curves, double load) {
    const auto above = std::upper_bound(loads.begin(), loads.end(), load);
    if (above == loads.end()) {
        return curves.rightCols(1);
    }
    const Index next = above - loads.begin();
    const double share = (load - *(above - 1)) / (*above - *(above - 1));
    return (1 - share) * curves.col(next - 1) + share * curves.col(next);
}

/// G* / G in the first oscillation at load `to`, of a network that had settled at load `from`, which is less. Half of the bonds
/// that break do so while the strain grows in its first quarter and half of them, those on the other side, in its third; until then
/// they carry load. What they lose is the energy between the two loads, however large the step.
Eigen::VectorXcd in_first_oscillation(const Eigen::MatrixXcd& curves, double from, double to) {
    const Eigen::VectorXcd before = at_load(curves, from);
    const Eigen::VectorXcd after = at_load(curves, to);
    Eigen::VectorXd growing = Eigen::VectorXd::Zero(after.size());
    for (int k = 0; k < phases; ++k) {
        const double sine = std::sin((k + 0.5) * pi / (2 * phases));
        growing += 2 * sine * sine / phases * at_load(curves, std::max(from, sine * to)).real();
    }
    Eigen::VectorXcd response(after.size());
    response.real() = 0.5 * after.real() + 0.25 * before.real() + 0.25 * growing;
    response.imag() = (after.imag() - before.imag()) / (to * to);
    return response;
}

}  // namespace

/// Two oscillations at each of some growing amplitudes by the explicit rheometer in a sheared cell, over the modulus at a strain so
/// small that nothing breaks. What the second one loses is the rate of the run, so that the first has lost the rest in breaking.
std::vector<Yielded> Simulator::sweep(std::size_t structure, const Settings& settings, double strength,
                                      const std::vector<double>& amplitudes) {
    mechanics::RheometerOptions options;
    options.model = breaking_model(settings.stiffness_ratio, strength);
    options.boundary = mechanics::RheometerBoundary::periodic;
    options.amplitude = amplitudes.back();
    options.steps_per_oscillation = steps_per_oscillation;
    options.damping = damping;
    options.compare_with_rest = false;
    options.course.assign(2, std::min(1e-3, 0.1 * settings.critical_strain / amplitudes.back()));
    for (const double amplitude : amplitudes) {
        options.course.insert(options.course.end(), 2, amplitude / amplitudes.back());
    }
    options.oscillations = static_cast<int>(options.course.size());
    const ContactNetwork bonds = find_contacts(structures_[structure], settings.bond_tolerance);
    const mechanics::RheometerRun run =
        mechanics::run_rheometer(structures_[structure], bonds, options, {mechanics::ShearOrientation{}}, progress_).runs.front();
    const double unbroken = run.oscillations[1].fundamental_storage;
    std::vector<Yielded> responses;
    for (std::size_t k = 2; k < run.oscillations.size(); k += 2) {
        const mechanics::Oscillation& one = run.oscillations[k];
        const mechanics::Oscillation& settled = run.oscillations[k + 1];
        const double lost = one.broken_bonds > 0 ? one.fundamental_loss - settled.fundamental_loss : 0.0;
        responses.push_back({Complex(one.fundamental_storage, lost) / unbroken, settled.fundamental_storage / unbroken});
    }
    return responses;
}

/// How one structure yields at the amplitudes of a sweep.
std::vector<Yielded> Simulator::structure_response(std::size_t structure, const Settings& settings,
                                                   const std::vector<double>& amplitudes) {
    // Strain times stiffness over strength is what counts, so that unit stiffness serves all.
    const double strength = settings.critical_strain * stiffness_in_series(unit_stiffness, unit_stiffness) * radius_;
    std::vector<double> what{settings.stiffness_ratio, settings.bond_tolerance, strength};
    what.insert(what.end(), amplitudes.begin(), amplitudes.end());
    const std::string key = key_of("yield " + names_[structure], what);
    auto found = cache_.find(key);
    if (found == cache_.end() || found->second.size() != 3 * amplitudes.size()) {
        progress_.update("simulating", 0.0, "amplitude sweep with breaking bonds");
        std::vector<double> values;
        for (const Yielded& response : sweep(structure, settings, strength, amplitudes)) {
            values.insert(values.end(), {response.first.real(), response.first.imag(), response.settled});
        }
        found = cache_.insert_or_assign(key, std::move(values)).first;
    }
    std::vector<Yielded> responses;
    for (std::size_t entry = 0; entry < amplitudes.size(); ++entry) {
        const double* values = found->second.data() + 3 * entry;
        responses.push_back({Complex(values[0], values[1]), values[2]});
    }
    return responses;
}

/// How one structure yields at the nodes of the strength curve but rest.
std::vector<Yielded> Simulator::nodes_of_strength_curve(std::size_t structure) {
    Settings settings;
    settings.critical_strain = 1e-4;
    std::vector<double> amplitudes;
    for (const double load : loads) {
        amplitudes.push_back(load * settings.critical_strain);
    }
    amplitudes.erase(amplitudes.begin());  // at rest
    return structure_response(structure, settings, amplitudes);
}

/// Largest strain up to which no bond of a structure breaks, as far as the strength curve tells.
double Simulator::unbroken_strain(std::size_t structure, const Settings& settings) {
    const Settings base;
    double load = 0;
    if (settings.stiffness_ratio == base.stiffness_ratio && settings.bond_tolerance == base.bond_tolerance) {
        const std::vector<Yielded> nodes = nodes_of_strength_curve(structure);
        for (std::size_t node = 0; node < nodes.size() && nodes[node].first.imag() == 0; ++node) {
            load = loads.at(node + 1);
        }
    }
    return load * settings.critical_strain;
}

std::vector<Yielded> Simulator::exact_amplitude_response(const Settings& settings, const std::vector<double>& amplitudes) {
    std::vector<Yielded> mean(amplitudes.size());
    const double share = 1 / static_cast<double>(structures_.size());
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        const auto breaking = std::upper_bound(amplitudes.begin(), amplitudes.end(), unbroken_strain(k, settings));
        std::vector<Yielded> one(static_cast<std::size_t>(breaking - amplitudes.begin()), {1, 1});
        if (breaking != amplitudes.end()) {
            const std::vector<Yielded> run = structure_response(k, settings, {breaking, amplitudes.end()});
            one.insert(one.end(), run.begin(), run.end());
        }
        for (std::size_t entry = 0; entry < mean.size(); ++entry) {
            mean[entry].first += share * one[entry].first;
            mean[entry].settled += share * one[entry].settled;
        }
    }
    return mean;
}

/// Mean and errors x loads from rest on: storage modulus once nothing breaks any more, and what was lost up to there, in units of
/// an oscillation at the critical strain.
const Eigen::MatrixXcd& Simulator::strength_curves() {
    if (strength_curves_.size() > 0) {
        return strength_curves_;
    }
    constexpr auto nodes = static_cast<Index>(loads.size()) - 1;
    Eigen::MatrixXcd curves(nodes, static_cast<Index>(structures_.size()));
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        const std::vector<Yielded> one = nodes_of_strength_curve(k);
        for (Index node = 0; node < nodes; ++node) {
            const Yielded& response = one[static_cast<std::size_t>(node)];
            curves(node, static_cast<Index>(k)) = Complex(response.settled, response.first.imag());
        }
    }
    const Eigen::MatrixXcd all = mean_and_errors(curves);
    strength_curves_.setOnes(all.cols(), nodes + 1);
    strength_curves_.rightCols(nodes) = all.transpose();
    sum_up_losses(strength_curves_);
    return strength_curves_;
}

double Simulator::yield_degrees() const {
    return degrees_of_structure * (static_cast<double>(structures_.size()) - 1);
}

Eigen::VectorXcd Simulator::amplitude_response(const Settings& settings, double before, double amplitude) {
    if (!std::isfinite(settings.critical_strain)) {
        return Eigen::VectorXcd::Ones(1);
    }
    const Eigen::MatrixXcd& curves = strength_curves();
    if (amplitude > before) {
        return in_first_oscillation(curves, before / settings.critical_strain, amplitude / settings.critical_strain);
    }
    return at_load(curves, before / settings.critical_strain).real().cast<Complex>();
}

}  // namespace coagula::diagnose
