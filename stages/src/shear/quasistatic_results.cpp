// SPDX-License-Identifier: GPL-3.0-or-later
#include "quasistatic_results.hpp"

#include "broken_bonds.hpp"
#include "orientation_list.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace coagula::stages {

namespace {

using mechanics::ShearOrientation;
using Test = QuasistaticTest;

const std::string quasistatic_group = "/mechanics/quasistatic/";
const std::string compression_group = "/mechanics/compression/";
constexpr double yield_fraction = 0.9;

double stress_on_plates(const mechanics::StrainPoint& point, const ShearOrientation& orientation) {
    return point.stress(orientation.normal, orientation.direction);
}

/// Mean, standard deviation and one array per orientation.
void append_modulus(Results& results, const std::string& path, const std::vector<Test>& tests, const Eigen::MatrixXd& values,
                    const std::string& description) {
    const Eigen::VectorXd mean = values.colwise().mean();
    const Eigen::VectorXd deviation = (values.rowwise() - mean.transpose()).array().square().colwise().mean().sqrt();
    const auto add = [&](const std::string& key, const Eigen::VectorXd& value, const std::string& of) {
        results.push_back(value.size() == 1 ? io::scalar(path + "/" + key, value[0], "Pa", description + ", " + of)
                                            : io::vector(path + "/" + key, value, "Pa", description + ", " + of));
    };
    add("mean", mean, "mean of the orientations");
    add("std", deviation, "standard deviation over the orientations of this one structure");
    for (std::size_t k = 0; k < tests.size(); ++k) {
        const std::string of = name_of(tests[k].orientation);
        add(of, values.row(static_cast<Index>(k)),
            tests[k].orientation.is_uniaxial() ? "along the axis of " + of : "plate normal and shear direction " + of);
    }
}

template <class Entries, class Value>
Eigen::VectorXd collect(const Entries& entries, const Value& value) {
    Eigen::VectorXd values(static_cast<Index>(entries.size()));
    std::transform(entries.begin(), entries.end(), values.begin(), value);
    return values;
}

void append_broken(Results& results, const std::string& path, const std::vector<mechanics::BrokenBond>& broken) {
    Eigen::VectorXi bond(static_cast<Index>(broken.size()));
    std::transform(broken.begin(), broken.end(), bond.begin(), [](const auto& entry) { return static_cast<int>(entry.bond); });
    if (!broken.empty()) {
        results.push_back(io::integers(path + "broken/bond", bond, "column in the list of bonds, in the order of breakage"));
        results.push_back(io::vector(path + "broken/strain", collect(broken, [](const auto& entry) { return entry.strain; }), "1",
                                     "strain at which the bond broke"));
    }
    std::vector<BreakageCause> causes;
    std::transform(broken.begin(), broken.end(), std::back_inserter(causes), [](const auto& entry) { return entry.cause; });
    append_causes(results, path, causes);
}

/// The sentence that tells people how the network failed.
std::string sentence_of(const mechanics::NetworkFailure& failure) {
    return "failed at strain " + with_unit(failure.strain, "1") + ", " + std::to_string(failure.broken) + " bonds broken: " +
           (failure.parted ? "nothing reaches from plate to plate any more"
                           : "the stress stays below 1/1000 of its largest value from there on");
}

void append_failure(Results& results, const std::string& path, const std::optional<mechanics::NetworkFailure>& failure) {
    results.push_back(io::scalar(path + "failure_strain", failure ? failure->strain : unset, "1",
                                 "strain at which the network ceased to carry load; NaN: it did not"));
    if (failure) {
        results.push_back(io::text(path + "failure", sentence_of(*failure), "description of the failure of the network"));
    }
}

void append_points(Results& results, const std::string& path, const mechanics::RampResponse& ramp,
                   const ShearOrientation& orientation) {
    const auto add = [&](const std::string& name, const auto& value, const std::string& unit, const std::string& description) {
        results.push_back(io::vector(path + name, collect(ramp.points, value), unit, description));
    };
    using Point = mechanics::StrainPoint;
    const bool uniaxial = orientation.is_uniaxial();
    add(
        "strain", [](const Point& p) { return p.strain; }, "1",
        uniaxial ? "change of height over that at the start in each equilibrium, compression > 0" : "strain of each equilibrium");
    add(
        "stress", [&](const Point& p) { return stress_on_plates(p, orientation); }, "Pa",
        uniaxial ? "normal stress along the axis, compression > 0" : "shear stress");
    add(
        "work", [](const Point& p) { return p.work; }, "J", "work done by the boundary");
    add(
        "stored", [](const Point& p) { return p.stored; }, "J", "energy in the contacts");
    add(
        "dissipated", [](const Point& p) { return p.dissipated; }, "J", "energy dissipated by friction and micro-slip");
    add(
        "breakage", [](const Point& p) { return p.breakage; }, "J", "energy released by breaking bonds");
    add(
        "released", [](const Point& p) { return p.released; }, "J", "energy released by jumps to another equilibrium");
    add(
        "bonds", [](const Point& p) { return static_cast<double>(p.bonds); }, "1", "intact bonds");
}

/// Strain where the secant modulus has fallen to 0.9 of the first one. Where the network yields.
double yield_strain_of(const mechanics::RampResponse& ramp, const ShearOrientation& orientation) {
    std::vector<double> strain;
    std::vector<double> secant;
    for (std::size_t point = 1; point < ramp.points.size(); ++point) {
        strain.push_back(ramp.points[point].strain);
        secant.push_back(ramp.secant_modulus(point, orientation));
    }
    return mechanics::yield_strain(strain, secant, yield_fraction);
}

void append_peak(Results& results, const std::string& path, const Test& test) {
    const auto stress = [&](const mechanics::StrainPoint& point) { return std::abs(stress_on_plates(point, test.orientation)); };
    const auto peak = std::max_element(test.ramp.points.begin(), test.ramp.points.end(),
                                       [&](const auto& a, const auto& b) { return stress(a) < stress(b); });
    results.push_back(io::scalar(path + "yield_strain", yield_strain_of(test.ramp, test.orientation), "1",
                                 "strain where the secant modulus has fallen to 0.9 of the first one; NaN: nowhere"));
    results.push_back(io::scalar(path + "peak_strain", peak->strain, "1", "strain of the largest stress"));
    results.push_back(io::scalar(path + "peak_stress", stress(*peak), "Pa", "largest stress"));
}

void append_ramp(Results& results, const std::string& path, const Test& test) {
    append_points(results, path, test.ramp, test.orientation);
    append_broken(results, path, test.ramp.broken);
    append_failure(results, path, test.ramp.failure);
    append_peak(results, path, test);
}

/// One secant modulus per orientation: that of the first step.
Eigen::MatrixXd first_moduli(const std::vector<Test>& tests) {
    Eigen::MatrixXd first(static_cast<Index>(tests.size()), 1);
    for (std::size_t k = 0; k < tests.size(); ++k) {
        const mechanics::RampResponse& ramp = tests[k].ramp;
        first(static_cast<Index>(k), 0) = ramp.points.size() > 1 ? ramp.secant_modulus(1, tests[k].orientation) : unset;
    }
    return first;
}

/// Mean stress from a strain to the end of a ramp [Pa]; NaN where the strain is.
double mean_stress_from(const mechanics::RampResponse& ramp, const ShearOrientation& orientation, double from) {
    double sum = 0;
    for (std::size_t k = 1; k < ramp.points.size(); ++k) {
        const double begin = std::max(from, ramp.points[k - 1].strain);
        const double end = ramp.points[k].strain;
        const double width = end - ramp.points[k - 1].strain;
        if (end <= begin || width <= 0) {
            continue;
        }
        const double before = stress_on_plates(ramp.points[k - 1], orientation);
        const double after = stress_on_plates(ramp.points[k], orientation);
        const double at_begin = before + (after - before) * (begin - ramp.points[k - 1].strain) / width;
        sum += 0.5 * (at_begin + after) * (end - begin);
    }
    const double length = ramp.points.back().strain - from;
    return length > 0 ? sum / length : unset;
}

}  // namespace

