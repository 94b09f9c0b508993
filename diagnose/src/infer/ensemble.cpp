// SPDX-License-Identifier: GPL-3.0-or-later
#include "problem.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/random.hpp>
#include <coagula/common/special_functions.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace coagula::diagnose {

namespace {

constexpr double longest_stretch = 2;
constexpr std::uint64_t first_step = 9000000;  // beyond those of other draws of a diagnosis

class Walkers {
public:
    Walkers(const Problem& problem, const EnsembleOptions& options)
        : problem_(problem),
          seed_(options.seed),
          places_(static_cast<Eigen::Index>(problem.priors.size()), options.walkers),
          densities_(options.walkers) {
        for (Eigen::Index walker = 0; walker < places_.cols(); ++walker) {
            for (Eigen::Index axis = 0; axis < places_.rows(); ++axis) {
                places_(axis, walker) = uniform(axis)[0];
            }
            densities_[walker] = problem_.log_density(places_.col(walker));
            ++step_;
        }
        keep_highest();
    }

    /// Moves every walker once: those of each half along lines through walkers of the other half.
    void sweep() {
        const Eigen::Index half = places_.cols() / 2;
        for (Eigen::Index walker = 0; walker < 2 * half; ++walker) {
            const Eigen::Vector3d drawn = uniform(0);
            const auto other = static_cast<Eigen::Index>(drawn[0] * static_cast<double>(half)) + (walker < half ? half : 0);
            const double stretch = std::pow(1 + (longest_stretch - 1) * drawn[1], 2) / longest_stretch;
            move(walker, places_.col(other) + stretch * (places_.col(walker) - places_.col(other)),
                 static_cast<double>(places_.rows() - 1) * std::log(stretch) - std::log(1 - drawn[2]));
            ++step_;
        }
        keep_highest();
    }

    /// Walkers in a mode that has no share of the probability cannot leave it: they go on from where others are.
    void gather() {
        constexpr double hopeless = 10;  // logarithms below the highest
        const double least = densities_.maxCoeff() - hopeless;
        for (Eigen::Index walker = 0; walker < places_.cols(); ++walker) {
            for (; densities_[walker] < least; ++step_) {
                const auto other = static_cast<Eigen::Index>(uniform(0)[0] * static_cast<double>(places_.cols()));
                places_.col(walker) = places_.col(other);
                densities_[walker] = densities_[other];
            }
        }
    }

    const Eigen::MatrixXd& places() const { return places_; }
    /// The most probable place that a walker has seen.
    const Eigen::VectorXd& highest() const { return highest_; }

private:
    Eigen::Vector3d uniform(Eigen::Index number) const {
        return random_uniform(seed_, RandomPurpose::diagnosis, first_step + step_, static_cast<std::uint64_t>(number));
    }

    /// @param allowed loss of the log density at which the move still happens.
    void move(Eigen::Index walker, const Eigen::VectorXd& place, double allowed) {
        const bool inside = (place.array() > 0 && place.array() < 1).all();
        const double density = inside ? problem_.log_density(place) : -std::numeric_limits<double>::infinity();
        if (density + allowed > densities_[walker]) {
            places_.col(walker) = place;
            densities_[walker] = density;
        }
    }

    void keep_highest() {
        Eigen::Index walker = 0;
        const double largest = densities_.maxCoeff(&walker);
        if (largest > highest_density_) {
            highest_density_ = largest;
            highest_ = places_.col(walker);
        }
    }

    const Problem& problem_;
    std::uint64_t seed_;
    std::uint64_t step_ = 0;
    Eigen::MatrixXd places_;
    Eigen::VectorXd densities_;
    double highest_density_ = -std::numeric_limits<double>::infinity();
    Eigen::VectorXd highest_;
};

/// The number below which a part of these lies.
double quantile_of(Eigen::VectorXd numbers, double part) {
    const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(numbers.size() - 1));
    std::nth_element(numbers.begin(), numbers.begin() + place, numbers.end());
    return numbers[place];
}

/// A posterior by the places of all draws, one per column.
Posterior posterior_by(const Problem& problem, const Eigen::MatrixXd& places, const Eigen::VectorXd& highest) {
    Posterior posterior{
        .place = highest.tail(problem.axes()),
        .node = {},
        .log_evidence = std::numeric_limits<double>::quiet_NaN(),
        .draws = PosteriorDraws(places.rows(), places.cols()),
        .quantile = [places](Eigen::Index axis, double part) { return quantile_of(places.row(axis + 1).transpose(), part); },
        .log_stiffness_quantile = {}};
    for (Eigen::Index draw = 0; draw < places.cols(); ++draw) {
        posterior.draws.col(draw) = problem.values_at(places.col(draw));
    }
    posterior.node =
        problem.node(posterior.place, std::log(problem.values_at(highest)[0]), -std::numeric_limits<double>::infinity());
    posterior.log_stiffness_quantile = [stiffness = Eigen::VectorXd(posterior.draws.row(0).array().log())](double part,
                                                                                                           double further) {
        const double middle = quantile_of(stiffness, 0.5);
        const double away = quantile_of(stiffness, part) - middle;  // further errors add in squares to it
        return middle + std::copysign(std::hypot(away, further * normal_quantile(part)), part - 0.5);
    };
    return posterior;
}

}  // namespace

Engine ensemble(const EnsembleOptions& options) {
    return [options](const Problem& problem) {
        const auto axes = static_cast<int>(problem.priors.size());
        require(options.walkers % 2 == 0 && options.walkers >= 2 * axes,
                "an ensemble needs an even number of walkers, two per axis");
        Walkers walkers(problem, options);
        for (int sweep = 0; sweep < options.settling; ++sweep) {
            walkers.sweep();
            if (sweep == options.settling / 2) {
                walkers.gather();
            }
        }
        Eigen::MatrixXd places(axes, options.walkers * options.sweeps);
        for (int sweep = 0; sweep < options.sweeps; ++sweep) {
            walkers.sweep();
            places.middleCols(static_cast<Eigen::Index>(sweep) * options.walkers, options.walkers) = walkers.places();
        }
        return posterior_by(problem, places, walkers.highest());
    };
}

}  // namespace coagula::diagnose
