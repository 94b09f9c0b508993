// SPDX-License-Identifier: GPL-3.0-or-later
// Drag of the solvent: its limits, the extended model, and a sweep of another structure in which it is hidden.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "hidden_effects.hpp"
#include "infer/hypothesis.hpp"
#include "responses/drag_response.hpp"
#include "responses/drag_scatter.hpp"
#include "responses/linear_modulus.hpp"

#include <coagula/diagnose/model.hpp>
#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/linear.hpp>

#include <gtest/gtest.h>

#include <memory>
#include <numeric>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

/// Settings at which drag times angular frequency over the normal stiffness is this at 1 rad/s.
Settings with_drag(double reduced) {
    Settings settings;
    settings.felt_viscosity = reduced * settings.normal_stiffness / translation_drag(0.25e-6);
    return settings;
}

TEST(SolventDrag, LosesInProportionToTheFrequency) {
    const Complex slow = exact_drag_response(simulator(), with_drag(1e-8), 1);
    const Complex fast = exact_drag_response(simulator(), with_drag(1e-8), 10);
    EXPECT_GT(slow.imag(), 1e-7);
    EXPECT_NEAR(fast.imag() / slow.imag(), 10, 0.1);
    EXPECT_NEAR(fast.real(), 1, 0.01 * fast.imag());
    // Slower where the softest motions no longer follow, but steeper than the springpots of contact-loss, exponent 0.3 at most.
    for (const double frequency : {1.0, 10.0, 100.0}) {
        const double more = drag_response(simulator(), with_drag(1e-6), 10 * frequency).imag() /
                            drag_response(simulator(), with_drag(1e-6), frequency).imag();
        EXPECT_GT(std::log10(more), 0.5) << frequency;
        EXPECT_LT(std::log10(more), 1.0 + 1e-9) << frequency;
    }
    EXPECT_EQ(drag_response(simulator(), Settings{}, 1), Complex(1));
}

/// Particles that the solvent carries with it move affinely.
TEST(SolventDrag, EndsAtTheAffineModulus) {
    double affine = 0;
    double relaxed = 0;
    for (const std::uint64_t seed : {1U, 2U}) {
        const Packing packing = structure(200, seed);
        const auto linear = mechanics::solve_linear(packing, find_contacts(packing, 0.01));
        affine += linear.mean_affine_modulus();
        relaxed += linear.mean_shear_modulus();
    }
    for (const double reduced : {100.0, 1e5}) {
        const Complex response = drag_response(simulator(), with_drag(reduced), 1);
        EXPECT_NEAR(response.real() / (affine / relaxed), 1, 1e-3);
        EXPECT_LT(response.imag(), 0.01 * response.real());
    }
}

TEST(SolventDrag, CurveAgreesWithTheSolver) {
    for (const double reduced : logarithmic_steps(3e-7, 30, 9)) {
        const Settings settings = with_drag(reduced);
        const Complex curve = drag_response(simulator(), settings, 1);
        const Complex solved = exact_drag_response(simulator(), settings, 1);
        EXPECT_LT(std::abs(curve - solved), 0.01 * std::abs(solved - 1.0)) << reduced;
    }
}

/// Sum of the squares of independent errors of the logarithm of the loss: their variance.
double variance_of_loss(Simulator& some, const Settings& settings) {
    double sum = 0;
    const Complex lost = drag_response(some, settings, 1) - 1.0;
    const Eigen::RowVectorXcd excess = drag_excess(some, settings, 1);
    for (const Complex error : excess.tail(excess.size() - 1)) {
        sum += std::pow((lost * error).imag() / lost.imag(), 2);
    }
    return sum;
}

