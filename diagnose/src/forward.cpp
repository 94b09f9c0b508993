#include "forward.hpp"

#include "median.hpp"
#include "pore_curves.hpp"
#include "springpot.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// What the material's modulus depends on, for unit normal stiffness: of the viscosity, its ratio to the stiffness.
Settings of_material(Settings settings) {
    settings.felt_viscosity /= settings.normal_stiffness;
    settings.normal_stiffness = 1;
    settings.slip = settings.gap_error = settings.tool_compliance = settings.tool_inertia = 0;
    return settings;
}

/// Slip under a cone, where the gap grows with the radius: 3 times the integral of u^3 / (u + x) over 0 < u < 1, by which the
/// torque is the smaller. x is the displacement at both walls over the sample's own, at the rim.
Complex sticking_share(Complex x) {
    if (std::abs(x) < 50) {
        return 1.0 - 1.5 * x + 3.0 * x * x - (x == 0.0 ? 0.0 : 3.0 * x * x * x * std::log(1.0 + 1.0 / x));
    }
    Complex share = 0;  // the same for large x, where the terms above cancel
    Complex power = 1;
    for (int k = 1; k <= 10; ++k) {
        power /= x;
        share += (k % 2 == 1 ? 3.0 : -3.0) / (k + 3.0) * power;
    }
    return share;
}

/// With a displacement of the sample at each wall of `slip` [m/Pa] times the stress there.
Complex slipping(Complex modulus, double slip, const Observation& observation) {
    if (std::isfinite(observation.cone_angle)) {
        const double rim = observation.cone_angle * observation.plate_radius;
        return std::isfinite(rim) ? modulus * sticking_share(2.0 * slip * modulus / rim) : modulus;
    }
    return std::isfinite(observation.gap) ? modulus / (1.0 + 2.0 * slip * modulus / observation.gap) : modulus;
}

/// Torque per angle over the modulus under a plate or cone [m^3].
double tool_factor(const Observation& observation) {
    const double radius = observation.plate_radius;
    return std::isfinite(observation.cone_angle) ? 2 * pi * std::pow(radius, 3) / (3 * observation.cone_angle)
                                                 : pi * std::pow(radius, 4) / (2 * observation.gap);
}

}  // namespace

Forward::Forward(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator)
    : experiment_(experiment),
      observations_(observations),
      simulator_(simulator),
      largest_strains_before_(largest_strains_before()) {
    for (const Observation& observation : observations_) {
        const Measurement& table = experiment_.measurements[observation.measurement];
        if (table.kind != MeasurementKind::structure_series) {
            continue;
        }
        if (experiment_.structure_groups.empty()) {
            throw InputError(table.label +
                             ": a structure series needs structures.groups, which says what rows a structure stands for");
        }
        const auto& groups = experiment_.structure_groups;
        if (std::find(groups.begin(), groups.end(), observation.structures) == groups.end()) {
            throw InputError(table.label + ": no structure stands for row " + std::to_string(observation.row + 1) + ", structure " +
                             std::to_string(observation.structures));
        }
    }
}

Complex Forward::seen_by_instrument(const Settings& settings, const Observation& observation, Complex modulus) const {
    if (settings.gap_error != 0 && std::isfinite(observation.gap)) {
        modulus *= observation.gap / (observation.gap + settings.gap_error);
    }
    const bool sticks = observation.rough_plates || std::isfinite(observation.fluid_viscosity);
    if (settings.slip > 0 && !sticks) {
        modulus = slipping(modulus, settings.slip, observation);
    }
    const double factor = tool_factor(observation);
    if (settings.tool_compliance > 0) {
        modulus /= 1.0 + settings.tool_compliance * factor * modulus;
    }
    if (settings.tool_inertia > 0 && std::isfinite(observation.angular_frequency)) {
        modulus -= settings.tool_inertia * observation.angular_frequency * observation.angular_frequency / factor;
    }
    return modulus;
}

/// Linear modulus of every group of structures that some observation needs.
std::map<std::size_t, double> Forward::linear_moduli(const Settings& settings, bool exact) const {
    std::map<std::size_t, double> linear;
    for (const Observation& observation : observations_) {
        const std::size_t group = observation.structures;
        if (!linear.contains(group) && is_modulus(observation)) {
            const double free =
                exact ? simulator_.exact_linear_modulus(settings, group) : simulator_.linear_modulus(settings, group);
            const double stretched =
                exact ? simulator_.exact_prestress_response(settings, group) : simulator_.prestress_response(settings, group);
            linear[group] = free * stretched * (1 + settings.size_drift * std::cbrt(1000 / simulator_.particles(group)));
        }
    }
    return linear;
}

