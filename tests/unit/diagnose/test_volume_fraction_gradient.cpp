// SPDX-License-Identifier: GPL-3.0-or-later
// A sample that has settled between the plates: layers in series against sums over many of them, and gap series whose layers are
// other structures, sheared by another solver.
#include "chain/forward.hpp"
#include "credible_set.hpp"
#include "data/knows.hpp"
#include "hidden_effects.hpp"
#include "responses/volume_fraction_gradient.hpp"

#include <coagula/mechanics/frequency.hpp>
#include <coagula/mechanics/linear.hpp>

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <optional>

namespace coagula::diagnose {
namespace {

constexpr double coordination = 4.8;

/// Structures of two volume fractions, four of each.
struct KnownFractions {
    std::vector<Packing> packings;
    std::vector<std::string> names;
    std::vector<double> fractions;
    StoredSimulations stored{"two_volume_fractions"};
    std::optional<Simulator> simulator;

    KnownFractions() {
        for (std::uint64_t k = 0; k < 8; ++k) {
            packings.push_back(structure(300, k % 4 + 1, coordination, k < 4 ? 0.35 : 0.45));
            names.push_back(std::to_string(k));
            fractions.push_back(volume_fraction(packings.back()));
        }
        simulator.emplace(packings, names, stored.results());
    }
};

KnownFractions& known_fractions() {
    static KnownFractions made;
    return made;
}

TEST(LayersInSeries, AreTheHarmonicMeanOverManyLayers) {
    for (const double exponent : {-2.0, 0.0, 0.5, 1.0, 1.0 + 1e-9, 3.7, 12.0}) {
        for (const double difference : {1e-6, 0.05, 0.4, 1.5}) {
            constexpr int layers = 20000;
            double compliance = 0;
            for (int layer = 0; layer < layers; ++layer) {
                compliance += std::pow(1 + difference * ((layer + 0.5) / layers - 0.5), -exponent) / layers;
            }
            EXPECT_NEAR(layers_in_series(exponent, difference) * compliance, 1, 1e-6) << exponent << " " << difference;
        }
        EXPECT_EQ(layers_in_series(exponent, 0), 1);
    }
    // To second order in the difference.
    EXPECT_NEAR((1 - layers_in_series(4, 0.01)) / (4.0 * 5 / 24 * 1e-4), 1, 1e-3);
}

TEST(LayersInSeries, KeepWithinWhatParticlesCanDo) {
    EXPECT_DOUBLE_EQ(settled_difference(0.4, 0.1), 0.1);
    EXPECT_DOUBLE_EQ(settled_difference(0.4, 3), 2 * 0.24);   // close packing below
    EXPECT_DOUBLE_EQ(settled_difference(0.1, 3), 2 * 0.095);  // nearly clear fluid above
    EXPECT_DOUBLE_EQ(settled_difference(0.7, 0.1), 0);        // too dense to settle
    EXPECT_GT(layers_in_series(5, settled_difference(0.1, 3) / 0.1), 0);
}

/// Straight through the logarithms of moduli by the linear solver.
TEST(VolumeFractionExponent, IsTheSlopeBetweenTheStructures) {
    const std::vector<Packing> packings{structure(150, 1, coordination, 0.35), structure(150, 2, coordination, 0.45)};
    std::vector<double> logarithms;
    for (const Packing& packing : packings) {
        mechanics::LinearOptions options;
        options.shear_stiffness = 0.3 * options.normal_stiffness;
        logarithms.push_back(
            std::log(mechanics::solve_linear(packing, find_contacts(packing, 0.01), options).mean_shear_modulus()));
    }
    const double slope = (logarithms[1] - logarithms[0]) / std::log(volume_fraction(packings[1]) / volume_fraction(packings[0]));
    EXPECT_GT(slope, 1);
    Settings settings;
    settings.stiffness_ratio = 0.3;
    SimulationCache cache;
    Simulator both(packings, {"dilute", "dense"}, cache);
    EXPECT_NEAR(volume_fraction_exponent(both, settings, true), slope, 1e-6);
    EXPECT_NEAR(volume_fraction_exponent(both, settings), slope, 0.02);
    Simulator alone({packings[0]}, {"dilute"}, cache);
    EXPECT_EQ(volume_fraction_exponent(alone, settings), 0);
}

/// The sample that is hidden: moduli of structures at three volume fractions, mean of four each, by the frequency solver, and a
/// parabola through their logarithms.
struct Hidden {
    Eigen::Vector3d parabola;

    Hidden() {
        Eigen::Matrix3d powers;
        Eigen::Vector3d logarithms;
        for (Index k = 0; k < 3; ++k) {
            const double fraction = 0.34 + 0.06 * static_cast<double>(k);
            powers.row(k) << 1, fraction, fraction * fraction;
            double sum = 0;
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                sum += modulus_of(structure(400, 700 + 10 * static_cast<std::uint64_t>(k) + seed, coordination, fraction));
            }
            logarithms[k] = std::log(sum / 4);
        }
        parabola = powers.lu().solve(logarithms);
    }
    static double modulus_of(const Packing& packing) {
        const ContactModel model{.normal_stiffness = 40, .shear_stiffness = 4};
        const double frequency = 1;
        const auto response = mechanics::solve_frequency_sweep(packing, find_contacts(packing, 0.01), model, {&frequency, 1});
        return response.points[0].mean_shear_modulus().real();
    }
    double at(double fraction) const { return std::exp(parabola[0] + fraction * (parabola[1] + fraction * parabola[2])); }