/// One structure: the stated scatter. More of them: less in proportion to their number, and more where they differ by more.
TEST(SolventDrag, TheScatterOfStructuresIsStatedAndCorrected) {
    Eigen::ArrayXd drags(19);
    for (Eigen::Index node = 0; node < drags.size(); ++node) {
        drags[node] = 1e-7 * std::pow(10, 0.5 * static_cast<double>(node));
    }
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(19, 1);
    const DragScatter one = drag_scatter(drags, 400, none, 1, 1);
    EXPECT_EQ(one.degrees, 6);
    const Eigen::VectorXd deviation = one.errors.rowwise().norm();
    EXPECT_NEAR(deviation[8], 0.12, 0.005);  // at 1e-3, all but the smallest parts
    EXPECT_NEAR(deviation[0], 1.52, 0.03);
    const auto alike = [&](Eigen::Index a, Eigen::Index b) {
        return one.errors.row(a).dot(one.errors.row(b)) / (deviation[a] * deviation[b]);
    };
    EXPECT_NEAR(alike(6, 8), 0.81, 0.03);  // over one decade, as the structures of tests/benchmark/drag_scatter.py are
    EXPECT_NEAR(alike(6, 10), 0.53, 0.04);
    const DragScatter four = drag_scatter(drags, 400, none, 1, 4);
    EXPECT_LT((drag_scatter(drags, 1600, none, 1, 1).errors - four.errors).norm(), 1e-12);
    EXPECT_NEAR(four.errors.row(18).norm() / one.errors.row(18).norm(), 0.5, 0.01);
    // Structures that scatter by three times as much, in the same way.
    constexpr Eigen::Index count = 400;
    Eigen::MatrixXd logarithms(19, count);
    for (Eigen::Index structure = 0; structure < count; ++structure) {
        Eigen::VectorXd normal(one.errors.cols());
        for (Eigen::Index k = 0; k < normal.size(); ++k) {
            normal[k] = drawn_normal(5, static_cast<std::size_t>(structure * normal.size() + k));
        }
        logarithms.col(structure) = 3 * one.errors * normal;
    }
    logarithms.colwise() -= logarithms.rowwise().mean().eval();
    const DragScatter many = drag_scatter(drags, 400, logarithms, 1, 1);
    EXPECT_NEAR(many.errors.norm() / one.errors.norm(), 3, 0.15);
    EXPECT_GT(many.degrees, 1000);
}

/// Where structures differ by factors, the logarithm of the mean of two lies below that of the mean of many, and scatters, as that
/// of two lognormal numbers.
TEST(SolventDrag, TheMeanOfFewLacksThoseThatLoseMost) {
    const Eigen::ArrayXd drags = Eigen::ArrayXd::LinSpaced(19, std::log(1e-7), std::log(100)).exp();
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(19, 2);
    const DragScatter two = drag_scatter(drags, 400, none, 2, 2);
    const Eigen::VectorXd one = drag_scatter(drags, 400, none, 2, 1).errors.rowwise().norm();
    for (const Eigen::Index node : {2, 4, 8}) {
        constexpr std::size_t draws = 20000;
        double sum = 0;
        double squares = 0;
        for (std::size_t draw = 0; draw < draws; ++draw) {
            const double mean =
                0.5 * (std::exp(one[node] * drawn_normal(7, 2 * draw)) + std::exp(one[node] * drawn_normal(7, 2 * draw + 1)));
            const double excess = 0.5 * one[node] * one[node] - std::log(mean);
            sum += excess / draws;
            squares += excess * excess / draws;
        }
        const double deviation = std::sqrt(squares - sum * sum);
        // The law is exact for small deviations.
        EXPECT_NEAR(two.excess[node], sum, 0.08 * sum + 4 * deviation / std::sqrt(draws)) << drags[node];
        EXPECT_NEAR(two.errors.row(node).norm(), deviation, 0.06 * deviation) << drags[node];
    }
}

/// The mean of two structures against that of six others: as far apart as the errors of both say.
TEST(SolventDrag, TheStructuresLeaveAnErrorThatHoldsOthers) {
    SimulationCache cache;
    std::vector<std::unique_ptr<Simulator>> alone;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        alone.push_back(std::make_unique<Simulator>(std::vector<Packing>{structure(200, seed)},
                                                    std::vector<std::string>{"alone " + std::to_string(seed)}, cache));
    }
    Simulator pair({structure(200, 1), structure(200, 2)}, {"alone 1", "alone 2"}, cache);
    double squares = 0;
    int count = 0;
    for (const double reduced : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const Settings settings = with_drag(reduced);
        std::vector<double> lost;
        for (const auto& one : alone) {
            lost.push_back(exact_linear_modulus(*one, {}) * drag_response(*one, settings, 1).imag());
        }
        const double all = std::accumulate(lost.begin(), lost.end(), 0.0);
        const double relative = std::sqrt(variance_of_loss(pair, settings));
        for (std::size_t first = 0; first < lost.size(); first += 2) {
            const double two = lost[first] + lost[first + 1];
            squares += std::pow(std::log(3 * two / (all - two)) / relative, 2) / (1 + 1.0 / 3);
            ++count;
        }
    }
    EXPECT_GT(std::sqrt(squares / count), 0.5);
    EXPECT_LT(std::sqrt(squares / count), 1.5);
    EXPECT_GT(drag_degrees(pair), 6);
}

