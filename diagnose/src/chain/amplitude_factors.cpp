// SPDX-License-Identifier: GPL-3.0-or-later
// What breaking bonds do to the moduli of every row: where, in which order and under which plates they were measured.
#include "forward.hpp"

#include "plate_field.hpp"

#include <coagula/diagnose/waveform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;

constexpr int panels = 3;  ///< of the plates, see plate_rings

/// Bond strength over that at 1 Hz: the force at which heat takes a bond over its barrier grows with the logarithm of the rate of
/// loading (Evans and Ritchie, Biophysical Journal 72 (1997) 1541), which in an oscillation at that force is in proportion to the
/// frequency. A bond that would break by itself keeps a twentieth.
double relative_strength(const Settings& settings, double angular_frequency) {
    constexpr double least = 0.05;
    const bool known = settings.strength_per_decade > 0 && std::isfinite(angular_frequency);
    const double decades = known ? std::log10(angular_frequency / (2 * std::numbers::pi)) : 0;
    return std::max(least, 1 + settings.strength_per_decade * decades);
}

}  // namespace

Settings with_weakest_bonds(Settings settings) {
    settings.critical_strain = std::min(settings.critical_strain, settings.rim_critical_strain);
    return settings;
}

/// Returns for each observation its strain over how much stronger bonds are at its frequency than at 1 Hz, and the largest of
/// these strains before.
std::vector<BondStrain> Forward::bond_strains(const Settings& settings) const {
    if (settings.strength_per_decade == 0 && !bond_strains_.empty()) {
        return bond_strains_;
    }
    std::vector<double> strains;
    for (const Observation& observation : observations_) {
        strains.push_back(observation.strain / relative_strength(settings, observation.angular_frequency));
    }
    const std::vector<double> before = largest_strains_before(strains);
    std::vector<BondStrain> all;
    for (std::size_t k = 0; k < strains.size(); ++k) {
        all.push_back({strains[k], before[k]});
    }
    return all;
}

/// Whether the strain grows along the radius, gamma(r) = gamma_R r / R.
bool Forward::strain_varies(const Settings& settings, const Observation& observation) const {
    const std::optional<Geometry>& geometry = experiment_.instrument.geometry;
    const bool plates = geometry && *geometry == Geometry::plate_plate && std::isnan(observation.cone_angle);
    return plates && std::isfinite(settings.rim_critical_strain);
}

/// G* / G of an oscillation with its strain at the rim. Between plates the torque shows
/// 4 / R^4 times the integral of G*(gamma_R r / R) r^3 (Macosko, Rheology, 1994, sec. 5.5).
Eigen::VectorXcd Forward::breaking_response(const Settings& settings, const Observation& observation,
                                            const BondStrain& strain) const {
    if (!strain_varies(settings, observation)) {
        return amplitude_response(simulator_, settings, strain.before, strain.amplitude);
    }
    static const std::vector<Ring> rings = plate_rings(panels);
    const auto in = [&](const Ring& ring) -> Eigen::VectorXcd {
        return ring.weight * amplitude_response(simulator_, settings, ring.radius * strain.before, ring.radius * strain.amplitude);
    };
    Eigen::VectorXcd mean = in(rings[0]);
    for (std::size_t k = 1; k < rings.size(); ++k) {
        mean += in(rings[k]);
    }
    return mean;
}

/// How the material yields in a run at these amplitudes, each larger than the one before; between plates every ring by its share.
std::vector<Yielded> Forward::exact_breaking_response(const Settings& settings, const Observation& observation,
                                                      const std::vector<double>& amplitudes) const {
    if (!strain_varies(settings, observation)) {
        return exact_amplitude_response(simulator_, settings, amplitudes);
    }
    const YieldCurves curve = exact_yield_curve(simulator_, settings, amplitudes);
    std::vector<Yielded> mean(amplitudes.size());
    for (const Ring& ring : plate_rings(panels)) {
        double before = 0;
        for (std::size_t k = 0; k < mean.size(); ++k) {
            const double load = ring.radius * amplitudes[k] / settings.critical_strain;
            mean[k].first += ring.weight * curve.response(before, load)[0];
            mean[k].settled += ring.weight * curve.response(load, load)[0].real();
            before = load;
        }
    }
    return mean;
}

/// Selects from the strains of all observations those in the runs that were made on the sample before this table, in their
/// order.
std::vector<double> Forward::strains_before(std::size_t table, const std::vector<double>& strains) const {
    const std::vector<Measurement>& tables = experiment_.measurements;
    std::vector<std::pair<int, double>> earlier;
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        const Measurement& other = tables[observation.measurement];
        if (other.sample == tables[table].sample && observation.run < runs_[table].order && std::isfinite(strains[k])) {
            earlier.emplace_back(observation.run, strains[k]);
        }
    }
    std::stable_sort(earlier.begin(), earlier.end(), [](const auto& one, const auto& two) { return one.first < two.first; });
    std::vector<double> in_order;
    for (const auto& [order, strain] : earlier) {
        in_order.push_back(strain);
    }
    return in_order;
}

