// SPDX-License-Identifier: GPL-3.0-or-later
// What the instrument shows, with how it changes with the errors of the prediction.
#include "forward.hpp"

#include <cmath>
#include <complex>
#include <utility>
#include <variant>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;

constexpr double small_step = 1e-5;  ///< relative step of a modulus

}  // namespace

Prediction Forward::prediction(const Model& model) const {
    if (!smooth_) {
        return prediction(model, Eigen::VectorXd::Zero(errors_of(model)));
    }
    // About the material that this instrument asks for: most instruments show it in proportion, slip and compliance nearly so.
    constexpr int rounds = 2;
    Eigen::VectorXd place = smooth_->start();
    Prediction about = prediction(model, place);
    for (int round = 0; round < rounds; ++round) {
        place = smooth_->best(place, about.values, about.errors.changes);
        about = prediction(model, place);
    }
    about.errors.changes(Eigen::all, smooth_->at_end(place)).setZero();
    return about;
}

Prediction Forward::prediction(const Model& model, const Eigen::VectorXd& errors) const {
    const UncertainModuli& material = remembered_material(model, false);
    const Index of_material = material.errors();
    const Eigen::MatrixXd& shared = shared_errors_of(model);
    const Eigen::MatrixXcd moduli = material.tangents(errors.head(of_material));
    const Eigen::VectorXd values = seen(model, moduli.col(0), false);
    Eigen::MatrixXd changes(values.size(), errors.size());
    changes << changes_by_instrument(model, moduli, values), shared;
    return {values + shared * errors.tail(shared.cols()),
            level_slope(model, moduli.col(0), values),
            {std::move(changes), material.degrees, errors}};
}

Prediction Forward::change_by_stiffness(const Model& model, const Prediction& here, double step) const {
    if (shows_in_proportion(model) && model.simulated().felt_viscosity == 0) {
        Prediction change(Eigen::VectorXd::Zero(here.values.size()));
        for (Index row = 0; row < change.values.size(); ++row) {
            const Observation& one = observations_[static_cast<std::size_t>(row)];
            change.values[row] = scales(one) ? std::expm1(step) * here.values[row] : 0.0;
        }
        change.level_slope = change.values;
        return change;
    }
    Model stiffer = model;
    stiffer.settings.normal_stiffness *= std::exp(step);
    const UncertainModuli& material = remembered_material(stiffer, false);
    const Eigen::VectorXd& errors = here.errors.linearised_at;
    const Eigen::MatrixXd& shared = shared_errors_of(stiffer);
    const Eigen::VectorXcd moduli = material.with(errors.head(material.errors()));
    const Eigen::VectorXd values = seen(stiffer, moduli, false);
    return {
        values + shared * errors.tail(shared.cols()) - here.values, level_slope(stiffer, moduli, values) - here.level_slope, {}};
}

/// Whether the instrument shows the material as it is.
bool Forward::shows_in_proportion(const Model& model) {
    return !model.has<ChangesGeometry>() && !model.has<ChangesTool>();
}

/// Slope of what the instrument shows by the logarithm of the level of the material. @param values at these moduli of it.
Eigen::VectorXd Forward::level_slope(const Model& model, const Eigen::VectorXcd& moduli, const Eigen::VectorXd& values) const {
    return shows_in_proportion(model) ? values
                                      : Eigen::VectorXd((seen(model, (1 + small_step) * moduli, false) - values) / small_step);
}

/// Slopes of what the instrument shows by the errors of the material. @param moduli and how these change them. @param values at
/// the moduli.
Eigen::MatrixXd Forward::changes_by_instrument(const Model& model, const Eigen::MatrixXcd& moduli,
                                               const Eigen::VectorXd& values) const {
    const auto tangents = moduli.rightCols(moduli.cols() - 1);
    if (tangents.cols() == 0) {
        // NOLINTNEXTLINE(modernize-return-braced-init-list): braces would hold two elements
        return Eigen::MatrixXd(moduli.rows(), 0);
    }
    const Eigen::VectorXd steps = small_step * (moduli.real().cwiseAbs() + moduli.imag().cwiseAbs()).rowwise().maxCoeff();
    const auto by_step = [&](Complex direction) -> Eigen::VectorXd {
        const Eigen::VectorXd moved = seen(model, moduli.col(0) + direction * steps, false);
        return (steps.array() > 0).select((moved - values).array() / steps.array(), 0.0);
    };
    return by_step({1, 0}).asDiagonal() * tangents.real() + by_step({0, 1}).asDiagonal() * tangents.imag();
}

}  // namespace coagula::diagnose