/// What is proposed may show nothing of the sample: an oil alone. The errors of the structures are the same ones all the same.
TEST(SolventDrag, TheStructuresErrorsAreThereWhereNothingShowsThem) {
    Measurement oil;
    oil.fluid_viscosity = 1;
    oil.columns = {{"angular_frequency", "rad/s", {1, 10}}, {"loss_modulus", "Pa", {1, 10}}};
    Experiment experiment;
    experiment.measurements = {oil};
    const auto rows = observations_of(experiment);
    const Prediction found = Forward(experiment, rows, simulator()).prediction(with_drag(1e-3));
    ASSERT_GT(found.errors.changes.cols(), 2);
    EXPECT_EQ(found.errors.changes.cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(found.values, (Eigen::Vector2d{1, 10}));
}

Measurement sweep(const std::vector<double>& frequencies, const std::vector<Complex>& moduli, double error, std::uint64_t seed) {
    Measurement table;
    table.kind = MeasurementKind::frequency_sweep;
    table.label = "hidden";
    table.sample = "sample";
    Column frequency{"angular_frequency", "rad/s", {}};
    for (const double each : frequencies) {
        frequency.values.push_back(2 * pi * each);
    }
    table.columns = {frequency};
    add_moduli(table, moduli, error, seed);
    return table;
}

std::vector<Complex> moduli_of(const Packing& packing, const ContactModel& model, const std::vector<double>& frequencies) {
    std::vector<Complex> moduli;
    const auto response = mechanics::solve_frequency_sweep(packing, find_contacts(packing, 0.01), model, frequencies);
    for (const auto& point : response.points) {
        moduli.push_back(point.mean_shear_modulus());
    }
    return moduli;
}

/// What the diagnosis predicts is what the solver gives for the contact model that it writes, springpots and moments included.
TEST(SolventDrag, ExtendedModelRunsToTheSamePrediction) {
    const std::vector<double> frequencies{0.3, 7, 200};
    Settings settings;
    settings.normal_stiffness = 55;
    settings.stiffness_ratio = 0.3;
    settings.felt_viscosity = 8;
    for (const bool springpot : {true, false}) {
        settings.springpot_ratio = springpot ? 0.4 : 0;
        settings.springpot_exponent = springpot ? 0.12 : 0;
        settings.bending_ratio = springpot ? 0 : 2e-3;
        Experiment experiment;
        experiment.measurements = {sweep(frequencies, std::vector<Complex>(3, 1.0), 0, 1)};
        const auto rows = observations_of(experiment);
        const Eigen::VectorXd predicted = Forward(experiment, rows, simulator()).predict(settings, true);
        const ContactModel model = contact_model_of(settings, 0.25e-6);
        const auto first = moduli_of(structure(200, 1), model, frequencies);
        const auto second = moduli_of(structure(200, 2), model, frequencies);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const Complex mean = 0.5 * (first[rows[k].row] + second[rows[k].row]);
            EXPECT_NEAR(predicted[static_cast<Eigen::Index>(k)], part_of(mean, rows[k]), 1e-8 * std::abs(mean));
        }
    }
}

/// What drags in a large sample is expected to exceed what drags in a few structures; the springs do not.
TEST(SolventDrag, IsExpectedAboveThatOfTheStructures) {
    Experiment experiment;
    experiment.measurements = {sweep({0.1, 10}, std::vector<Complex>(2, 1.0), 0, 1)};
    const std::vector<Observation> rows = observations_of(experiment);
    const Forward forward(experiment, rows, simulator());
    const Settings settings = with_drag(1e-6);
    const Eigen::VectorXd few = forward.predict(settings);
    const Eigen::VectorXd many = forward.predict(settings, Eigen::VectorXd::Zero(forward.errors_of(settings)));
    for (Eigen::Index row = 0; row < few.size(); ++row) {
        const Observation& one = rows[static_cast<std::size_t>(row)];
        const Complex drag = drag_response(simulator(), settings, one.angular_frequency) - 1.0;
        const Complex excess = drag_excess(simulator(), settings, one.angular_frequency)[0];
        EXPECT_GT(excess.real(), 0.03);  // half the variance of so many particles together
        const auto part = [&](Complex response) { return part_of(response, one); };
        EXPECT_NEAR(many[row] / few[row], part(1.0 + drag * std::exp(excess)) / part(1.0 + drag), 1e-9);
    }
}

