// SPDX-License-Identifier: GPL-3.0-or-later
// These tests hold a material of which no structures are known against exact relaxations by formulas.
#include "chain/forward.hpp"
#include "chain/smooth_material.hpp"
#include "hidden_effects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

namespace coagula::diagnose {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// G' and G'' of a sweep from 1 to 100 rad/s, five frequencies a decade, without errors.
std::vector<Observation> exact_sweep(const std::function<Complex(double)>& modulus) {
    std::vector<Observation> observations;
    for (const bool loss : {false, true}) {
        for (std::size_t row = 0; row < 11; ++row) {
            Observation one;
            one.what = Modulus{.loss = loss};
            one.row = row;
            one.angular_frequency = std::pow(10, 0.2 * static_cast<double>(row));
            one.value = part_of(modulus(one.angular_frequency), one);
            observations.push_back(one);
        }
    }
    return observations;
}

/// The material that is nearest to a sweep, as the instrument shows it where it shows the material as it is.
class Nearest {
public:
    explicit Nearest(const std::function<Complex(double)>& modulus)
        : observations_(exact_sweep(modulus)), material_(observations_, false), moduli_(material_.moduli()), modulus_(modulus) {}

    Complex at(Index row) const { return moduli_.with(material_.start())[row]; }

    /// Largest difference over |G*|.
    double error() const {
        double largest = 0;
        for (Index row = 0; row < 11; ++row) {
            const Complex exact = modulus_(observations_[static_cast<std::size_t>(row)].angular_frequency);
            largest = std::max(largest, std::abs(at(row) - exact) / std::abs(exact));
        }
        return largest;
    }

    const SmoothMaterial& material() const { return material_; }
    const std::vector<Observation>& observations() const { return observations_; }

private:
    std::vector<Observation> observations_;
    SmoothMaterial material_;
    UncertainModuli moduli_;
    std::function<Complex(double)> modulus_;
};

Complex maxwell_element(double frequency, double place) {
    const Complex product(0, frequency / place);
    return product / (1.0 + product);
}

/// To less than half of the smallest error that rows have; elements that relax beyond either end of the sweep are among them.
TEST(SmoothMaterial, ShowsAnyRelaxation) {
    for (const double place : {0.1, 0.3, 1.0, 3.0, 17.0, 100.0, 250.0, 1000.0}) {
        EXPECT_LT(Nearest([&](double w) { return 300.0 * maxwell_element(w, place) + 2.0; }).error(), 4e-3)
            << place << " rad/s and a spring";
        EXPECT_LT(Nearest([&](double w) { return 300.0 * maxwell_element(w, place) + Complex(0, 0.1 * w); }).error(), 4e-3)
            << place << " rad/s and a dashpot";
    }
    for (const double power : {0.05, 0.3, 0.5, 0.8}) {
        EXPECT_LT(Nearest([&](double w) { return 30.0 * std::pow(Complex(0, w), power); }).error(), 4e-3) << power;
    }
}

/// Coefficients at their end would be negative: a little more of any of these meets the data less, and nothing else moves them.
TEST(SmoothMaterial, LeavesOutWhatWouldBeNegative) {
    const Nearest nearest([](double w) { return 300.0 * maxwell_element(w, 17); });
    const SmoothMaterial& material = nearest.material();
    const std::vector<Index> ended = material.at_end(material.start());
    ASSERT_FALSE(ended.empty());
    const auto size = static_cast<Index>(nearest.observations().size());
    Eigen::VectorXd data(size);
    Eigen::ArrayXd errors(size);
    for (Index row = 0; row < size; ++row) {
        const Observation& one = nearest.observations()[static_cast<std::size_t>(row)];
        data[row] = one.value;
        errors[row] = 0.01 * 300 * std::abs(maxwell_element(one.angular_frequency, 17));
    }
    const auto objective = [&](const Eigen::VectorXd& coefficients) {
        const Eigen::VectorXcd moduli = material.moduli().with(coefficients);
        Eigen::ArrayXd left(size);
        for (Index row = 0; row < size; ++row) {
            left[row] = data[row] - part_of(moduli[row], nearest.observations()[static_cast<std::size_t>(row)]);
        }
        return (left / errors).square().sum() + coefficients.squaredNorm();
    };
    const double least = objective(material.start());
    for (Index k = 0; k < material.start().size(); ++k) {
        EXPECT_GE(material.start()[k], std::find(ended.begin(), ended.end(), k) == ended.end() ? -10 : 0);
        Eigen::VectorXd more = material.start();
        more[k] += 1e-3;
        EXPECT_GT(objective(more), least) << k;
        more[k] -= 2e-3;
        EXPECT_TRUE(std::find(ended.begin(), ended.end(), k) != ended.end() || objective(more) > least) << k;
    }
}

/// No error of the prediction moves a coefficient that stands at its end.
TEST(SmoothMaterial, HoldsItsEndsInThePrediction) {
    Experiment experiment;
    experiment.material.kind = MaterialKind::smooth;
    experiment.measurements.emplace_back().kind = MeasurementKind::frequency_sweep;
    const std::vector<Observation> observations = exact_sweep([](double w) { return 300.0 * maxwell_element(w, 17); });
    const Forward forward(experiment, observations, simulator());
    const Prediction prediction = forward.prediction(Model{});
    Index still = 0;
    for (Index error = 0; error < prediction.errors.changes.cols(); ++error) {
        const bool moves = !prediction.errors.changes.col(error).isZero(0);
        still += moves ? 0 : 1;
        EXPECT_TRUE(moves || prediction.errors.linearised_at[error] == 0) << error;
    }
    EXPECT_GT(still, 0);
}

}  // namespace
}  // namespace coagula::diagnose
