// SPDX-License-Identifier: GPL-3.0-or-later
// Bonds that shear breaks and rest re-forms: the kinetic law, the history of the strain, and bonds that are drawn one by one.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "responses/thinned_contacts.hpp"

#include <coagula/mechanics/linear.hpp>

#include <gtest/gtest.h>

namespace coagula::diagnose {
namespace {

using std::numbers::pi;

constexpr double angular_frequency = 2 * pi;
constexpr double build_up = 400;  // s
constexpr double breakdown = 1;   // per unit of strain that is sheared through
constexpr double small = 1e-5;    // strain

/// Mean magnitude of the shear rate of an oscillation.
double rate_of(double strain) {
    return 2 / pi * strain * angular_frequency;
}

/// Rows every `step` seconds on the clock of their run.
Measurement run_of(const std::vector<double>& strains, double step, int order,
                   MeasurementKind kind = MeasurementKind::amplitude_sweep) {
    Measurement table;
    table.kind = kind;
    table.label = "run " + std::to_string(order);
    table.sample = "gel";
    table.run_order = order;
    Column time{"time", "s", {}};
    for (std::size_t row = 0; row < strains.size(); ++row) {
        time.values.push_back(step * static_cast<double>(row + 1));
    }
    const std::vector<double> ones(strains.size(), 1.0);
    table.columns = {time,
                     {"strain", "1", strains},
                     {"angular_frequency", "rad/s", std::vector<double>(strains.size(), angular_frequency)},
                     {"storage_modulus", "Pa", ones}};
    return table;
}

TEST(StrainHistory, HasRunsAndTheRestBetweenThem) {
    Experiment experiment;
    Measurement second = run_of({2e-3}, 20, 1);
    second.pause = 100;
    Measurement flow = run_of({unset}, 30, 2, MeasurementKind::flow_curve);
    flow.columns[1] = {"shear_rate", "1/s", {-5}};
    flow.preshear = 40;
    experiment.measurements = {second, run_of({1e-4, 3e-4}, 10, 0), flow};
    const StrainHistory history(experiment);
    const std::vector<ShearedSpan>& spans = history.of(0);
    ASSERT_EQ(spans.size(), 4U);
    const std::vector<std::array<double, 3>> expected{
        {0, 10, rate_of(1e-4)}, {10, 20, rate_of(3e-4)}, {140, 140, rate_of(2e-3)}, {220, 220, 5}};
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(spans[k].to, expected[k][1], 1e-9) << k;
        EXPECT_NEAR(spans[k].rate, expected[k][2], 1e-12) << k;
        EXPECT_EQ(spans[k].destroyed, k == 3) << k;
    }
    EXPECT_EQ(spans[0].from, 0);
    experiment.measurements[0].run_order = 0;  // nothing says which came first
    const StrainHistory unknown(experiment);
    ASSERT_EQ(unknown.of(0).size(), 1U);
    EXPECT_EQ(unknown.of(0)[0].rate, 5);
}

/// Modulus over that at rest, row by row.
std::vector<double> left(const std::vector<Measurement>& runs, double per_strain, double time) {
    Experiment experiment;
    experiment.measurements = runs;
    const auto rows = observations_of(experiment);
    const Forward forward(experiment, rows, simulator());
    const Eigen::VectorXd ratio = forward.predict(Model({find_mechanism("thixotropy")}, std::array{per_strain, time})).array() /
                                  forward.predict(Model{}).array();
    return {ratio.begin(), ratio.end()};
}

/// d s / dt = (1 - s) / T - k r s has s = e + (s_0 - e) exp(-t (1/T + k r)), e = 1 / (1 + k r T).
TEST(Thixotropy, BreaksDownToItsEndAndComesBackAtRest) {
    const double strain = 1e-3;
    constexpr double slow = breakdown / 6;
    Measurement rested = run_of({small}, 1, 1);
    rested.pause = 300;
    const std::vector<double> found = left({run_of({strain, strain, strain}, 40, 0), rested}, slow, build_up);
    const double end = 1 / (1 + slow * rate_of(strain) * build_up);
    const auto share = [&](double time) { return end + (1 - end) * std::exp(-time / (build_up * end)); };
    for (int row = 0; row < 3; ++row) {
        EXPECT_NEAR(found[static_cast<std::size_t>(row)], thinned_response(simulator(), 1 - share(40.0 * (row + 1))), 1e-9);
    }
    const double after = 1 - (1 - share(120)) * std::exp(-301 / build_up);
    EXPECT_NEAR(found[3], thinned_response(simulator(), 1 - after), 1e-4);
    EXPECT_GT(found[3], found[2]);
    EXPECT_LT(found[2], 0.8);
}

/// What a shear destroyed has no bonds at first.
TEST(Thixotropy, BeginsWithoutBondsAfterAShear) {
    Measurement table = run_of({small, small, small}, 2000, 0);
    table.preshear = 60;
    const std::vector<double> found = left({table}, 1e-4, 500);
    for (int row = 0; row < 3; ++row) {
        const double missing = std::exp(-2000.0 * (row + 1) / 500);
        EXPECT_NEAR(found[static_cast<std::size_t>(row)], thinned_response(simulator(), missing), 2e-5) << row;
    }
}

/// Bonds of a structure that the diagnosis does not know, each broken and formed again by the throw of a die in steps of a second;
/// moduli of those that are left, mean over some structures.
std::vector<double> drawn_moduli(const std::vector<double>& strain_of_second, const std::vector<std::size_t>& measured_at) {
    std::vector<double> moduli(measured_at.size(), 0.0);
    const std::vector<std::uint64_t> seeds{77, 78, 79};
    for (const std::uint64_t seed : seeds) {
        const Packing packing = structure(260, seed);
        const ContactNetwork whole = find_contacts(packing, 0.01);
        std::vector<bool> there(static_cast<std::size_t>(whole.size()), true);
        std::size_t next = 0;
        for (std::size_t second = 0; second < strain_of_second.size() && next < measured_at.size(); ++second) {
            for (std::size_t bond = 0; bond < there.size(); ++bond) {
                const double chance = random_uniform(seed, RandomPurpose::test, 1000 + second, bond)[0];
                there[bond] = there[bond] ? chance > breakdown * rate_of(strain_of_second[second]) : chance < 1 / build_up;
            }
            if (second + 1 == measured_at[next]) {
                std::vector<Index> kept;
                for (std::size_t bond = 0; bond < there.size(); ++bond) {
                    if (there[bond]) {
                        kept.push_back(static_cast<Index>(bond));
                    }
                }
                const ContactNetwork bonds{whole.particles, whole.ends(Eigen::all, kept), whole.branch(Eigen::all, kept)};
                moduli[next++] += mechanics::solve_linear(packing, bonds).mean_shear_modulus() / static_cast<double>(seeds.size());
            }
        }
    }
    return moduli;
}

/// Up in strain, a rest, small strains while it recovers, and the same sweep again.
std::vector<Measurement> rest_and_repeat(double error, std::uint64_t seed) {
    const std::vector<double> up = logarithmic_steps(small, 4e-4, 10);
    std::vector<Measurement> runs{run_of(up, 20, 0), run_of(std::vector<double>(8, small), 60, 1, MeasurementKind::time_sweep),
                                  run_of(up, 20, 2)};
    std::vector<double> strain_of_second;
    std::vector<std::size_t> measured_at;
    for (Measurement& run : runs) {
        if (run.run_order > 0) {
            run.pause = 10;
            strain_of_second.insert(strain_of_second.end(), 10, 0.0);
        }
        const std::vector<double>& strains = find_column(run, "strain")->values;
        const auto step = static_cast<std::size_t>(find_column(run, "time")->values.front());
        for (const double strain : strains) {
            strain_of_second.insert(strain_of_second.end(), step, strain);
            measured_at.push_back(strain_of_second.size());
        }
    }
    const std::vector<double> moduli = drawn_moduli(strain_of_second, measured_at);
    std::size_t next = 0;
    for (Measurement& run : runs) {
        Column& storage = run.columns.back();
        for (double& value : storage.values) {
            storage.standard_errors.push_back(error * moduli[next]);
            value = moduli[next] * (1 + error * drawn_normal(seed, next));
            ++next;
        }
    }
    return runs;
}

TEST(Thixotropy, IsNamedWhereItComesBackAtRest) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::cone_plate, .plate_radius = 0.0125, .cone_angle = 0.03};
    experiment.measurements = rest_and_repeat(0.04, 3);
    DiagnosisOptions options;
    options.bootstrap = 399;
    const Diagnosis found = diagnose(experiment, simulator(), options);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::named);
    EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"thixotropy"});
    const auto& parameters = found.causes.front().parameters;
    ASSERT_EQ(parameters.size(), 3U);
    EXPECT_NEAR(std::log(parameters[1].value / breakdown), 0, std::log(1.5));
    EXPECT_NEAR(std::log(parameters[2].value / build_up), 0, std::log(1.5));

    // The sweep up alone: bonds that break, or open and close again, do as well.
    experiment.measurements.resize(1);
    const Diagnosis up = diagnose(experiment, simulator(), options);
    EXPECT_TRUE(up.detected);
    EXPECT_EQ(up.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(up, "thixotropy")) << name_of(up.credible_set.front());
    ASSERT_FALSE(up.proposals.empty());
}

}  // namespace
}  // namespace coagula::diagnose
