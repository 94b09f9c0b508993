// What breaking bonds do to the moduli of every row: where, in which order and under which plates they were measured.
#include "forward.hpp"

#include "plate_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;

/// Bonds as weak as the weaker of the two causes makes them.
Settings with_weakest_bonds(Settings settings) {
    settings.critical_strain = std::min(settings.critical_strain, settings.rim_critical_strain);
    return settings;
}

}  // namespace

/// Whether the strain grows along the radius, gamma(r) = gamma_R r / R.
bool Forward::strain_varies(const Settings& settings) const {
    const std::optional<Geometry>& geometry = experiment_.instrument.geometry;
    return std::isfinite(settings.rim_critical_strain) && geometry && *geometry == Geometry::plate_plate;
}

/// G* / G of a sweep upwards that has come to this strain at the rim. Between plates the torque shows
/// 4 / R^4 times the integral of G*(gamma_R r / R) r^3 (Macosko, Rheology, 1994, sec. 5.5).
Eigen::VectorXcd Forward::breaking_response(const Settings& settings, double strain) const {
    if (!strain_varies(settings)) {
        return simulator_.amplitude_response(settings, strain);
    }
    static const std::vector<Ring> rings = plate_rings(3);
    Eigen::VectorXcd mean = rings[0].weight * simulator_.amplitude_response(settings, rings[0].radius * strain);
    for (std::size_t k = 1; k < rings.size(); ++k) {
        mean += rings[k].weight * simulator_.amplitude_response(settings, rings[k].radius * strain);
    }
    return mean;
}

/// The same by runs at the amplitudes of one sweep in their order, of which every ring sees its share.
std::vector<Complex> Forward::exact_breaking_response(const Settings& settings, const std::vector<double>& amplitudes) const {
    if (!strain_varies(settings)) {
        return simulator_.exact_amplitude_response(settings, amplitudes);
    }
    std::vector<Complex> mean(amplitudes.size());
    for (const Ring& ring : plate_rings(1)) {
        std::vector<double> local = amplitudes;
        for (double& amplitude : local) {
            amplitude *= ring.radius;
        }
        const std::vector<Complex> responses = simulator_.exact_amplitude_response(settings, local);
        for (std::size_t k = 0; k < mean.size(); ++k) {
            mean[k] += ring.weight * responses[k];
        }
    }
    return mean;
}

/// The strains of the runs that were made on the sample before this table, in their order.
std::vector<double> Forward::strains_before(std::size_t table) const {
    const std::vector<Measurement>& tables = experiment_.measurements;
    std::vector<std::pair<int, double>> earlier;
    for (const Observation& observation : observations_) {
        const Measurement& other = tables[observation.measurement];
        if (other.sample == tables[table].sample && other.run_order < tables[table].run_order && !observation.loss &&
            std::isfinite(observation.strain)) {
            earlier.emplace_back(other.run_order, observation.strain);
        }
    }
    std::stable_sort(earlier.begin(), earlier.end(), [](const auto& one, const auto& two) { return one.first < two.first; });
    std::vector<double> strains;
    for (const auto& [order, strain] : earlier) {
        strains.push_back(strain);
    }
    return strains;
}

/// G* / G of one table by a run at its own amplitudes after those before it on the sample, by row.
std::map<std::size_t, Complex> Forward::exact_factors(const Settings& settings, std::size_t table) const {
    std::vector<std::size_t> rows;
    std::vector<double> amplitudes = strains_before(table);
    const std::size_t history = amplitudes.size();
    for (const Observation& observation : observations_) {
        if (observation.measurement == table && !observation.loss && std::isfinite(observation.strain)) {
            rows.push_back(observation.row);
            amplitudes.push_back(observation.strain);
        }
    }
    std::map<std::size_t, Complex> factors;
    if (rows.empty()) {
        return factors;
    }
    const std::vector<Complex> run = exact_breaking_response(settings, amplitudes);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        factors[rows[k]] = run[history + k];
    }
    return factors;
}

/// The largest strain that the sample of each observation had seen by then, itself included; NaN where there is no strain.
std::vector<double> Forward::largest_strains() const {
    std::vector<double> largest(observations_.size(), unset);
    for (std::size_t table = 0; table < experiment_.measurements.size(); ++table) {
        const std::vector<double> earlier = strains_before(table);
        const double before = earlier.empty() ? 0.0 : *std::max_element(earlier.begin(), earlier.end());
        double so_far = before;
        std::size_t row_before = 0;
        for (std::size_t k = 0; k < observations_.size(); ++k) {
            const Observation& observation = observations_[k];
            if (observation.measurement != table || !std::isfinite(observation.strain)) {
                continue;
            }
            if (observation.row <= row_before) {
                so_far = before;  // the other modulus, from the start of the sweep
            }
            row_before = observation.row;
            so_far = std::max(so_far, observation.strain);
            largest[k] = so_far;
        }
    }
    return largest;
}

/// G* / G from breaking bonds, observations x mean and errors of Simulator::amplitude_response; the mean alone if exact. A bond
/// that broke stays broken: the largest strain so far counts.
Eigen::MatrixXcd Forward::amplitude_factors(const Settings& given, bool exact) const {
    const Settings settings = with_weakest_bonds(given);
    const bool breaks = std::isfinite(settings.critical_strain);
    const Index columns = breaks && !exact ? simulator_.amplitude_response(settings, 0).size() : 1;
    Eigen::MatrixXcd factors = Eigen::MatrixXcd::Ones(static_cast<Index>(observations_.size()), columns);
    std::map<std::size_t, std::map<std::size_t, Complex>> runs;  // by table and row
    for (std::size_t k = 0; breaks && k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        const auto i = static_cast<Index>(k);
        if (!std::isfinite(observation.strain)) {
            continue;
        }
        if (exact) {
            const auto [run, added] = runs.try_emplace(observation.measurement);
            if (added) {
                run->second = exact_factors(settings, observation.measurement);
            }
            if (const auto found = run->second.find(observation.row); found != run->second.end()) {
                factors(i, 0) = found->second;
                continue;
            }
        }
        const Eigen::VectorXcd response = breaking_response(settings, largest_strains_[k]);
        factors.row(i) = response.head(columns).transpose();
        if (observation.strain < largest_strains_[k]) {
            // Nothing breaks on the way down, and what runs lose there falls towards zero with their rate (bench_friction).
            factors.row(i) = factors.row(i).real().cast<Complex>().eval();
        }
    }
    return factors;
}

}  // namespace coagula::diagnose
