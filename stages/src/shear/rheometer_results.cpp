// SPDX-License-Identifier: GPL-3.0-or-later
#include "rheometer_results.hpp"

#include "broken_bonds.hpp"
#include "orientation_list.hpp"

#include <coagula/io/contact_model_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace coagula::stages {

namespace {

using mechanics::Oscillation;
using mechanics::RheometerResult;
using mechanics::RheometerRun;

const std::string rheometer_group = "/mechanics/dem/";

struct OscillationColumn {
    const char* name;
    double Oscillation::*value;
    const char* unit;
    const char* description;
};
constexpr std::array<OscillationColumn, 8> oscillation_columns{
    {{"amplitude", &Oscillation::amplitude, "1", "amplitude of the strain"},
     {"storage_modulus", &Oscillation::storage_modulus, "Pa", "largest stress over largest strain, times cos(phase)"},
     {"loss_modulus", &Oscillation::loss_modulus, "Pa", "largest stress over largest strain, times sin(phase)"},
     {"phase", &Oscillation::phase, "rad", "phase by which the fundamental of the stress leads that of the strain"},
     {"fundamental_storage_modulus", &Oscillation::fundamental_storage, "Pa", "storage modulus of the fundamental alone"},
     {"fundamental_loss_modulus", &Oscillation::fundamental_loss, "Pa", "loss modulus of the fundamental alone"},
     {"third_harmonic", &Oscillation::third_harmonic, "1", "amplitude of the third harmonic over that of the fundamental"},
     {"offset", &Oscillation::offset, "Pa", "mean stress"}}};

const Oscillation& last(const RheometerRun& run) {
    return run.oscillations.back();
}

/// One number per orientation and entry of each run: [runs][entries].
template <class Count, class Value>
io::Dataset per_run(const std::string& name, const RheometerResult& result, const Count& count, const Value& value,
                    const std::string& unit, const std::string& description) {
    std::vector<double> values;
    for (const RheometerRun& run : result.runs) {
        for (std::size_t entry = 0; entry < count(run); ++entry) {
            values.push_back(value(run, entry));
        }
    }
    return {rheometer_group + name, {result.runs.size(), count(result.runs.front())}, std::move(values), unit, description};
}

Eigen::VectorXd over_runs(const RheometerResult& result, double RheometerRun::*value) {
    Eigen::VectorXd values(static_cast<Index>(result.runs.size()));
    std::transform(result.runs.begin(), result.runs.end(), values.begin(), [&](const RheometerRun& run) { return run.*value; });
    return values;
}

void append_network(Results& results, const RheometerResult& result, const mechanics::RheometerOptions& options,
                    double bond_tolerance) {
    const bool plates = options.boundary == mechanics::RheometerBoundary::plates;
    results.push_back(io::text(rheometer_group + "method", "dem", "explicit discrete elements, oscillatory shear"));
    results.push_back(
        io::text(rheometer_group + "boundary", plates ? "plates" : "periodic",
                 plates ? "layers of the periodic repetition, one fixed, one driven" : "the periodic cell is sheared"));
    results.push_back(io::integer(rheometer_group + "contacts", result.contacts, "number of bonds"));
    results.push_back(io::scalar(rheometer_group + "bond_tolerance", bond_tolerance, "1",
                                 "pairs nearer than (1 + tolerance) (r_i + r_j) are bonded"));
    results.push_back(io::text(rheometer_group + "model", io::contact_model_text(options.model), "the contact as a TOML file"));
    results.push_back(io::scalar(rheometer_group + "contact_stiffness/normal", result.contact_normal_stiffness, "N/m",
                                 "stiffness of an unloaded contact: two particles in series"));
    results.push_back(io::scalar(rheometer_group + "contact_stiffness/shear", result.contact_shear_stiffness, "N/m",
                                 "stiffness of an unloaded contact: two particles in series"));
}

void append_protocol(Results& results, const RheometerResult& result, const mechanics::RheometerOptions& options) {
    results.push_back(
        io::scalar(rheometer_group + "frequency", options.frequency, "Hz", "frequency of the oscillations, with scaled masses"));
    results.push_back(io::scalar(rheometer_group + "damping", options.damping, "1", "coefficient of the local damping"));
    results.push_back(
        io::integer(rheometer_group + "steps_per_oscillation", options.steps_per_oscillation, "time steps of an oscillation"));
    results.push_back(io::scalar(rheometer_group + "time_step", result.time_step, "s", "time step of the run"));
    results.push_back(io::scalar(rheometer_group + "mass_scaling", result.mass_scaling, "1", "mass in the run over the real mass"));
    results.push_back(io::scalar(rheometer_group + "inertial_number", result.inertial_number, "1",
                                 "largest strain rate times sqrt(mass / normal contact stiffness)"));
    results.push_back(
        io::vector(rheometer_group + "rate_error", over_runs(result, &RheometerRun::rate_error), "1",
                   "per orientation: relative change of the stress at a peak when the network comes to rest there; NaN where it "
                   "carries none or did not come to rest"));
    results.push_back(
        io::vector(rheometer_group + "rest_modulus", over_runs(result, &RheometerRun::rest_modulus), "Pa",
                   "per orientation: G' from the stress at a peak after the network has come to rest there; NaN where it did not"));
    results.push_back(io::vector(rheometer_group + "unbalanced_ratio", over_runs(result, &RheometerRun::unbalanced_ratio), "1",
                                 "per orientation: rms unbalanced force over mean contact force at a peak"));
    results.push_back(io::vector(rheometer_group + "rest_force", over_runs(result, &RheometerRun::rest_force), "1",
                                 "per orientation: rms force before the test over normal contact stiffness times mean radius"));
}

void append_moduli(Results& results, const RheometerResult& result) {
    const auto add = [&](const std::string& name, double value, const std::string& description) {
        results.push_back(io::scalar(rheometer_group + name, value, "Pa", description));
    };
    add("storage_modulus/mean", result.storage_modulus(), "G' of the last oscillation, mean of the orientations");
    add("storage_modulus/std", result.storage_deviation(), "standard deviation over the orientations of this one structure");
    add("loss_modulus/mean", result.loss_modulus(), "G'' of the last oscillation, mean of the orientations");
    add("loss_modulus/std", result.loss_deviation(), "standard deviation over the orientations of this one structure");
    std::string names;
    for (const RheometerRun& run : result.runs) {
        const std::string name = name_of(run.orientation);
        add("storage_modulus/" + name, last(run).storage_modulus, "plate normal and shear direction " + name);
        add("loss_modulus/" + name, last(run).loss_modulus, "plate normal and shear direction " + name);
        names += (names.empty() ? "" : ",") + name;
    }
    results.push_back(io::scalar(rheometer_group + "phase", result.phase(), "rad", "phase of the mean moduli"));
    results.push_back(
        io::text(rheometer_group + "orientations", names, "plate normal and shear direction, the order of all arrays"));
}

void append_plates(Results& results, const RheometerResult& result) {
    results.push_back(io::vector(rheometer_group + "plate_storage_modulus", over_runs(result, &RheometerRun::plate_storage), "Pa",
                                 "per orientation: G' from the force on the driven plate, last oscillation"));
    const auto samples = [](const RheometerRun& run) { return run.plate_stress.size(); };
    results.push_back(per_run(
        "samples/plate_stress", result, samples, [](const RheometerRun& run, std::size_t k) { return run.plate_stress[k]; }, "Pa",
        "force on the driven plate over its area"));
    if (result.runs.front().sphere_storage.size() == 0) {
        return;
    }
    const auto spheres = [](const RheometerRun& run) { return static_cast<std::size_t>(run.sphere_storage.size()); };
    results.push_back(per_run(
        "sphere_storage_modulus", result, spheres,
        [](const RheometerRun& run, std::size_t k) { return run.sphere_storage[static_cast<Index>(k)]; }, "Pa",
        "per orientation and measurement sphere, from the fixed to the driven plate: G', last oscillation"));
    std::vector<double> stress;
    for (const RheometerRun& run : result.runs) {
        for (Index row = 0; row < run.sphere_stress.rows(); ++row) {
            stress.insert(stress.end(), run.sphere_stress.row(row).begin(), run.sphere_stress.row(row).end());
        }
    }
    const RheometerRun& first = result.runs.front();
    results.push_back({rheometer_group + "samples/sphere_stress",
                       {result.runs.size(), samples(first), spheres(first)},
                       std::move(stress),
                       "Pa",
                       "shear stress in the measurement spheres"});
}

void append_series(Results& results, const RheometerResult& result) {
    const auto oscillations = [](const RheometerRun& run) { return run.oscillations.size(); };
    for (const OscillationColumn& column : oscillation_columns) {
        const auto value = [&](const RheometerRun& run, std::size_t k) { return run.oscillations[k].*column.value; };
        results.push_back(
            per_run(std::string("oscillations/") + column.name, result, oscillations, value, column.unit, column.description));
    }
    const auto samples = [](const RheometerRun& run) { return run.stress.size(); };
    results.push_back(per_run(
        "samples/strain", result, samples, [](const RheometerRun& run, std::size_t k) { return run.strain[k]; }, "1",
        "shear strain"));
    results.push_back(per_run(
        "samples/stress", result, samples, [](const RheometerRun& run, std::size_t k) { return run.stress[k]; }, "Pa",
        "shear stress, mean over the whole volume"));
}

void append_broken(Results& results, const RheometerResult& result) {
    std::vector<double> strains;
    std::vector<std::int64_t> where;
    std::vector<BreakageCause> causes;
    for (std::size_t run = 0; run < result.runs.size(); ++run) {
        for (const mechanics::BrokenInShear& bond : result.runs[run].broken) {
            strains.push_back(bond.strain);
            causes.push_back(bond.cause);
            where.insert(where.end(), {static_cast<std::int64_t>(run), bond.oscillation, bond.first, bond.second});
        }
    }
    const std::size_t count = strains.size();
    append_causes(results, rheometer_group, causes);
    if (count > 0) {
        results.push_back({rheometer_group + "broken/strain", {count}, std::move(strains), "1", "strain at which each bond broke"});
        results.push_back({rheometer_group + "broken/bond",
                           {count, 4},
                           std::move(where),
                           "1",
                           "orientation, oscillation, and the two particles of each broken bond, all counted from 0"});
    }
}

/// The largest of the orientations that came to rest under a stress.
std::string rate_error_text(const RheometerResult& result) {
    double largest = unset;
    std::size_t known = 0;
    for (const RheometerRun& run : result.runs) {
        if (std::isfinite(run.rate_error)) {
            largest = std::abs(run.rate_error) < std::abs(largest) ? largest : run.rate_error;
            ++known;
        }
    }
    if (known == 0) {
        return "unknown, because no orientation came to rest under a stress";
    }
    const std::size_t all = result.runs.size();
    return "at most " + with_unit(100 * largest, "1") + " %" +
           (known < all ? " (" + std::to_string(known) + " of " + std::to_string(all) + " orientations)" : "");
}

}  // namespace