    /// Shear stress times gap over the displacement of the upper plate: thin layers, each with the strain that the stress makes.
    double stacked(double gap, double gradient) const {
        constexpr int layers = 1000;
        double displacement = 0;
        for (int layer = 0; layer < layers; ++layer) {
            const double height = (layer + 0.5) / layers * gap;
            displacement += 1 / at(0.4 + gradient * (0.5 * gap - height)) * gap / layers;
        }
        return gap / displacement;
    }
};

const Hidden& hidden() {
    static const Hidden made;
    return made;
}

constexpr double nominal_gap = 1e-3;

Experiment gap_series(double difference, const std::vector<double>& gaps, double error, std::uint64_t seed) {
    Column modulus{"storage_modulus", "Pa", {}};
    for (std::size_t k = 0; k < gaps.size(); ++k) {
        const double shown = hidden().stacked(gaps[k], difference / nominal_gap);
        modulus.values.push_back(shown * (1 + error * drawn_normal(seed, k)));
        modulus.standard_errors.push_back(error * shown);
    }
    Measurement table;
    table.kind = MeasurementKind::gap_series;
    table.label = "hidden";
    table.sample = "sample";
    table.columns = {{"gap", "m", gaps}, modulus};
    Experiment made;
    made.sample.volume_fraction = 0.4;
    made.sample.particle_radius = 0.25e-6;
    made.instrument = {.geometry = Geometry::plate_plate, .plate_radius = 0.0125, .gap = nominal_gap};
    made.structure_volume_fractions = known_fractions().fractions;
    made.measurements = {table};
    return made;
}

std::vector<double> predicted(const Experiment& experiment, const Model& model) {
    const auto rows = observations_of(experiment);
    const Eigen::VectorXd values = Forward(experiment, rows, *known_fractions().simulator).predict(model);
    return {values.begin(), values.end()};
}

/// The prediction against layers of hidden structures: other seeds, another solver, no power law. Slip lowers the modulus at the
/// other end.
TEST(VolumeFractionGradient, LowersTheModulusWhereTheGapIsWide) {
    const std::vector<double> gaps{0.5e-3, 1e-3, 2e-3, 4e-3};
    const Experiment experiment = gap_series(0.05, gaps, 0, 1);
    const Model settled({find_mechanism("volume-fraction-gradient")}, std::array{0.05});
    const Model slipping({find_mechanism("wall-slip")}, std::array{1e-10});
    const std::vector<double> with = predicted(experiment, settled);
    const std::vector<double> slipped = predicted(experiment, slipping);
    const std::vector<double> without = predicted(experiment, {});
    for (std::size_t k = 0; k < gaps.size(); ++k) {
        const double lost = 1 - hidden().stacked(gaps[k], 0.05 / nominal_gap) / hidden().at(0.4);
        EXPECT_NEAR((1 - with[k] / without[k]) / lost, 1, 0.3) << gaps[k];
    }
    EXPECT_LT(with[3] / without[3], 0.85);
    EXPECT_GT(with[1] / without[1], 0.98);
    EXPECT_GT(slipped[3] / without[3], 1.2 * slipped[0] / without[0]);
}

TEST(VolumeFractionGradient, NeedsAGapAndStructuresOfTwoVolumeFractions) {
    const Mechanism& mechanism = *find_mechanism("volume-fraction-gradient");
    Experiment experiment;
    experiment.instrument.gap = nominal_gap;
    experiment.structure_volume_fractions = {0.35, 0.35, 0.45};
    Measurement table;
    table.kind = MeasurementKind::gap_series;
    table.columns = {{"gap", "m", {1e-3, 2e-3, 3e-3, 4e-3}}, {"storage_modulus", "Pa", {1, 1, 1, 1}}};
    experiment.measurements = {table};
    EXPECT_TRUE(mechanism.applies(knowledge_of(experiment)));
    Experiment other = experiment;
    other.structure_volume_fractions = {0.4, 0.402, 0.403};
    EXPECT_FALSE(mechanism.applies(knowledge_of(other)));
    other.structure_volume_fractions.clear();
    EXPECT_FALSE(mechanism.applies(knowledge_of(other)));
    other = experiment;
    other.instrument.geometry = Geometry::concentric_cylinders;  // layers side by side
    EXPECT_FALSE(mechanism.applies(knowledge_of(other)));
    other = experiment;
    other.instrument.gap = unset;
    EXPECT_TRUE(mechanism.applies(knowledge_of(other)));
    other.measurements.front().columns.front() = {"time", "s", {1, 2, 3, 4}};
    EXPECT_FALSE(mechanism.applies(knowledge_of(other)));
}

Diagnosis diagnosis_of(double difference, const std::vector<double>& gaps, double error, std::uint64_t seed) {
    DiagnosisOptions options;
    options.bootstrap = 399;
    return diagnose(gap_series(difference, gaps, error, seed), *known_fractions().simulator, options);
}

std::vector<double> widening() {
    std::vector<double> gaps;
    for (int k = 0; k < 14; ++k) {
        gaps.push_back((0.4 + 3.6 / 13 * k) * 1e-3);
    }
    return gaps;
}

TEST(VolumeFractionGradient, IsNamedWhereTheGapWidens) {
    int named = 0;  // the winner is tested at 5 % itself: one of three fails in 14 % of such tests, two in 0.7 %
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Diagnosis found = diagnosis_of(0.04, widening(), 0.02, seed);
        EXPECT_TRUE(found.detected);
        const bool passes = found.extended_p_value > 0.05;
        EXPECT_EQ(found.verdict, passes ? Verdict::named : Verdict::none_of_catalogue);
        named += passes ? 1 : 0;
        EXPECT_EQ(names_of(found.credible_set), std::vector<std::string>{"volume-fraction-gradient"});
        EXPECT_GT(found.gain.rmse_ratio, 2);
        const EstimatedParameter& difference = found.causes.front().parameters[1];
        EXPECT_GT(difference.high, 0.04 / 1.3);  // the exponent of few structures has an error, too
        EXPECT_LT(difference.low, 0.04 * 1.3);
        EXPECT_FALSE(diagnosis_of(0, widening(), 0.02, seed).detected);
    }
    EXPECT_GE(named, 2);
}

