// SPDX-License-Identifier: GPL-3.0-or-later
// Creep, relaxation and start-up as G*, against closed forms.
#include <coagula/diagnose/check_data.hpp>
#include <coagula/diagnose/step_test.hpp>
#include <coagula/diagnose/tool_constants.hpp>

#include "data/step_smoothing.hpp"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;
using Curve = std::function<double(double)>;
using ModulusCurve = std::function<Complex(double)>;

std::vector<double> times_to(double last) {
    std::vector<double> times;
    for (int k = 0; k < 200; ++k) {
        times.push_back(last * std::pow(10, -4.0 + 4.0 * k / 199));
    }
    return times;
}

/// The ratio column of a step test, with relative scatter.
Measurement table_of(MeasurementKind kind, const std::vector<double>& times, const Curve& response, double scatter = 0,
                     int seed = 1) {
    const char* ratio = kind == MeasurementKind::creep               ? "compliance"
                        : kind == MeasurementKind::stress_relaxation ? "relaxation_modulus"
                                                                     : "viscosity";
    std::mt19937 random(static_cast<unsigned>(seed));
    std::normal_distribution<double> normal;
    Measurement table;
    table.kind = kind;
    table.label = "step.csv";
    table.columns = {{"time", "s", times}, {ratio, std::string(find_quantity(ratio)->unit), {}}};
    for (const double time : times) {
        table.columns[1].values.push_back(response(time) * (1 + scatter * normal(random)));
    }
    return table;
}

/// The sweep that stands for a step test, with its errors.
struct Converted : Measurement {
    TableErrors errors;
};

Converted converted(Measurement table) {
    Experiment experiment;
    experiment.measurements.push_back(std::move(table));
    const std::vector<StepConversion> conversions = convert_step_tests(experiment);
    EXPECT_EQ(conversions.size(), 1);
    return {experiment.measurements.front(), conversions.front().errors};
}

Complex modulus_in(const Measurement& sweep, std::size_t row) {
    return {find_column(sweep, "storage_modulus")->values[row], find_column(sweep, "loss_modulus")->values[row]};
}

double error_in(const Converted& sweep, std::size_t row) {
    return std::hypot(sweep.errors.columns[0].deviations[row], sweep.errors.columns[1].deviations[row]);
}

/// Every row is the closed form to a hundredth, and to its error; the middle error is small.
void expect_closed_form(const Converted& sweep, const ModulusCurve& truth, std::size_t fewest) {
    ASSERT_GE(sweep.rows(), fewest);
    EXPECT_EQ(sweep.kind, MeasurementKind::frequency_sweep);
    std::vector<double> errors;
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
        const double frequency = sweep.columns.front().values[row];
        const Complex exact = truth(frequency);
        const double off = std::abs(modulus_in(sweep, row) - exact);
        EXPECT_LT(off, 0.01 * std::abs(exact)) << frequency;
        EXPECT_LT(off, error_in(sweep, row)) << frequency;
        errors.push_back(error_in(sweep, row) / std::abs(exact));
    }
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.02);
}

Complex maxwell(double frequency) {
    const Complex product(0, 2 * frequency);
    return 100.0 * product / (1.0 + product);
}

TEST(StepTest, RelaxationOfAMaxwellFluid) {
    const Measurement relaxation =
        table_of(MeasurementKind::stress_relaxation, times_to(100), [](double t) { return 100 * std::exp(-t / 2); });
    expect_closed_form(converted(relaxation), maxwell, 18);
}

TEST(StepTest, CreepOfAMaxwellFluid) {
    const Measurement creep = table_of(MeasurementKind::creep, times_to(100), [](double t) { return 0.01 + t / 200; });
    expect_closed_form(converted(creep), maxwell, 18);
}

TEST(StepTest, StartUpOfAMaxwellFluid) {
    const Measurement start =
        table_of(MeasurementKind::start_up, times_to(100), [](double t) { return 200 * (1 - std::exp(-t / 2)); });
    expect_closed_form(converted(start), maxwell, 18);
}

TEST(StepTest, CreepOfAKelvinVoigtSolid) {
    const Measurement creep =
        table_of(MeasurementKind::creep, times_to(100), [](double t) { return 0.01 * (1 - std::exp(-2 * t)); });
    expect_closed_form(
        converted(creep), [](double w) { return Complex(100, 50 * w); }, 18);
}

/// 0.01 1/Pa at once, 0.02 1/Pa in 2 s, and flow at 1 kPa.s.
double burgers_compliance(double t) {
    return 0.01 + 0.02 * (1 - std::exp(-t / 2)) + t / 1000;
}

Complex burgers(double w) {
    return 1.0 / (0.01 + 0.02 / Complex(1, 2 * w) + 1.0 / Complex(0, 1000 * w));
}