void count_compression_positive(Test& test) {
    for (mechanics::StrainPoint& point : test.ramp.points) {
        point.strain = 0 - point.strain;
        point.stress = Eigen::Matrix3d::Zero() - point.stress;
    }
    for (mechanics::BrokenBond& bond : test.ramp.broken) {
        bond.strain = -bond.strain;
    }
    if (test.ramp.failure) {
        test.ramp.failure->strain = -test.ramp.failure->strain;
    }
}

void append_ramps(Results& results, const std::vector<QuasistaticTest>& tests) {
    for (const Test& test : tests) {
        append_ramp(results, quasistatic_group + "ramp/" + name_of(test.orientation) + "/", test);
    }
    const Eigen::MatrixXd first = first_moduli(tests);
    append_modulus(
        results, quasistatic_group + "storage_modulus", tests, first,
        first.hasNaN() ? "secant modulus of the first step; NaN: the network failed there" : "secant modulus of the first step");
    append_modulus(results, quasistatic_group + "loss_modulus", tests, Eigen::MatrixXd::Constant(first.rows(), 1, unset),
                   "NaN: not measured on a ramp");
    results.push_back(io::scalar(quasistatic_group + "phase", unset, "rad", "NaN: not measured on a ramp"));
}

void append_compressions(Results& results, const std::vector<QuasistaticTest>& tests, double volume_fraction) {
    for (const Test& test : tests) {
        const std::string path = compression_group + "ramp/" + name_of(test.orientation) + "/";
        append_ramp(results, path, test);
        const auto fraction_at = [&](double strain) { return volume_fraction / (1 - strain); };
        const auto add = [&](const std::string& name, double value, const std::string& unit, const std::string& description) {
            results.push_back(io::scalar(path + name, value, unit, description));
        };
        results.push_back(io::vector(path + "volume_fraction",
                                     collect(test.ramp.points, [&](const auto& point) { return fraction_at(point.strain); }), "1",
                                     "solid volume over that of the compressed cell"));
        const int axis = test.orientation.normal;
        results.push_back(io::vector(
            path + "lateral_stress",
            collect(test.ramp.points, [&](const auto& point) { return (point.stress.trace() - point.stress(axis, axis)) / 2; }),
            "Pa", "mean normal stress across the axis, compression > 0"));
        const double yield = yield_strain_of(test.ramp, test.orientation);
        add("yield_volume_fraction", fraction_at(yield), "1", "volume fraction at the yield strain; NaN: it does not yield");
        add("yield_stress",
            stress_on_plates(test.ramp.points.front(), test.orientation) +
                yield_fraction * (std::isnan(yield) ? unset : test.ramp.secant_modulus(1, test.orientation)) * yield,
            "Pa", "stress at the yield strain; NaN: it does not yield");
        add("plateau_stress", mean_stress_from(test.ramp, test.orientation, yield), "Pa",
            "mean stress from the yield strain to the end; NaN: it does not yield");
    }
    append_modulus(results, compression_group + "longitudinal_modulus", tests, first_moduli(tests),
                   "secant modulus of the first step, uniaxial strain");
}

