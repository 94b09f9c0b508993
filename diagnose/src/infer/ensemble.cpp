// SPDX-License-Identifier: GPL-3.0-or-later
#include "problem.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/random.hpp>

#include <cmath>
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
    }

    const Eigen::MatrixXd& places() const { return places_; }

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

    const Problem& problem_;
    std::uint64_t seed_;
    std::uint64_t step_ = 0;
    Eigen::MatrixXd places_;
    Eigen::VectorXd densities_;
};

}  // namespace

Engine ensemble(const EnsembleOptions& options) {
    return [options](const Problem& problem) {
        const auto axes = static_cast<int>(problem.priors.size());
        require(options.walkers % 2 == 0 && options.walkers >= 2 * axes,
                "an ensemble needs an even number of walkers, two per axis");
        Walkers walkers(problem, options);
        for (int sweep = 0; sweep < options.settling; ++sweep) {
            walkers.sweep();
        }
        PosteriorDraws draws(axes, options.walkers * options.sweeps);
        for (int sweep = 0; sweep < options.sweeps; ++sweep) {
            walkers.sweep();
            for (int walker = 0; walker < options.walkers; ++walker) {
                draws.col(sweep * options.walkers + walker) = problem.values_at(walkers.places().col(walker));
            }
        }
        return draws;
    };
}

}  // namespace coagula::diagnose
