#include "smooth.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace coagula::diagnose {

namespace {

/// Ranks 0 .. 1 of a coordinate; 0 where it is unknown or does not vary.
Eigen::VectorXd ranks(const std::vector<Observation>& observations, Coordinate coordinate) {
    std::vector<double> values;
    for (const Observation& observation : observations) {
        values.push_back(coordinate_of(observation, coordinate));
    }
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

/// Correlation by the distance in these ranks.
Eigen::MatrixXd correlation(const std::vector<Eigen::VectorXd>& ranks, double length) {
    const Index count = ranks.front().size();
    Eigen::ArrayXXd squared = Eigen::ArrayXXd::Zero(count, count);
    for (const Eigen::VectorXd& rank : ranks) {
        squared += (rank.replicate(1, count) - rank.transpose().replicate(count, 1)).array().square();
    }
    return (-0.5 / (length * length) * squared).exp();
}

bool takes_part(const Observation& one, Departing departing) {
    return departing == Departing::both || one.loss == (departing == Departing::loss);
}

/// Products of the levels of two numbers of one observable, where that departs.
Eigen::MatrixXd products(const std::vector<Observation>& observations, const Eigen::VectorXd& prediction, Departing departing) {
    const Eigen::VectorXd level = complex_moduli(observations, prediction);
    Eigen::MatrixXd product = level * level.transpose();
    for (Index i = 0; i < product.rows(); ++i) {
        for (Index j = 0; j < product.cols(); ++j) {
            const Observation& one = observations[static_cast<std::size_t>(i)];
            const Observation& other = observations[static_cast<std::size_t>(j)];
            const bool alike =
                one.loss == other.loss && one.third_harmonic == other.third_harmonic && !one.difference && !other.difference;
            product(i, j) *= alike && takes_part(one, departing) ? 1.0 : 0.0;
        }
    }
    return product;
}

}  // namespace

std::vector<std::vector<SmoothDeparture>> smooth_departures(const std::vector<Observation>& observations) {
    std::vector<SmoothDeparture> varying;  // of any modulus
    for (const Coordinate coordinate : all_coordinates()) {
        const Eigen::VectorXd rank = ranks(observations, coordinate);
        if (rank.maxCoeff() > 0) {
            varying.push_back({Departing::both, {coordinate}, {rank}});
        }
    }
    std::vector<std::vector<SmoothDeparture>> groups;
    if (varying.empty()) {
        groups.push_back({{Departing::both, {}, {}}});
    }
    for (const Departing departing : {Departing::storage, Departing::loss, Departing::both}) {
        const bool any = std::any_of(observations.begin(), observations.end(),
                                     [&](const Observation& one) { return takes_part(one, departing); });
        if (!any || varying.empty()) {
            continue;
        }
        std::vector<SmoothDeparture> one;
        std::vector<SmoothDeparture> two;
        SmoothDeparture all{departing, {}, {}, true};
        for (std::size_t k = 0; k < varying.size(); ++k) {
            const Coordinate coordinate = varying[k].along.front();
            const Eigen::VectorXd& rank = varying[k].ranks.front();
            one.push_back({departing, {coordinate}, {rank}});
            all.along.push_back(coordinate);
            all.ranks.push_back(rank);
            for (std::size_t other = 0; other < k; ++other) {
                two.push_back({departing, {coordinate, varying[other].along.front()}, {rank, varying[other].ranks.front()}});
            }
        }
        groups.push_back(one);
        if (!two.empty()) {
            groups.push_back(two);
            groups.push_back({all});
        }
    }
    return groups;
}

Eigen::MatrixXd covariance(const SmoothDeparture& departure, const std::vector<Observation>& observations,
                           const Eigen::VectorXd& prediction, double length) {
    const Eigen::MatrixXd product = products(observations, prediction, departure.departing);
    if (departure.ranks.empty()) {
        return product;
    }
    if (departure.together) {
        return product.cwiseProduct(correlation(departure.ranks, length));
    }
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(product.rows(), product.cols());
    for (const Eigen::VectorXd& rank : departure.ranks) {
        sum += correlation({rank}, length);
    }
    return product.cwiseProduct(sum) / static_cast<double>(departure.ranks.size());
}

/// Cholesky's factor, the largest pivot first, until what is left is small.
Eigen::MatrixXd factor_of(Eigen::MatrixXd rest) {
    constexpr double least = 1e-4;
    const Index size = rest.rows();
    const double smallest = least * rest.diagonal().sum();
    Eigen::MatrixXd factor(size, size);
    Index columns = 0;
    Index pivot = 0;
    while (columns < size && rest.diagonal().sum() > smallest && rest.diagonal().maxCoeff(&pivot) > 0) {
        factor.col(columns) = rest.col(pivot) / std::sqrt(rest(pivot, pivot));
        rest -= factor.col(columns) * factor.col(columns).transpose();
        ++columns;
    }
    return factor.leftCols(columns);
}

}  // namespace coagula::diagnose
