// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquid.hpp"

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace coagula::experiment {

namespace {

/// Slope of the least-squares line.
double slope_of(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y) {
    const Eigen::ArrayXd from_middle = x - x.mean();
    return (from_middle * y).sum() / from_middle.square().sum();
}

}  // namespace

bool looks_newtonian(const diagnose::Measurement& table) {
    constexpr std::size_t fewest_rows = 5;
    constexpr double far_above = 10;
    constexpr double most_stored = 0.2;   // of the rows
    constexpr double least_range = 1.15;  // logarithm of frequencies: half a decade
    const diagnose::Column* storage = diagnose::find_column(table, "storage_modulus");
    const diagnose::Column* loss = diagnose::find_column(table, "loss_modulus");
    const diagnose::Column* frequency = diagnose::find_column(table, "angular_frequency");
    if (table.kind != diagnose::MeasurementKind::frequency_sweep || storage == nullptr || loss == nullptr || frequency == nullptr) {
        return false;
    }
    std::vector<double> x;
    std::vector<double> y;
    double stored = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (loss->values[row] > 0 && frequency->values[row] > 0) {
            x.push_back(std::log(frequency->values[row]));
            y.push_back(std::log(loss->values[row]));
            stored += far_above * std::abs(storage->values[row]) > loss->values[row] ? 1 : 0;
        }
    }
    if (x.size() < fewest_rows || stored > most_stored * static_cast<double>(x.size())) {
        return false;
    }
    const auto size = static_cast<Eigen::Index>(x.size());
    const Eigen::Map<const Eigen::ArrayXd> along(x.data(), size);
    return along.maxCoeff() - along.minCoeff() > least_range &&
           std::abs(slope_of(along, Eigen::Map<const Eigen::ArrayXd>(y.data(), size)) - 1) < 0.1;
}

}  // namespace coagula::experiment
