#include "forward.hpp"

#include "neighbour_shells.hpp"
#include "pore_curves.hpp"
#include "springpot.hpp"
#include "table_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>

namespace coagula::diagnose {

namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

constexpr Index fewest_centres = 20;

/// Standard deviation of a third harmonic over the first where the table states none.
constexpr double unstated_error = 5e-3;

/// How long a row takes where the table has no times [s].
constexpr double row_duration = 10;

/// Time since the first row of its table; rows without a time follow each other.
double time_in(const Measurement& table, std::size_t row) {
    const double given = cell(table, "time", row);
    return std::isnan(given) ? row_duration * static_cast<double>(row) : given;
}

double duration(const Measurement& table) {
    double longest = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        longest = std::max(longest, time_in(table, row));
    }
    return longest + row_duration;
}

/// When each table begins: the runs on one sample follow each other in their order.
std::vector<double> starts(const Experiment& experiment) {
    std::vector<double> start(experiment.measurements.size(), 0);
    for (std::size_t k = 0; k < start.size(); ++k) {
        for (const Measurement& other : experiment.measurements) {
            const Measurement& table = experiment.measurements[k];
            const bool before = other.sample == table.sample && other.run_order < table.run_order;
            // Waveforms were recorded during the sweeps.
            start[k] += before && other.kind != MeasurementKind::harmonics ? duration(other) : 0.0;
        }
    }
    return start;
}

/// What the material's modulus depends on, for unit normal stiffness: of the viscosity, its ratio to the stiffness.
Settings of_material(Settings settings) {
    settings.felt_viscosity /= settings.normal_stiffness;
    settings.normal_stiffness = 1;
    settings.slip = settings.gap_error = settings.tool_compliance = settings.tool_inertia = 0;
    return settings;
}

/// Torque per angle over the modulus of a plate-plate or cone-plate geometry [m^3].
double tool_factor(const Instrument& instrument, double gap, double radius) {
    const bool cone = instrument.geometry && *instrument.geometry == Geometry::cone_plate;
    return cone ? 2 * pi * std::pow(radius, 3) / (3 * instrument.cone_angle) : pi * std::pow(radius, 4) / (2 * gap);
}

/// The group of structures that stands for a row of a structure series: its number, else its place in the table.
std::size_t group_of(const Measurement& table, std::size_t row) {
    const Column* column = find_column(table, "structure");
    if (column == nullptr) {
        return row + 1;
    }
    const double number = column->values[row];
    if (!(number == std::floor(number))) {  // nor where the cell was left out
        throw InputError(table.label + ": column 'structure' must have a whole number in row " + std::to_string(row + 1) +
                         ", one of structures.groups");
    }
    return static_cast<std::size_t>(number);
}

/// What a table may show of a response to shear; in this order.
struct Shown {
    const char* column;
    bool loss;
    bool third_harmonic;
};
constexpr std::array<Shown, 4> shown{{{"storage_modulus", false, false},
                                      {"loss_modulus", true, false},
                                      {"third_harmonic_storage", false, true},
                                      {"third_harmonic_loss", true, true}}};

/// A cell of these columns with all that the row says about it; time since the start of its table.
Observation observation_at(const Experiment& experiment, std::size_t number, std::size_t row, const Shown& what) {
    const Measurement& table = experiment.measurements[number];
    const Column& column = *find_column(table, what.column);
    const bool series = table.kind == MeasurementKind::structure_series;
    const double gap = cell(table, "gap", row);
    const double radius = cell(table, "plate_radius", row);
    return {.measurement = number,
            .row = row,
            .loss = what.loss,
            .value = column.values[row],
            .standard_error =
                column.standard_errors.empty() ? (what.third_harmonic ? unstated_error : unset) : column.standard_errors[row],
            .strain = cell(table, "strain", row),
            .angular_frequency = angular_frequency(table, row),
            .time = series ? unset : time_in(table, row),
            .gap = std::isnan(gap) ? experiment.instrument.gap : gap,
            .plate_radius = std::isnan(radius) ? experiment.instrument.plate_radius : radius,
            .errors = column.errors,
            .third_harmonic = what.third_harmonic,
            .rough_plates = table.rough_plates,
            .fluid_viscosity = table.fluid_viscosity,
            .structures = series && !experiment.structure_groups.empty() ? group_of(table, row) : 0,
            .heterogeneity = cell(table, "heterogeneity", row),
            .coordination = cell(table, "coordination", row),
            .volume_fraction = cell(table, "volume_fraction", row)};
}

