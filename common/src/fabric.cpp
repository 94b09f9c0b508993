// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/fabric.hpp>

#include <coagula/common/checks.hpp>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace coagula {

Fabric find_fabric(const ContactNetwork& bonds, const Eigen::VectorXd& weight) {
    require(weight.size() == bonds.size(), "the weights of the contacts must be one per contact");
    Fabric fabric;
    for (Index bond = 0; bond < bonds.size(); ++bond) {
        const Eigen::Vector3d n = bonds.branch.col(bond).normalized();
        fabric.tensor += weight[bond] * n * n.transpose();
    }
    const double sum = fabric.tensor.trace();
    if (sum > 0) {
        fabric.tensor /= sum;
        fabric.eigenvalues = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(fabric.tensor).eigenvalues().cwiseMax(0.0);
        fabric.anisotropy = std::sqrt(1.5) * (fabric.tensor - Eigen::Matrix3d::Identity() / 3).norm();
    }
    return fabric;
}

}  // namespace coagula