void append_sweeps(Results& results, const std::vector<QuasistaticTest>& tests, const std::vector<double>& amplitudes) {
    const auto count = static_cast<Index>(amplitudes.size());
    results.push_back(io::vector(quasistatic_group + "amplitude", Eigen::VectorXd::Map(amplitudes.data(), count), "1",
                                 "amplitudes of strain, in the order of the run"));
    const bool all_reached = std::all_of(tests.begin(), tests.end(),
                                         [&](const Test& test) { return test.sweep.amplitudes.size() == amplitudes.size(); });
    const std::string not_reached = all_reached ? "" : "; NaN: not reached, the network failed before";
    Eigen::MatrixXd storage(static_cast<Index>(tests.size()), count);
    Eigen::MatrixXd loss = storage;
    for (std::size_t k = 0; k < tests.size(); ++k) {
        const auto& run = tests[k].sweep.amplitudes;
        const auto column = [&](const auto& value) {
            Eigen::VectorXd values = Eigen::VectorXd::Constant(count, unset);
            values.head(static_cast<Index>(run.size())) = collect(run, value);
            return values;
        };
        storage.row(static_cast<Index>(k)) = column([](const auto& a) { return a.storage_modulus; });
        loss.row(static_cast<Index>(k)) = column([](const auto& a) { return a.loss_modulus; });
        const std::string path = quasistatic_group + "sweep/" + name_of(tests[k].orientation) + "/";
        const auto add = [&](const std::string& name, const auto& value, const std::string& unit, const std::string& description) {
            results.push_back(io::vector(path + name, column(value), unit, description + not_reached));
        };
        using Entry = mechanics::AmplitudeResponse;
        add(
            "third_harmonic", [](const Entry& a) { return a.third_harmonic; }, "1",
            "third harmonic of the stress over its fundamental");
        add(
            "loop_area", [](const Entry& a) { return a.loop_area; }, "J/m3", "area of the loop of stress against strain");
        add(
            "peak_stress", [](const Entry& a) { return a.peak_stress; }, "Pa", "largest shear stress of the cycle");
        add(
            "bonds", [](const Entry& a) { return static_cast<double>(a.bonds); }, "1", "bonds intact at the end of the cycle");
        add(
            "balance_error", [](const Entry& a) { return a.balance_error; }, "1",
            "work less the change of energy, over the gross work");
        append_broken(results, path, tests[k].sweep.broken);
        append_failure(results, path, tests[k].sweep.failure);
    }
    append_modulus(results, quasistatic_group + "storage_modulus", tests, storage,
                   "fundamental in phase, per amplitude" + not_reached);
    append_modulus(results, quasistatic_group + "loss_modulus", tests, loss,
                   "fundamental ahead of the strain, per amplitude" + not_reached);
    const Eigen::VectorXd phase = loss.colwise().mean().binaryExpr(
        storage.colwise().mean(), [](double lost, double stored) { return std::atan2(lost, stored); });
    results.push_back(io::vector(quasistatic_group + "phase", phase, "rad", "phase of the mean moduli" + not_reached));
}

