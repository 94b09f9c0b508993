// SPDX-License-Identifier: GPL-3.0-or-later
#include "smooth.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace coagula::diagnose {

namespace {

bool takes_part(const Observation& one, Departing departing) {
    return departing == Departing::both || is_loss(one) == (departing == Departing::loss);
}

/// The covariance of a departure of unit size, column by column.
class SmoothCovariance {
public:
    /// @param together the product of the correlations along all coordinates, else their mean.
    SmoothCovariance(const std::vector<Observation>& observations, Departing departing, std::vector<Eigen::VectorXd> ranks,
                     bool together, double length)
        : ranks_(std::move(ranks)), together_(together), length_(length) {
        for (const Observation& one : observations) {
            const bool departs = takes_part(one, departing) && !is<ImageDifference>(one);
            kinds_.push_back(!departs ? 0 : 1 + (is_loss(one) ? 1 : 0) + (is<Harmonic>(one) ? 2 : 0));
        }
    }

    Eigen::VectorXd column(Index number) const {
        const auto count = static_cast<Index>(kinds_.size());
        Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(count);
        Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(count);
        for (const Eigen::VectorXd& rank : ranks_) {
            const Eigen::ArrayXd square = ((rank.array() - rank[number]) / length_).square();
            together_ ? squares += square : sum += (-0.5 * square).exp() / static_cast<double>(ranks_.size());
        }
        if (together_ || ranks_.empty()) {
            sum = (-0.5 * squares).exp();
        }
        Eigen::VectorXd all = sum.matrix();
        for (Index row = 0; row < count; ++row) {
            all[row] *= depart_alike(number, row) ? 1.0 : 0.0;
        }
        return all;
    }

    /// Cholesky's factor, the largest pivot first, until what is left is small.
    Eigen::MatrixXd factor() const {
        constexpr double least = 1e-4;
        const auto size = static_cast<Index>(kinds_.size());
        Eigen::VectorXd rest(size);
        for (Index row = 0; row < size; ++row) {
            rest[row] = depart_alike(row, row) ? 1.0 : 0.0;
        }
        const double smallest = least * rest.sum();
        Eigen::MatrixXd factor(size, size);
        Index columns = 0;
        Index pivot = 0;
        while (columns < size && rest.sum() > smallest && rest.maxCoeff(&pivot) > 0) {
            const Eigen::VectorXd next = column(pivot) - factor.leftCols(columns) * factor.row(pivot).head(columns).transpose();
            factor.col(columns) = next / std::sqrt(rest[pivot]);
            rest = (rest - factor.col(columns).cwiseAbs2()).cwiseMax(0);
            ++columns;
        }
        return factor.leftCols(columns);
    }

private:
    /// Whether two numbers are of one kind, where that departs.
    bool depart_alike(Index number, Index row) const {
        const int kind = kinds_[static_cast<std::size_t>(number)];
        return kind != 0 && kind == kinds_[static_cast<std::size_t>(row)];
    }

    std::vector<int> kinds_;  ///< elastic or viscous part, of the first harmonic or the third; 0 where nothing departs
    std::vector<Eigen::VectorXd> ranks_;
    bool together_;
    double length_;
};

struct Varying {
    Coordinate coordinate;
    Eigen::VectorXd rank;
};

std::vector<Varying> varying_coordinates(const std::vector<Observation>& observations) {
    std::vector<Varying> varying;
    for (const Coordinate coordinate : all_coordinates) {
        Eigen::VectorXd rank = rank_along(observations, coordinate);
        if (rank.maxCoeff() > 0) {
            varying.push_back({coordinate, std::move(rank)});
        }
    }
    return varying;
}

}  // namespace

Eigen::VectorXd rank_along(const std::vector<Observation>& observations, Coordinate coordinate) {
    std::vector<double> values;
    for (const Observation& observation : observations) {
        values.push_back(coordinate_of(observation, coordinate));
    }
    return ranks_of(values);
}

Eigen::VectorXd ranks_of(const std::vector<double>& values) {
    std::vector<double> sorted;
    std::copy_if(values.begin(), values.end(), std::back_inserter(sorted), [](double value) { return std::isfinite(value); });
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end(), [](double a, double b) { return b <= a * 1.001; }), sorted.end());
    Eigen::VectorXd rank = Eigen::VectorXd::Zero(static_cast<Index>(values.size()));
    for (std::size_t k = 0; k < values.size() && sorted.size() > 1; ++k) {
        const auto place = std::lower_bound(sorted.begin(), sorted.end(), values[k] * 0.9995) - sorted.begin();
        rank[static_cast<Index>(k)] =
            std::isfinite(values[k]) ? static_cast<double>(place) / static_cast<double>(sorted.size() - 1) : 0.0;
    }
    return rank;
}

bool run_together(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
    constexpr double nearly = 0.98;
    const Eigen::ArrayXd along = one.array() - one.mean();
    const Eigen::ArrayXd beside = other.array() - other.mean();
    const double squares = along.square().sum() * beside.square().sum();
    return squares > 0 && std::abs((along * beside).sum()) > nearly * std::sqrt(squares);
}

Eigen::MatrixXd smooth_factor(const std::vector<Observation>& observations, Departing departing, std::vector<Eigen::VectorXd> ranks,
                              bool together, double length) {
    return SmoothCovariance(observations, departing, std::move(ranks), together, length).factor();
}

SmoothDepartures smooth_departures(const std::vector<Observation>& observations) {
    const std::vector<Varying> varying = varying_coordinates(observations);
    const auto along = [&](Departing departing, const std::vector<Varying>& some, bool together, double length) {
        SmoothDeparture one{departing, {}, {}};
        std::vector<Eigen::VectorXd> own;
        for (const auto& [coordinate, rank] : some) {
            one.along.push_back(coordinate);
            own.push_back(rank);
        }
        one.factor = smooth_factor(observations, departing, std::move(own), together, length);
        return one;
    };
    if (varying.empty()) {
        return {{along(Departing::both, {}, false, 1)}};
    }
    SmoothDepartures groups;
    for (const double length : smooth_lengths) {
        for (const Departing departing : {Departing::storage, Departing::loss, Departing::both}) {
            if (std::none_of(observations.begin(), observations.end(),
                             [&](const Observation& one) { return takes_part(one, departing); })) {
                continue;
            }
            std::vector<SmoothDeparture> single;
            std::vector<SmoothDeparture> pairs;
            for (std::size_t k = 0; k < varying.size(); ++k) {
                single.push_back(along(departing, {varying[k]}, false, length));
                for (std::size_t other = 0; other < k; ++other) {
                    pairs.push_back(along(departing, {varying[k], varying[other]}, false, length));
                }
            }
            groups.push_back(std::move(single));
            if (!pairs.empty()) {
                groups.push_back(std::move(pairs));
                groups.push_back({along(departing, varying, true, length)});
            }
        }
    }
    return groups;
}

}  // namespace coagula::diagnose