/// Selects the strains of a table, and of the runs before it on the sample, that were larger than all before.
std::vector<double> Forward::growing_strains(std::size_t table, const std::vector<double>& strains) const {
    std::vector<double> all = strains_before(table, strains);
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        if (observations_[k].measurement == table && std::isfinite(strains[k])) {
            all.push_back(strains[k]);
        }
    }
    std::vector<double> growing;
    for (const double strain : all) {
        if (growing.empty() || strain > growing.back()) {
            growing.push_back(strain);
        }
    }
    return growing;
}

namespace {

/// Harmonics stand in a table of their own: what the sample had seen before is that of the same oscillation in the sweep.
void share_with_harmonics(const Experiment& experiment, const std::vector<Observation>& observations,
                          const std::vector<double>& strains, std::vector<double>& largest) {
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const Measurement& table = experiment.measurements[observations[k].measurement];
        const auto same =
            table.kind == MeasurementKind::harmonics ? same_oscillation(experiment, table, observations[k].row) : std::nullopt;
        for (std::size_t other = 0; same && other < observations.size(); ++other) {
            if (observations[other].measurement == same->measurement && observations[other].row == same->row) {
                largest[k] = table.oscillations > 1 ? std::max(largest[other], strains[k]) : largest[other];
            }
        }
    }
}

}  // namespace

/// The largest of these strains of all observations that the sample of each had seen before the oscillation that was measured; 0
/// where it had seen none.
std::vector<double> Forward::largest_strains_before(const std::vector<double>& strains) const {
    std::vector<double> largest(observations_.size(), 0);
    for (std::size_t table = 0; table < experiment_.measurements.size(); ++table) {
        const std::vector<double> earlier = strains_before(table, strains);
        const double at_start = earlier.empty() ? 0.0 : *std::max_element(earlier.begin(), earlier.end());
        const bool repeated = experiment_.measurements[table].oscillations > 1;
        double so_far = at_start;
        std::size_t row_before = 0;
        for (std::size_t k = 0; k < observations_.size(); ++k) {
            const Observation& observation = observations_[k];
            if (observation.measurement != table || !std::isfinite(strains[k])) {
                continue;
            }
            if (observation.row <= row_before) {
                so_far = at_start;  // the other modulus, from the start of the sweep
            }
            row_before = observation.row;
            largest[k] = repeated ? std::max(so_far, strains[k]) : so_far;
            so_far = std::max(so_far, strains[k]);
        }
    }
    share_with_harmonics(experiment_, observations_, strains, largest);
    return largest;
}

/// G* / G from breaking bonds by runs at the strains of the tables themselves, observation by observation.
Eigen::VectorXcd Forward::exact_amplitude_factors(const Settings& settings) const {
    struct Run {
        std::vector<double> strains;
        std::vector<Yielded> responses;
    };
    const std::vector<BondStrain> bonds = bond_strains(settings);
    std::vector<double> strains;
    for (const BondStrain& one : bonds) {
        strains.push_back(one.amplitude);
    }
    Eigen::VectorXcd factors = Eigen::VectorXcd::Ones(static_cast<Index>(observations_.size()));
    std::map<std::size_t, Run> runs;  // by table
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        if (!std::isfinite(observation.strain) || is<Harmonic>(observation)) {
            continue;
        }
        const auto [found, added] = runs.try_emplace(observation.measurement);
        Run& run = found->second;
        if (added) {
            run.strains = growing_strains(observation.measurement, strains);
            run.responses = exact_breaking_response(settings, observation, run.strains);
        }
        const auto [strain, before] = bonds[k];
        const auto place = std::lower_bound(run.strains.begin(), run.strains.end(), std::max(before, strain));
        const Yielded& response = run.responses[static_cast<std::size_t>(place - run.strains.begin())];
        factors[static_cast<Index>(k)] = strain > before ? response.first : response.settled;
    }
    return factors;
}

/// G* / G from breaking bonds, observations x mean and errors of amplitude_response; the mean alone if exact. A bond
/// that broke stays broken.
Eigen::MatrixXcd Forward::amplitude_factors(const Settings& given, bool exact) const {
    const Settings settings = with_weakest_bonds(given);
    if (!std::isfinite(settings.critical_strain)) {
        return Eigen::MatrixXcd::Ones(static_cast<Index>(observations_.size()), 1);
    }
    if (exact) {
        return exact_amplitude_factors(settings);
    }
    const std::vector<BondStrain> bonds = bond_strains(settings);
    const Index columns = amplitude_response(simulator_, settings, 0, 0).size();
    Eigen::MatrixXcd factors = Eigen::MatrixXcd::Ones(static_cast<Index>(observations_.size()), columns);
    for (std::size_t k = 0; k < observations_.size(); ++k) {
        const Observation& observation = observations_[k];
        if (const std::size_t first = first_of_row_[k]; first < k && bonds[first].before == bonds[k].before) {
            factors.row(static_cast<Index>(k)) = factors.row(static_cast<Index>(first));
        } else if (std::isfinite(observation.strain) && !is<Harmonic>(observation)) {
            factors.row(static_cast<Index>(k)) = breaking_response(settings, observation, bonds[k]).transpose();
        }
    }
    return factors;
}

}  // namespace coagula::diagnose
