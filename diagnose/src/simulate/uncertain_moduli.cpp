#include "uncertain_moduli.hpp"

#include <utility>

namespace coagula::diagnose {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

UncertainModuli::UncertainModuli(VectorXcd expected, MatrixXcd added)
    : mean(std::move(expected)),
      changes(std::move(added)),
      dragged(VectorXcd::Zero(mean.size())),
      excess(VectorXcd::Zero(mean.size())),
      logarithms(MatrixXcd::Zero(mean.size(), 0)) {}

UncertainModuli::UncertainModuli(VectorXcd known) : UncertainModuli(std::move(known), {}) {
    changes = MatrixXcd::Zero(mean.size(), 0);
}

VectorXcd UncertainModuli::with(const Eigen::VectorXd& errors) const {
    return tangents(errors).col(0);
}

MatrixXcd UncertainModuli::tangents(const Eigen::VectorXd& errors) const {
    const Index adding = changes.cols();
    const VectorXcd moduli = mean + changes * errors.head(adding);
    const VectorXcd growth = (excess + logarithms * errors.tail(logarithms.cols())).array().exp();
    const VectorXcd factor = 1.0 + dragged.array() * (growth.array() - 1.0);
    MatrixXcd all(mean.size(), 1 + errors.size());
    all.col(0) = moduli.cwiseProduct(factor);
    all.middleCols(1, adding) = factor.asDiagonal() * changes;
    all.rightCols(logarithms.cols()) = moduli.cwiseProduct(dragged).cwiseProduct(growth).asDiagonal() * logarithms;
    return all;
}

}  // namespace coagula::diagnose