Results datasets_of(const RheometerResult& result, const mechanics::RheometerOptions& options, double bond_tolerance) {
    Results results;
    append_network(results, result, options, bond_tolerance);
    append_protocol(results, result, options);
    append_moduli(results, result);
    if (options.boundary == mechanics::RheometerBoundary::plates) {
        append_plates(results, result);
    }
    append_series(results, result);
    append_broken(results, result);
    return results;
}

Table table_of(const RheometerResult& result, const mechanics::RheometerOptions& options) {
    const bool plates = options.boundary == mechanics::RheometerBoundary::plates;
    std::string each;
    Index broken = 0;
    for (const RheometerRun& run : result.runs) {
        each += (each.empty() ? "" : ", ") + name_of(run.orientation) + " " + with_unit(last(run).storage_modulus, "Pa");
        broken += static_cast<Index>(run.broken.size());
    }
    return {
        {"bonds", std::to_string(result.contacts) + ", " + std::to_string(broken) + " broken"},
        {"set-up", plates ? "between plates, the upper one driven" : "sheared periodic cell"},
        {"storage modulus G'", with_unit(result.storage_modulus(), "Pa") + " +- " + with_unit(result.storage_deviation(), "Pa") +
                                   "   (+- is the standard deviation over the orientations)"},
        {"  each", each},
        {"loss modulus G''", with_unit(result.loss_modulus(), "Pa") + ", phase " + with_unit(result.phase(), "rad")},
        {"rate", "inertial number " + with_unit(result.inertial_number, "1") + ", error of the stress " + rate_error_text(result)}};
}

}  // namespace coagula::stages