TEST(StepTest, CreepOfABurgersFluid) {
    expect_closed_form(converted(table_of(MeasurementKind::creep, times_to(100), burgers_compliance)), burgers, 18);
}

TEST(StepTest, CreepOfAnOil) {
    const Measurement creep = table_of(MeasurementKind::creep, times_to(100), [](double t) { return t / 50; });
    expect_closed_form(
        converted(creep), [](double w) { return Complex(0, 50 * w); }, 18);
}

TEST(StepTest, RelaxationThatFollowsAPower) {
    const Measurement relaxation =
        table_of(MeasurementKind::stress_relaxation, times_to(100), [](double t) { return 100 * std::pow(t, -0.2); });
    expect_closed_form(
        converted(relaxation), [](double w) { return 100 * std::tgamma(0.8) * std::pow(Complex(0, w), 0.2); }, 18);
}

/// Errors of scatter have the size that the rows say.
TEST(StepTest, ErrorsHoldTheScatter) {
    constexpr int runs = 40;
    double squares = 0;
    double count = 0;
    for (int seed = 1; seed <= runs; ++seed) {
        const Converted sweep = converted(table_of(MeasurementKind::creep, times_to(100), burgers_compliance, 0.01, seed));
        for (std::size_t row = 0; row < sweep.rows(); ++row) {
            const Complex exact = burgers(sweep.columns.front().values[row]);
            squares += std::norm((modulus_in(sweep, row) - exact) / error_in(sweep, row));
            ++count;
        }
    }
    const double ratio = std::sqrt(squares / count);
    EXPECT_GT(ratio, 0.6);
    EXPECT_LT(ratio, 1.3);
}

/// A creep of a standard linear solid under a tool with inertia, from the eigenvectors of its equation of motion.
TEST(StepTest, TheInertiaWithWhichACreepRingsIsInTheModulus) {
    constexpr double elastic = 5000;
    constexpr double relaxing = 1000;
    constexpr double viscosity = 5;
    constexpr double inertia = 20e-6;
    const Instrument plates{.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    const ToolConstants tool = tool_constants(plates);
    const double stiffness = tool.torque_per_modulus();
    constexpr double torque = 1e-6;
    Eigen::Matrix3d motion;
    motion << 0, 1, 0, -stiffness * elastic / inertia, -stiffness * viscosity / inertia, -stiffness / inertia, 0, relaxing, -1;
    const Eigen::Vector3d end = -motion.inverse() * Eigen::Vector3d(0, torque / inertia, 0);
    const Eigen::EigenSolver<Eigen::Matrix3d> modes(motion);
    const Eigen::Vector3cd shares = modes.eigenvectors().inverse() * -end.cast<Complex>();
    Measurement creep;
    creep.kind = MeasurementKind::creep;
    creep.label = "creep.csv";
    creep.columns = {{"time", "s", {}}, {"deflection", "rad", {}}, {"torque", "N.m", {}}};
    for (int row = 1; row <= 600; ++row) {
        const double time = row <= 500 ? 2e-3 * row : std::pow(100.0, (row - 500) / 100.0);
        const Eigen::Vector3cd state =
            modes.eigenvectors() * shares.cwiseProduct((modes.eigenvalues() * time).array().exp().matrix());
        creep.columns[0].values.push_back(time);
        creep.columns[1].values.push_back(end[0] + state[0].real());
        creep.columns[2].values.push_back(torque);
    }
    derive_step_response(creep, plates, false);
    const Converted sweep = converted(creep);
    ASSERT_GE(sweep.rows(), 20);
    EXPECT_LT(modulus_in(sweep, 0).real(), -10000);  // beyond the resonance
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
        const double w = sweep.columns.front().values[row];
        const Complex exact =
            elastic + relaxing * Complex(0, w) / Complex(1, w) + Complex(-inertia * w * w / stiffness, viscosity * w);
        EXPECT_LT(std::abs(modulus_in(sweep, row) - exact), error_in(sweep, row)) << w;
    }
    EXPECT_NEAR(modulus_in(sweep, sweep.rows() - 1).real(), elastic, 0.02 * elastic);
    EXPECT_NEAR(find_column(sweep, "strain")->values.front() / (tool.strain * creep.columns[1].values.back()), 1, 0.7);
}

TEST(StepTest, TheLastRowIsAtTheEndOfTheStep) {
    const Converted sweep = converted(table_of(MeasurementKind::creep, times_to(100), burgers_compliance));
    const std::vector<double>& time = find_column(sweep, "time")->values;
    const std::vector<double>& frequency = find_column(sweep, "angular_frequency")->values;
    EXPECT_NEAR(time.back(), 100, 1e-9);
    EXPECT_NEAR(time.front() * frequency.front(), time.back() * frequency.back(), 1e-9);
    EXPECT_TRUE(sweep.errors.polar);
    EXPECT_TRUE(*sweep.stress_controlled);
}