/// A change of the size of the drag along the frequency turns its phase: between two structures as much as Bode's relation says.
TEST(SolventDrag, ErrorsTurnThePhaseAsStructuresDo) {
    SimulationCache cache;
    Simulator one({structure(200, 1)}, {"alone 1"}, cache);
    Simulator other({structure(200, 2)}, {"alone 2"}, cache);
    const auto ratio = [&](double reduced) {
        return std::log((drag_response(one, with_drag(reduced), 1) - 1.0) / (drag_response(other, with_drag(reduced), 1) - 1.0));
    };
    double product = 0;
    double square = 0;
    for (const double reduced : logarithmic_steps(1e-6, 1e-3, 13)) {
        const double turned = 0.25 * pi * (ratio(reduced * std::exp(1)).real() - ratio(reduced / std::exp(1)).real());
        product += turned * ratio(reduced).imag();
        square += turned * turned;
        const auto excess = [&](double place) { return drag_excess(one, with_drag(place), 1); };
        const Eigen::RowVectorXd slope = (excess(1.02 * reduced) - excess(reduced / 1.02)).real() / (2 * std::log(1.02));
        EXPECT_LT((excess(reduced).imag() - 0.5 * pi * slope).norm(), 0.05 * slope.norm()) << reduced;
    }
    EXPECT_NEAR(product / square, 1, 0.3);
}

/// A sample whose drag is several times that of the structures: errors of a factor meet it, as the prediction is made about them.
TEST(SolventDrag, IsPredictedAboutTheErrorsThatTheDataAskFor) {
    const std::vector<double> frequencies = logarithmic_steps(0.1, 100, 16);
    Experiment experiment;
    experiment.measurements = {sweep(frequencies, std::vector<Complex>(16, 1.0), 0, 1)};
    const std::vector<Observation> rows = observations_of(experiment);
    const Forward forward(experiment, rows, simulator());
    const Model model(with_drag(1e-6));
    const Eigen::VectorXd expected = forward.predict(model, Eigen::VectorXd::Zero(forward.errors_of(model)));
    Eigen::VectorXd errors = Eigen::VectorXd::Zero(forward.errors_of(model));
    errors.tail(1).setConstant(4);  // of the largest of the independent ones
    DataSet data{.observations = rows, .values = forward.predict(model, errors), .noise = {}, .sample = {}, .sample_names = {}};
    ASSERT_GT((data.values.array() / expected.array()).maxCoeff(), 3);
    data.noise.deviation = 0.02 * data.values.cwiseAbs();
    data.noise.previous.assign(rows.size(), -1);
    data.noise.correlation = Eigen::VectorXd::Zero(data.values.size());
    data.sample.assign(rows.size(), -1);
    const ErrorModel noise(data);
    const Inference inference(forward, noise);
    const Prediction found = inference.prediction(model);
    EXPECT_LT((found.errors.linearised_at - noise.effects(found)).norm(), 0.05);
    const auto farthest = [&](const Eigen::VectorXd& predicted) {
        return ((predicted - data.values).array() / data.noise.deviation.array()).abs().maxCoeff();
    };
    EXPECT_LT(farthest(forward.predict(model, found.errors.linearised_at)), 1);
    const Eigen::VectorXd along_lines = noise.effects(forward.prediction(model));
    EXPECT_GT(farthest(forward.predict(model, along_lines)), 10);
}

Diagnosis diagnosis_of(const Measurement& table) {
    Experiment experiment;
    experiment.sample.particle_radius = 0.25e-6;
    experiment.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = 1e-3};
    experiment.measurements = {table};
    return diagnosis_with(399, experiment);
}

TEST(SolventDrag, IsFoundInASweepOfFrequencies) {
    const std::vector<double> frequencies = logarithmic_steps(0.1, 100, 20);
    ContactModel model{.normal_stiffness = 40, .shear_stiffness = 4};
    model.solvent_viscosity = 20;
    const auto moduli = moduli_of(structure(260, 77), model, frequencies);
    const Diagnosis found = diagnosis_of(sweep(frequencies, moduli, 0.02, 4));
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::tied) << missing_to_a_name(found);
    EXPECT_EQ(names_of(found.credible_set), (std::vector<std::string>{"solvent-drag", "none of the catalogue"}))
        << "only an oil tells it from an error of the phase";
    EXPECT_GT(found.gain.rmse_ratio, 2);
    const auto cause = found.causes.front();
    ASSERT_EQ(cause.parameters.size(), 2U);
    EXPECT_NEAR(std::log(cause.parameters[1].value / 20), 0, std::log(2));  // structures differ in their softest motions
}

}  // namespace
}  // namespace coagula::diagnose