Table table_of_tests(const std::vector<QuasistaticTest>& tests, bool sweep) {
    Table table;
    for (const Test& test : tests) {
        const std::string name = name_of(test.orientation);
        if (sweep) {
            for (const auto& entry : test.sweep.amplitudes) {
                table.emplace_back(name + ", amplitude " + with_unit(entry.amplitude, "1"),
                                   "G' " + with_unit(entry.storage_modulus, "Pa") + ", G'' " + with_unit(entry.loss_modulus, "Pa") +
                                       ", " + std::to_string(entry.broken) + " bonds broken");
            }
        } else {
            const auto& points = test.ramp.points;
            const std::string value =
                test.orientation.is_uniaxial()
                    ? "normal stress " + with_unit(stress_on_plates(points.back(), test.orientation), "Pa")
                    : "secant modulus " + with_unit(test.ramp.secant_modulus(points.size() - 1, test.orientation), "Pa");
            table.emplace_back(
                name + (test.orientation.is_uniaxial() ? ", compression " : ", strain ") + with_unit(points.back().strain, "1"),
                value + ", " + std::to_string(test.ramp.broken.size()) + " bonds broken");
        }
        const auto& failure = sweep ? test.sweep.failure : test.ramp.failure;
        if (failure) {
            table.emplace_back(name, sentence_of(*failure));
        }
    }
    return table;
}

}  // namespace coagula::stages