std::string refusal_of(Measurement table) {
    try {
        derive_step_response(table, {}, false);
        Experiment experiment;
        experiment.measurements.push_back(std::move(table));
        convert_step_tests(experiment);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

Measurement of_signals(MeasurementKind kind, const Curve& step, const Curve& response) {
    const bool creep = kind == MeasurementKind::creep;
    const bool rate = kind == MeasurementKind::start_up;
    Measurement table;
    table.kind = kind;
    table.label = "step.csv";
    table.columns = {{"time", "s", times_to(100)},
                     {creep ? "stress" : (rate ? "shear_rate" : "strain"), creep ? "Pa" : (rate ? "1/s" : "1"), {}},
                     {creep ? "strain" : "stress", creep ? "1" : "Pa", {}}};
    for (const double time : table.columns[0].values) {
        table.columns[1].values.push_back(step(time));
        table.columns[2].values.push_back(response(time));
    }
    return table;
}

TEST(StepTest, RefusesWhatIsNoLinearStep) {
    const auto one = [](double) { return 1.0; };
    const auto rising = [](double t) { return 1 - std::exp(-t); };
    EXPECT_EQ(refusal_of(of_signals(MeasurementKind::creep, one, rising)), "");
    EXPECT_NE(refusal_of(of_signals(
                             MeasurementKind::creep, [](double) { return 0.0; }, rising))
                  .find("'stress' is 0 in every row"),
              std::string::npos);
    EXPECT_NE(refusal_of(of_signals(
                             MeasurementKind::creep, [](double) { return -1.0; }, rising))
                  .find("opposite signs"),
              std::string::npos);
    EXPECT_NE(refusal_of(of_signals(
                             MeasurementKind::creep, [](double t) { return t < 1 ? 1.0 : 2.0; }, rising))
                  .find("must stay"),
              std::string::npos);
    EXPECT_NE(
        refusal_of(of_signals(MeasurementKind::start_up, one, [](double t) { return 1 - std::exp(-t) + t * std::exp(-t / 2); }))
            .find("overshoots"),
        std::string::npos);
    Measurement late = of_signals(MeasurementKind::creep, one, rising);
    for (double& time : late.columns.front().values) {
        time += 1000;
    }
    EXPECT_NE(refusal_of(late).find("time_zero"), std::string::npos);
    EXPECT_NE(refusal_of(table_of(MeasurementKind::creep, times_to(100), burgers_compliance, 2)).find("less scatter"),
              std::string::npos);
    EXPECT_NE(refusal_of(table_of(MeasurementKind::creep, {1, 2, 3}, burgers_compliance)).find("a step test needs 8"),
              std::string::npos);
}

TEST(StepSmoothing, FactorSolvesWhatADenseOneDoes) {
    constexpr Eigen::Index rows = 9;
    Eigen::Matrix<double, 4, Eigen::Dynamic> bands = Eigen::MatrixXd::Random(4, rows);
    bands.row(0).array() += 10;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(rows, rows);
    for (Eigen::Index row = 0; row < rows; ++row) {
        for (Eigen::Index d = 0; d <= std::min<Eigen::Index>(3, row); ++d) {
            dense(row, row - d) = dense(row - d, row) = bands(d, row);
        }
    }
    const Eigen::VectorXd right = Eigen::VectorXd::Random(rows);
    EXPECT_LT((BandedFactor(bands).solve(right) - dense.llt().solve(right)).norm(), 1e-12);
}

TEST(StepSmoothing, ScatterIsThatOfTheValues) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    Eigen::ArrayXd times(2000);
    Eigen::VectorXd values(2000);
    for (Eigen::Index k = 0; k < times.size(); ++k) {
        times[k] = 0.01 * static_cast<double>(k);
        values[k] = std::sin(times[k]) + 0.03 * normal(random);
    }
    const Eigen::VectorXd deviations = scatter_of(times, values);
    EXPECT_NEAR(deviations.mean(), 0.03, 0.004);
    const Smoother smoother(values, deviations);
    const double off = std::sqrt((smoother.smoothed(values).array() - times.sin()).square().mean());
    EXPECT_LT(off, 0.012);  // ten rows are averaged, and the curve is left as it is
    Eigen::VectorXcd weights = Eigen::VectorXcd::Zero(2000);
    weights[1000] = {1, 2};
    EXPECT_NEAR(std::abs(smoother.on_values(weights).cwiseProduct(values).sum() - weights[1000] * smoother.smoothed(values)[1000]),
                0, 1e-10);
}

}  // namespace
}  // namespace coagula::diagnose