/// Designed tie: where the gap narrows with time, what ages grows stiffer in the same rows.
TEST(VolumeFractionGradient, IsTiedWithAgeingWhereTheGapNarrows) {
    std::vector<double> narrowing = widening();
    std::reverse(narrowing.begin(), narrowing.end());
    const Diagnosis found = diagnosis_of(0.03, narrowing, 0.03, 1);
    EXPECT_TRUE(found.detected);
    EXPECT_EQ(found.verdict, Verdict::tied);
    EXPECT_TRUE(in_set(found, "volume-fraction-gradient"));
    EXPECT_TRUE(in_set(found, "ageing"));
}

/// Samples at two gaps for five hours, whose layers settle within one, in stacks of hidden structures.
Experiment settling_samples(double difference, std::uint64_t seed) {
    constexpr double settling_time = 3000;
    Experiment made = gap_series(0, {nominal_gap}, 0.01, seed);
    made.measurements.clear();
    for (const double gap : {1e-3, 3e-3}) {
        Measurement table;
        table.kind = MeasurementKind::time_sweep;
        table.label = table.sample = to_text(gap);
        table.columns = {{"time", "s", {}}, {"gap", "m", std::vector<double>(20, gap)}, {"storage_modulus", "Pa", {}}};
        for (int k = 1; k <= 20; ++k) {
            const double now = difference * (1 - std::pow(2, -900.0 * k / (settling_time * std::log(2))));
            const double shown = hidden().stacked(gap, now / nominal_gap);
            table.columns[0].values.push_back(900.0 * k);
            table.columns[2].values.push_back(shown * (1 + 0.01 * drawn_normal(seed + made.measurements.size(), table.rows())));
            table.columns[2].standard_errors.push_back(0.01 * shown);
        }
        made.measurements.push_back(table);
    }
    return made;
}

TEST(Sedimentation, EndsAsTheGradientThatItLeadsTo) {
    const Experiment experiment = settling_samples(0, 1);
    const std::vector<double> settled =
        predicted(experiment, Model({find_mechanism("volume-fraction-gradient")}, std::array{0.03}));
    const std::vector<double> half = predicted(experiment, Model({find_mechanism("volume-fraction-gradient")}, std::array{0.015}));
    const std::vector<double> fast = predicted(experiment, Model({find_mechanism("sedimentation")}, std::array{0.03, 300.0}));
    const double half_life = 900 / std::log(2);
    const std::vector<double> slow = predicted(experiment, Model({find_mechanism("sedimentation")}, std::array{0.03, half_life}));
    EXPECT_NEAR(fast[19] / settled[19], 1, 1e-9);
    EXPECT_NEAR(slow[0] / half[0], 1, 1e-9);
    EXPECT_NEAR(slow[20] / half[20], 1, 1e-9);
}

/// Two samples at two gaps: neither foretells the other better than the base model with certainty.
TEST(Sedimentation, IsFoundWhereTheWiderGapFallsMore) {
    DiagnosisOptions options;
    options.bootstrap = 199;
    const Diagnosis found = diagnose(settling_samples(0.03, 4), *known_fractions().simulator, options);
    ASSERT_TRUE(found.detected);
    EXPECT_EQ(names_of(found.credible_set), (std::vector<std::string>{"sedimentation", "none of the catalogue"}))
        << missing_to_a_name(found);
    EXPECT_FALSE(diagnose(settling_samples(0, 4), *known_fractions().simulator, options).detected);
}

}  // namespace
}  // namespace coagula::diagnose
