// SPDX-License-Identifier: GPL-3.0-or-later
// A hypothesis, the base model with some mechanisms, and its evidence.
#pragma once

#include "chain/forward.hpp"
#include "noise/error_model.hpp"
#include "problem.hpp"

#include <coagula/diagnose/model.hpp>

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace coagula::diagnose {

/// A hypothesis fitted to data.
struct Fit {
    Hypothesis hypothesis;
    Model model;                        ///< most probable
    std::vector<Estimate> parameters;   ///< of the mechanisms: most probable value, 5 and 95 % quantile
    std::vector<bool> active_end = {};  ///< of each parameter: its most probable value lies at an end of the prior, beyond which
                                        ///< the data would have it
    Estimate stiffness{};               ///< of a particle [N/m]
    double log_density = 0;             ///< of the data at `model`, without the priors
    double log_evidence = 0;            ///< of the data, all parameters integrated over their priors
    Eigen::MatrixXd draws;              ///< normal stiffness and parameters x equally probable draws from the posterior

    /// Values of all parameters, in their order.
    std::vector<double> values() const;
    /// Some models of the posterior, evenly spread over its draws.
    std::vector<Model> drawn(Index count) const;
};

/// Range of the logarithm of an unknown stiffness: eight decades.
inline constexpr double log_stiffness_range = 18.42;

/// Steps after which errors of a prediction are found, or do not happen.
inline constexpr int many_steps = 20;

/// What to show of a prediction with these errors: of one that stands at some, its straight lines there; of any other itself.
inline Eigen::VectorXd shown(const Prediction& prediction, const Eigen::VectorXd& errors) {
    return prediction.errors.linearised_at.isZero(0) ? prediction.values : prediction.with(errors);
}

/// A hypothesis at a place of its prior.
Model model_at(const Hypothesis& hypothesis, const Eigen::VectorXd& place, double normal_stiffness);

/// Says how probable the data are by a model with given parameters, as a problem for an engine, and makes a fit of what that finds.
/// The prior of the stiffness, which scales the moduli, is normal in its logarithm where the experiment knows it, else uniform
/// over eight decades about that which the level of the data asks for.
class Inference {
public:
    Inference(const Forward& forward, const ErrorModel& errors)
        : forward_(forward), errors_(errors), scales_(shows_scale()), log_level_(log_level()), sizes_(measured_sizes()) {}

    /// @param engine that gives an evidence.
    Fit fit(const Hypothesis& hypothesis, const Engine& engine = grid()) const;

    /// Returns what `work` makes of a copy of this that no other thread uses and that remembers nothing for later.
    template <class Work>
    auto apart(const Work& work) const {
        const Forward forward(forward_);
        return work(Inference(*this, forward));
    }

    /// Returns the problem that `fit` gives to its engine. It refers to this object, which must outlive it.
    Problem problem(const Hypothesis& hypothesis) const;

    /// Derivatives of the whitened prediction by the logarithm of the stiffness, the parameters' places, the sample effects and
    /// the errors of the prediction at a fit. @param further as there.
    Eigen::MatrixXd jacobian(const Fit& fit, const Eigen::MatrixXd& further = {}) const;

    /// Whether something measured depends on the stiffness of the particles, or on what else scales the material.
    bool shows_scale() const;

    /// Standard deviation of the logarithm of the known stiffness, with what so few structures leave in the level of the moduli
    /// that it makes; NaN where no stiffness is known.
    double stiffness_error() const;
    /// How far a stiffness is from the known one over that error; NaN where it is not known.
    double stiffness_departure(double log_stiffness) const;

    /// Largest log density of the data by the base model, whatever the stiffness.
    double density_of_free_level() const;

    /// The prediction about those of its own errors that the data make most probable, where it is not linear in these.
    /// @param further whitened directions, of unit deviation each, in which the data may depart besides.
    Prediction prediction(const Model& model, const Eigen::MatrixXd& further = {}, int most_steps = many_steps) const;

    /// What to show of a prediction: with those errors that the data ask for where it stands at such, else without.
    Eigen::VectorXd fitted(const Prediction& prediction) const {
        return shown(prediction, errors_.effects(prediction).tail(prediction.errors.linearised_at.size()));
    }

    /// The prediction as the fit has it and residuals are measured from: with the most probable effects of the samples and errors
    /// of the prediction.
    Eigen::VectorXd as_fitted(const Prediction& prediction) const;

    const Forward& forward() const { return forward_; }
    const ErrorModel& errors() const { return errors_; }

private:
    /// Moduli show a stiffness that nothing else tells, with what so few structures leave in their level; in a structure series
    /// each row has that error itself.
    bool level_is_open() const;
    Inference(const Inference& other, const Forward& forward)
        : forward_(forward),
          errors_(other.errors_),
          scales_(other.scales_),
          last_errors_(other.last_errors_),
          log_level_(other.log_level_),
          sizes_(other.sizes_) {}
    Fit fit_here(const Hypothesis& hypothesis, const Engine& engine) const;
    ProjectedResidual projected_residual(const Hypothesis& hypothesis, const Eigen::VectorXd& place, double log_stiffness) const;
    Node highest_of_base(const Node& found) const;
    bool is_active_end(const Hypothesis& hypothesis, Eigen::VectorXd place, Index axis, double stiffness) const;
    double log_level(Model model = {}) const;
    double better_start(const Model& model, double before) const;
    std::pair<double, double> highest_maximum(const std::function<double(double)>& density) const;
    double log_prior(double log_stiffness) const;
    /// |G*| of a row that shows the stiffness, or its one modulus or viscosity.
    struct MeasuredSize {
        std::vector<Index> observations;
        double logarithm;
    };
    std::vector<MeasuredSize> measured_sizes() const;
    double log_prior_of_level(const Eigen::VectorXd& predicted) const;
    double density_at(Model model, double log_stiffness, Accuracy accuracy = Accuracy::whole) const;
    struct AlongStiffness;
    AlongStiffness density_along(Model model, double log_stiffness, Accuracy accuracy) const;
    Node best_stiffness(const Model& model, double start, double least = -std::numeric_limits<double>::infinity()) const;

    const Forward& forward_;
    const ErrorModel& errors_;
    bool scales_;
    mutable Eigen::VectorXd last_errors_;  ///< about which the last nonlinear prediction was made: those of the next are near
    double log_level_;                     ///< logarithm of the stiffness [N/m] that the base model needs for half of the moduli
    std::vector<MeasuredSize> sizes_;      ///< none where the stiffness is known
};

}  // namespace coagula::diagnose
