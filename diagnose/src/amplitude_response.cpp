// Amplitude sweeps with bonds that break, by the explicit rheometer.
#include <coagula/diagnose/simulator.hpp>

#include <coagula/common/contact_law.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/mechanics/rheometer.hpp>

#include "cache_key.hpp"
#include "unit_stiffness.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Amplitude over critical strain of the strength curve: equal steps.
constexpr double load_step = 0.25;
constexpr int load_nodes = 32;
/// Shapes in which the curves of structures may differ, of G' and of G'' each.
constexpr Index shape_orders = 8;
/// Scatter that cannot be told from none [1].
constexpr double least_scatter = 1e-4;
/// Of the explicit run behind it.
constexpr int steps_per_oscillation = 3000;

ContactModel breaking_model(double ratio, double strength) {
    ContactModel model;
    model.normal_stiffness = unit_stiffness;
    model.shear_stiffness = ratio * unit_stiffness;
    model.normal_strength = strength;
    model.shear_strength = strength;
    return model;
}

/// Smooth shapes of unit mean square over the loads, a column each: a constant and half waves.
Eigen::MatrixXd smooth_shapes(Index loads) {
    Eigen::MatrixXd shapes(loads, shape_orders);
    for (Index order = 0; order < shape_orders; ++order) {
        for (Index load = 0; load < loads; ++load) {
            const double wave =
                std::cos(pi * static_cast<double>(order) * (static_cast<double>(load) + 0.5) / static_cast<double>(loads));
            shapes(load, order) = (order == 0 ? 1 : std::numbers::sqrt2) * wave;
        }
    }
    return shapes;
}

/// Each number as the mean of itself and its neighbours up to this distance.
Eigen::ArrayXd pooled(const Eigen::ArrayXd& values, Index distance) {
    Eigen::ArrayXd means(values.size());
    for (Index k = 0; k < values.size(); ++k) {
        const Index from = std::max<Index>(0, k - distance);
        const Index to = std::min<Index>(values.size() - 1, k + distance);
        means[k] = values.segment(from, to - from + 1).mean();
    }
    return means;
}

/// Independent standard errors of the mean of curves, a column each. Few curves say how much they scatter at each load and how
/// smooth their differences are, but not which shapes these can have: the errors are smooth shapes in proportion to the scatter,
/// each as large as the differences of the curves have it, pooled with its neighbours.
/// @param differences of the curves from their mean: loads x curves.
Eigen::MatrixXd errors_of_mean(const Eigen::MatrixXd& differences) {
    const auto curves = static_cast<double>(differences.cols());
    const Eigen::ArrayXd scatter = pooled(differences.cwiseAbs2().rowwise().sum() / (curves - 1), 2).sqrt().max(least_scatter);
    const Eigen::MatrixXd shapes = smooth_shapes(differences.rows());
    const Eigen::MatrixXd relative = scatter.inverse().matrix().asDiagonal() * differences;
    const Eigen::MatrixXd parts = shapes.transpose() * relative / static_cast<double>(differences.rows());
    const Eigen::ArrayXd sizes = (pooled(parts.cwiseAbs2().rowwise().sum() / (curves - 1), 1) / curves).sqrt();
    return scatter.matrix().asDiagonal() * shapes * sizes.matrix().asDiagonal();
}

/// The mean of the curves of several structures and, after it, that mean moved by each of its standard errors, of G' and of G''.
/// @param curves loads x structures. @return the same loads x mean and errors.
Eigen::MatrixXcd mean_and_errors(const Eigen::MatrixXcd& curves) {
    const Eigen::VectorXcd mean = curves.rowwise().mean();
    if (curves.cols() < 2) {
        return mean;
    }
    const Eigen::MatrixXcd differences = curves.colwise() - mean;
    const Eigen::MatrixXd storage = errors_of_mean(differences.real());
    const Eigen::MatrixXd loss = errors_of_mean(differences.imag());
    Eigen::MatrixXcd all(mean.size(), 1 + storage.cols() + loss.cols());
    all << mean, storage.cast<Complex>(), Complex(0, 1) * loss.cast<Complex>();
    all.rightCols(all.cols() - 1).colwise() += mean;
    return all;
}

}  // namespace

