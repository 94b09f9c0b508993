// SPDX-License-Identifier: GPL-3.0-or-later
#include "steps_towards.hpp"

#include <utility>

namespace coagula::diagnose {

namespace {

/// Steps from a fit towards a mechanism, as unit vectors orthogonal to what the fitted quantities move.
class StepsTowards {
public:
    StepsTowards(const Inference& inference, const Fit& fit, const Prediction& about, const Mechanism& mechanism,
                 const Eigen::MatrixXd& basis)
        : inference_(inference),
          fit_(fit),
          mechanism_(mechanism),
          basis_(basis),
          hypothesis_(fit.hypothesis),
          model_errors_(about.errors.linearised_at),
          here_(inference.errors().whiten(about.values)) {
        hypothesis_.push_back(&mechanism);
    }

    /// Over the prior: three places of every parameter but the first, of which there are at least five; more between two whose
    /// steps have little in common, as those to a step in time at another moment.
    std::vector<Eigen::VectorXd> all() {
        std::vector<std::vector<double>> others{{}};
        for (std::size_t k = 1; k < mechanism_.parameters.size(); ++k) {
            std::vector<std::vector<double>> more;
            for (const std::vector<double>& values : others) {
                for (const double place : {0.2, 0.5, 0.8}) {
                    more.push_back(values);
                    more.back().push_back(mechanism_.parameters[k].at(place));
                }
            }
            others = std::move(more);
        }
        for (const std::vector<double>& values : others) {
            add_along_first(values);
        }
        return std::move(steps_);
    }

private:
    /// None where nothing shows.
    Eigen::VectorXd step_to(double place, const std::vector<double>& others) const {
        std::vector<double> values = fit_.values();
        if (!mechanism_.parameters.empty()) {
            values.push_back(mechanism_.parameters.front().at(place));
        }
        values.insert(values.end(), others.begin(), others.end());
        const Model model(hypothesis_, values, fit_.model.settings.normal_stiffness);
        Eigen::VectorXd step = Eigen::VectorXd::Zero(basis_.rows());
        Eigen::VectorXd errors = Eigen::VectorXd::Zero(inference_.forward().errors_of(model));
        errors.tail(model_errors_.size()) = model_errors_;  // a mechanism that adds some puts them in front, or all are 0
        step.head(here_.size()) = inference_.errors().whiten(inference_.forward().predict(model, errors)) - here_;
        const double length = step.norm();
        step -= basis_ * (basis_.transpose() * step);
        constexpr double visible = 1e-6;  // part of the step that the fitted quantities cannot make
        return step.norm() > visible * length && length > 0 ? Eigen::VectorXd(step.normalized()) : Eigen::VectorXd();
    }

    void add_along_first(const std::vector<double>& others) {
        double before = 0;
        Eigen::VectorXd last;
        for (const double place : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98}) {
            Eigen::VectorXd step = step_to(place, others);
            if (last.size() > 0 && step.size() > 0) {
                add_between(before, last, place, step, others, 0);
            }
            before = place;
            last = step;
            if (step.size() > 0) {
                steps_.push_back(std::move(step));
            }
        }
    }

    void add_between(double low, const Eigen::VectorXd& at_low, double high, const Eigen::VectorXd& at_high,
                     const std::vector<double>& others, int depth) {
        constexpr double alike = 0.7;
        constexpr int deepest = 5;
        if (depth == deepest || at_low.dot(at_high) > alike) {
            return;
        }
        const double middle = 0.5 * (low + high);
        const Eigen::VectorXd step = step_to(middle, others);
        if (step.size() > 0) {
            add_between(low, at_low, middle, step, others, depth + 1);
            add_between(middle, step, high, at_high, others, depth + 1);
            steps_.push_back(step);
        }
    }

    const Inference& inference_;
    const Fit& fit_;
    const Mechanism& mechanism_;
    const Eigen::MatrixXd& basis_;
    Hypothesis hypothesis_;
    Eigen::VectorXd model_errors_;  ///< about which the fit stands
    Eigen::VectorXd here_;
    std::vector<Eigen::VectorXd> steps_;
};

}  // namespace

std::vector<Eigen::VectorXd> steps_towards(const Mechanism& mechanism, const Inference& inference, const Fit& fit,
                                           const Prediction& about, const Eigen::MatrixXd& basis) {
    return StepsTowards(inference, fit, about, mechanism, basis).all();
}

Eigen::MatrixXd steps_in(const std::vector<Index>& rows, const Eigen::MatrixXd& steps, const Eigen::MatrixXd& basis) {
    constexpr double visible = 0.1;  // part of a step: less is a matter of the other rows
    constexpr double alike = 0.97;   // cosine between two steps of which one is enough
    Eigen::MatrixXd own = Eigen::MatrixXd::Zero(steps.rows(), steps.cols());
    own(rows, Eigen::all) = steps(rows, Eigen::all);
    own -= (basis * (basis.transpose() * own)).eval();
    Index kept = 0;
    for (Index step = 0; step < own.cols(); ++step) {
        const double length = own.col(step).norm();
        const Eigen::VectorXd unit = own.col(step) / length;
        if (length > visible && (kept == 0 || (own.leftCols(kept).transpose() * unit).maxCoeff() < alike)) {
            own.col(kept++) = unit;
        }
    }
    return own.leftCols(kept);
}

}  // namespace coagula::diagnose