/// G* of the material at every observation for a normal stiffness of 1 N/m, to which it is proportional; third harmonics over the
/// first as they are. The mean over the structures, then with each error in how they yield.
Eigen::MatrixXcd Forward::material(const Settings& settings, bool exact) const {
    std::map<std::size_t, double> linear = linear_moduli(settings, exact);
    Eigen::VectorXcd moduli(static_cast<Index>(observations_.size()));
    const bool settled = settings.volume_fraction_difference > 0;
    const double exponent = settled ? simulator_.volume_fraction_exponent(settings, exact) : 0.0;
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        if (observation.third_harmonic) {
            moduli[static_cast<Index>(k)] = third_harmonic(settings, observation, largest_strains_before_[k]);
            continue;
        }
        Complex modulus = linear[observation.structures];
        if (std::isfinite(observation.strain)) {
            modulus *= simulator_.contact_response(settings, observation.strain);
        }
        if (settings.springpot_ratio > 0 && std::isfinite(observation.angular_frequency)) {
            // A springpot in the same proportion to both springs scales the whole stiffness matrix.
            modulus *= 1.0 + springpot(settings, observation.angular_frequency);
        }
        if (settings.felt_viscosity > 0 && std::isfinite(observation.angular_frequency)) {
            modulus *= exact ? simulator_.exact_drag_response(settings, observation.angular_frequency, observation.structures)
                             : simulator_.drag_response(settings, observation.angular_frequency, observation.structures);
        }
        if (settled && std::isfinite(observation.gap)) {
            modulus *= gradient_factor(settings, observation, exponent);
        }
        if (std::isfinite(observation.time)) {
            modulus *= std::pow(1 + observation.time / settings.build_up_time, settings.build_up_exponent);
            modulus *= 1 + settings.ageing_per_decade * std::log10(1 + observation.time / settings.ageing_start);
        }
        moduli[static_cast<Index>(k)] = modulus;
    }
    return moduli.asDiagonal() * amplitude_factors(settings, exact);
}

const Eigen::MatrixXcd& Forward::remembered_material(const Settings& settings, bool exact) const {
    if (exact || last_material_.rows() == 0 || !(settings == last_settings_)) {
        last_material_ = material(settings, exact);
        last_settings_ = exact ? Settings{.normal_stiffness = unset} : settings;  // what is exact serves once
    }
    return last_material_;
}

/// What the instrument shows of every observation, of these moduli of the material at a normal stiffness of 1 N/m.
Eigen::VectorXd Forward::seen(const Settings& settings, const Eigen::VectorXcd& moduli, bool exact) const {
    Eigen::VectorXd predicted(static_cast<Index>(observations_.size()));
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        const auto i = static_cast<Index>(k);
        if (std::isfinite(observation.distance)) {
            predicted[i] = simulator_.neighbours(settings, observation.row, exact);
            continue;
        }
        if (observation.difference) {
            predicted[i] = simulator_.repeated_images(settings, exact)[static_cast<std::size_t>(*observation.difference)];
            continue;
        }
        if (is_pore(observation)) {
            predicted[i] = simulator_.exclusion_probability(
                settings, observation.pore_radius * simulator_.radius() / experiment_.sample.particle_radius, exact);
            continue;
        }
        if (observation.third_harmonic) {
            predicted[i] = observation.loss ? moduli[i].imag() : moduli[i].real();
            continue;
        }
        const Complex material = std::isfinite(observation.fluid_viscosity)
                                     ? Complex(0, observation.fluid_viscosity * observation.angular_frequency)
                                     : settings.normal_stiffness * moduli[i];
        const Complex modulus = seen_by_instrument(settings, observation, material);
        predicted[i] = observation.loss ? modulus.imag() : modulus.real();
    }
    return predicted;
}

Eigen::VectorXd Forward::predict(const Settings& settings, bool exact) const {
    if (exact && change_of(settings) != StructureChange{}) {
        return Forward(experiment_, observations_, simulator_.remade(change_of(settings))).predict(as_stated(settings), true);
    }
    return seen(settings, remembered_material(of_material(settings), exact).col(0), exact);
}

ModelErrors Forward::yield_errors(const Settings& settings) const {
    const Eigen::MatrixXcd& moduli = remembered_material(of_material(settings), false);
    Eigen::MatrixXd changes(moduli.rows(), moduli.cols() - 1);
    const Eigen::VectorXd mean = changes.cols() > 0 ? seen(settings, moduli.col(0), false) : Eigen::VectorXd();
    for (Index error = 0; error < changes.cols(); ++error) {
        changes.col(error) = seen(settings, moduli.col(error + 1), false) - mean;
    }
    return {changes, changes.cols() > 0 ? simulator_.yield_degrees() : std::numeric_limits<double>::infinity()};
}

Eigen::VectorXd Forward::structure_deviation(const Eigen::VectorXd& values) const {
    Eigen::VectorXd deviation = Eigen::VectorXd::Zero(values.size());
    const Eigen::VectorXd base = predict({});
    std::vector<double> ratios;
    for (Index row = 0; row < values.size(); ++row) {
        const std::size_t group = observations_[static_cast<std::size_t>(row)].structures;
        if (group > 0 && base[row] != 0) {
            ratios.push_back(std::abs(values[row] / base[row]));
            deviation[row] = simulator_.structure_error(group) * std::abs(base[row]);
        }
    }
    if (!ratios.empty()) {
        deviation *= median(std::move(ratios));
    }
    return deviation;
}

}  // namespace coagula::diagnose