/// Moduli of a sweep by the explicit rheometer in a sheared cell over that at a strain so small that nothing breaks.
std::vector<Complex> Simulator::sweep(std::size_t structure, const Settings& settings, double strength,
                                      const std::vector<double>& amplitudes) {
    const double largest = *std::max_element(amplitudes.begin(), amplitudes.end());
    mechanics::RheometerOptions options;
    options.model = breaking_model(settings.stiffness_ratio, strength);
    options.boundary = mechanics::RheometerBoundary::periodic;
    options.amplitude = largest;
    options.oscillations = static_cast<int>(amplitudes.size()) + 2;
    options.steps_per_oscillation = steps_per_oscillation;
    options.compare_with_rest = false;
    options.course.assign(2, 1e-3);
    for (const double amplitude : amplitudes) {
        options.course.push_back(amplitude / largest);
    }
    const ContactNetwork bonds = find_contacts(structures_[structure], settings.bond_tolerance);
    const mechanics::RheometerRun run =
        mechanics::run_rheometer(structures_[structure], bonds, options, {mechanics::ShearOrientation{}}, progress_).runs.front();
    const mechanics::Oscillation& unbroken = run.oscillations[1];
    std::vector<Complex> responses;
    for (std::size_t k = 2; k < run.oscillations.size(); ++k) {
        const mechanics::Oscillation& one = run.oscillations[k];
        // What the rate of the run costs is in both.
        const Complex beyond(one.fundamental_storage - unbroken.fundamental_storage,
                             one.fundamental_loss - unbroken.fundamental_loss);
        responses.push_back(1.0 + beyond / unbroken.fundamental_storage);
    }
    return responses;
}

/// G* / G of one structure at the amplitudes of a sweep.
std::vector<Complex> Simulator::structure_response(std::size_t structure, const Settings& settings,
                                                   const std::vector<double>& amplitudes) {
    // Strain times stiffness over strength is what counts, so that unit stiffness serves all.
    const double strength = settings.critical_strain * stiffness_in_series(unit_stiffness, unit_stiffness) * radius_;
    std::vector<double> what{settings.stiffness_ratio, settings.bond_tolerance, strength};
    what.insert(what.end(), amplitudes.begin(), amplitudes.end());
    const std::string key = key_of("sweep " + names_[structure], what);
    auto found = cache_.find(key);
    if (found == cache_.end()) {
        progress_.update("simulating", 0.0, "amplitude sweep with breaking bonds");
        std::vector<double> values;
        for (const Complex& response : sweep(structure, settings, strength, amplitudes)) {
            values.insert(values.end(), {response.real(), response.imag()});
        }
        found = cache_.emplace(key, std::move(values)).first;
    }
    std::vector<Complex> responses;
    for (std::size_t entry = 0; entry < amplitudes.size(); ++entry) {
        responses.emplace_back(found->second[2 * entry], found->second[2 * entry + 1]);
    }
    return responses;
}

std::vector<Complex> Simulator::exact_amplitude_response(const Settings& settings, const std::vector<double>& amplitudes) {
    std::vector<Complex> mean(amplitudes.size());
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        const std::vector<Complex> one = structure_response(k, settings, amplitudes);
        for (std::size_t entry = 0; entry < mean.size(); ++entry) {
            mean[entry] += one[entry] / static_cast<double>(structures_.size());
        }
    }
    return mean;
}

const Eigen::MatrixXcd& Simulator::strength_curves() {
    if (strength_curves_.size() > 0) {
        return strength_curves_;
    }
    Settings settings;
    settings.critical_strain = 1e-4;
    std::vector<double> amplitudes;
    for (int k = 1; k <= load_nodes; ++k) {
        amplitudes.push_back(k * load_step * settings.critical_strain);
    }
    Eigen::MatrixXcd curves(load_nodes, static_cast<Index>(structures_.size()));
    for (std::size_t k = 0; k < structures_.size(); ++k) {
        const std::vector<Complex> one = structure_response(k, settings, amplitudes);
        curves.col(static_cast<Index>(k)) = Eigen::Map<const Eigen::VectorXcd>(one.data(), load_nodes);
    }
    const Eigen::MatrixXcd all = mean_and_errors(curves);
    strength_curves_.setOnes(all.cols(), load_nodes + 1);  // at rest
    strength_curves_.rightCols(load_nodes) = all.transpose();
    return strength_curves_;
}

Eigen::VectorXcd Simulator::amplitude_response(const Settings& settings, double amplitude) {
    if (!std::isfinite(settings.critical_strain)) {
        return Eigen::VectorXcd::Ones(1);
    }
    const Eigen::MatrixXcd& curves = strength_curves();
    const double place = std::min(amplitude / settings.critical_strain / load_step, static_cast<double>(load_nodes));
    const auto below = std::min<Index>(static_cast<Index>(place), load_nodes - 1);
    return curves.col(below) + (place - static_cast<double>(below)) * (curves.col(below + 1) - curves.col(below));
}

}  // namespace coagula::diagnose
