// SPDX-License-Identifier: GPL-3.0-or-later
#include "uncertain_moduli.hpp"

#include <utility>

namespace coagula::diagnose {

using Eigen::MatrixXcd;
using Eigen::VectorXcd;

UncertainModuli::UncertainModuli(VectorXcd expected, MatrixXcd added)
    : mean(std::move(expected)),
      changes(std::move(added)),
      dragged(VectorXcd::Zero(mean.size())),
      excess(VectorXcd::Zero(mean.size())),
      logarithms(MatrixXcd::Zero(mean.size(), 0)) {}

UncertainModuli::UncertainModuli(const VectorXcd& known) : UncertainModuli(known, MatrixXcd(known.size(), 0)) {}

UncertainModuli::Parts UncertainModuli::parts(const Eigen::VectorXd& errors) const {
    const VectorXcd moduli = mean + changes * errors.head(changes.cols());
    const VectorXcd growth = (excess + logarithms * errors.tail(logarithms.cols())).array().exp();
    return {moduli, growth, 1.0 + dragged.array() * (growth.array() - 1.0)};
}

VectorXcd UncertainModuli::with(const Eigen::VectorXd& errors) const {
    const Parts here = parts(errors);
    return here.moduli.cwiseProduct(here.factor);
}

MatrixXcd UncertainModuli::tangents(const Eigen::VectorXd& errors) const {
    const Parts here = parts(errors);
    MatrixXcd all(mean.size(), 1 + errors.size());
    all << here.moduli.cwiseProduct(here.factor), here.factor.asDiagonal() * changes,
        here.moduli.cwiseProduct(dragged).cwiseProduct(here.growth).asDiagonal() * logarithms;
    return all;
}

}  // namespace coagula::diagnose
