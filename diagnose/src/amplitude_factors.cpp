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
Complex Forward::breaking_response(const Settings& settings, double strain, std::size_t error) const {
    if (!strain_varies(settings)) {
        return simulator_.amplitude_response(settings, strain, error);
    }
    static const std::vector<Ring> rings = plate_rings(3);
    Complex mean = 0;
    for (const Ring& ring : rings) {
        mean += ring.weight * simulator_.amplitude_response(settings, ring.radius * strain, error);
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

/// G* / G from breaking bonds for every observation. A bond that broke stays broken: the largest strain so far counts.
std::vector<Complex> Forward::amplitude_factors(const Settings& given, Run run) const {
    const Settings settings = with_weakest_bonds(given);
    std::vector<Complex> factors(observations_.size(), 1.0);
    if (!std::isfinite(settings.critical_strain)) {
        return factors;
    }
    for (std::size_t table = 0; table < experiment_.measurements.size(); ++table) {
        const std::map<std::size_t, Complex> rows = run.exact ? exact_factors(settings, table) : std::map<std::size_t, Complex>{};
        const std::vector<double> earlier = strains_before(table);
        const double before = earlier.empty() ? 0.0 : *std::max_element(earlier.begin(), earlier.end());
        double largest = before;
        std::size_t row_before = 0;
        for (std::size_t k = 0; k < observations_.size(); ++k) {
            const Observation& observation = observations_[k];
            if (observation.measurement != table || !std::isfinite(observation.strain)) {
                continue;
            }
            if (observation.row <= row_before) {
                largest = before;  // the other modulus, from the start of the sweep
            }
            row_before = observation.row;
            if (const auto found = rows.find(observation.row); found != rows.end()) {
                factors[k] = found->second;
                continue;
            }
            const bool falls = observation.strain < largest;
            largest = std::max(largest, observation.strain);
            const Complex response = breaking_response(settings, largest, run.error);
            // Nothing breaks on the way down, and what runs lose there falls towards zero with their rate (bench_friction).
            factors[k] = falls ? Complex(response.real()) : response;
        }
    }
    return factors;
}

}  // namespace coagula::diagnose