/// Neighbours in shells, where the diameter is known and there are particles far enough from the faces.
std::vector<Observation> neighbours_in(const Experiment& experiment, std::size_t number) {
    const Measurement& table = experiment.measurements[number];
    std::vector<Eigen::Vector3d> centres;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const Eigen::Vector3d centre(cell(table, "x", row), cell(table, "y", row), cell(table, "z", row));
        if (centre.allFinite()) {
            centres.push_back(centre);
        }
    }
    const Eigen::Map<const Eigen::Matrix3Xd> positions(centres.data()->data(), 3, static_cast<Index>(centres.size()));
    const NeighbourShells shells = shells_of_points(positions, 2 * experiment.sample.particle_radius);
    std::vector<Observation> all;
    for (std::size_t shell = 0; shell < shells.mean.size() && shells.centres >= fewest_centres; ++shell) {
        all.push_back({.measurement = number,
                       .row = shell,
                       .loss = false,
                       .value = shells.mean[shell],
                       .standard_error = shells.standard_errors[shell],
                       .strain = unset,
                       .angular_frequency = unset,
                       .time = unset,
                       .gap = unset,
                       .plate_radius = unset,
                       .distance = first_shell + shell_width * (static_cast<double>(shell) + 0.5)});
    }
    return all;
}

}  // namespace

bool has_moduli(MeasurementKind kind) {
    return kind == MeasurementKind::frequency_sweep || kind == MeasurementKind::amplitude_sweep ||
           kind == MeasurementKind::time_sweep || kind == MeasurementKind::gap_series || kind == MeasurementKind::structure_series;
}

const char* observable_of(const Observation& observation) {
    if (std::isfinite(observation.distance)) {
        return "neighbours";
    }
    if (is_pore(observation)) {
        return "exclusion_probability";
    }
    return shown.at((observation.third_harmonic ? 2 : 0) + (observation.loss ? 1 : 0)).column;
}

bool same_column(const Observation& one, const Observation& other) {
    return one.measurement == other.measurement && one.loss == other.loss && one.third_harmonic == other.third_harmonic;
}

bool is_modulus(const Observation& observation) {
    return !std::isfinite(observation.distance) && !is_pore(observation) && !observation.third_harmonic;
}

double relative_to(const Observation& observation, double level) {
    if (is_modulus(observation)) {
        return level;
    }
    return is_pore(observation) || observation.third_harmonic ? 1.0 : std::max(level, 1.0);
}

std::vector<Observation> observations_of(const Experiment& experiment) {
    const std::vector<double> start = starts(experiment);
    std::vector<Observation> all;
    for (std::size_t k = 0; k < experiment.measurements.size(); ++k) {
        const Measurement& table = experiment.measurements[k];
        if (table.kind == MeasurementKind::coordinates && std::isfinite(experiment.sample.particle_radius)) {
            const std::vector<Observation> shells = neighbours_in(experiment, k);
            all.insert(all.end(), shells.begin(), shells.end());
        }
        if (table.kind == MeasurementKind::pore_curve && std::isfinite(experiment.sample.particle_radius)) {
            const std::vector<Observation> pores = pores_in(experiment, k);
            all.insert(all.end(), pores.begin(), pores.end());
        }
        if (!has_moduli(table.kind) && table.kind != MeasurementKind::harmonics) {
            continue;
        }
        for (const Shown& what : shown) {
            const Column* column = find_column(table, what.column);
            // A fluid stores nothing, loses in proportion to the frequency, and has no harmonics.
            const bool fluid = std::isfinite(table.fluid_viscosity);
            const bool takes_part = column != nullptr && (!fluid || (what.loss && !what.third_harmonic));
            for (std::size_t row = 0; takes_part && row < table.rows(); ++row) {
                if (!std::isfinite(column->values[row]) || (fluid && std::isnan(angular_frequency(table, row)))) {
                    continue;
                }
                all.push_back(observation_at(experiment, k, row, what));
                all.back().time += start[k];
            }
        }
    }
    return all;
}

Eigen::ArrayXd complex_moduli(const std::vector<Observation>& observations, const Eigen::VectorXd& moduli) {
    std::map<std::pair<std::size_t, std::size_t>, double> squares;
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double value = observations[k].third_harmonic ? 0.0 : moduli[static_cast<Index>(k)];
        squares[{observations[k].measurement, observations[k].row}] += value * value;
    }
    Eigen::ArrayXd sizes(moduli.size());
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const double square = squares[{observations[k].measurement, observations[k].row}];
        sizes[static_cast<Index>(k)] = observations[k].third_harmonic ? 1.0 : std::sqrt(square);
    }
    return sizes;
}

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
    if (settings.slip > 0 && !sticks && std::isfinite(observation.gap)) {
        modulus /= 1.0 + 2.0 * settings.slip * modulus / observation.gap;
    }
    const double factor = tool_factor(experiment_.instrument, observation.gap, observation.plate_radius);
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
            moduli[static_cast<Index>(k)] = third_harmonic(settings, observation.strain, largest_strains_before_[k]);
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
        if (is_pore(observation)) {
            predicted[i] = simulator_.exclusion_probability(
                settings, observation.pore_radius * simulator_.radius() / experiment_.sample.particle_radius);
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
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::nth_element(ratios.begin(), middle, ratios.end());
        deviation *= *middle;
    }
    return deviation;
}

}  // namespace coagula::diagnose
