// SPDX-License-Identifier: GPL-3.0-or-later
// Measure: fabric tensor of the contacts.
#include "measure_options.hpp"

#include <coagula/common/fabric.hpp>

#include <Eigen/Core>

#include <cmath>

namespace coagula::characterize {

Measure fabric_measure();

namespace {

/// n n^T of the contacts of every inner particle, summed (9 x N).
Eigen::MatrixXd directions(const ContactNetwork& contacts) {
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(9, contacts.particles);
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const Eigen::Vector3d n = contacts.branch.col(contact).normalized();
        const Eigen::Matrix3d tensor = n * n.transpose();
        for (int end = 0; end < 2; ++end) {
            sums.col(contacts.ends(end, contact)) += tensor.reshaped();
        }
    }
    return sums;
}

double anisotropy_of(const Eigen::VectorXd& sums) {
    const Eigen::Matrix3d tensor = sums.reshaped(3, 3);
    return std::sqrt(1.5) * (tensor / tensor.trace() - Eigen::Matrix3d::Identity() / 3).norm();
}

MeasureResult run_fabric(const MeasureInput& input) {
    const ContactNetwork& contacts = input.contacts();
    require_applicable(contacts.size() > 0, "no particles are in contact: there is no fabric");
    const Fabric fabric = find_fabric(contacts, Eigen::VectorXd::Ones(contacts.size()));
    const Eigen::VectorXd error = block_errors(sum_by_block(input.blocks(), directions(contacts)), [](const Eigen::VectorXd& sums) {
        return Eigen::VectorXd::Constant(1, anisotropy_of(sums));
    });
    MeasureResult result;
    result.add_matrix("fabric/tensor", fabric.tensor, "1", "mean of n n^T over the contacts, n their unit vectors");
    result.add_vector("fabric/eigenvalues", fabric.eigenvalues, "1", "eigenvalues of the fabric tensor, ascending");
    result.add("fabric/anisotropy", fabric.anisotropy, "1", "sqrt(3/2) |fabric - 1/3|: 0 isotropic, 1 all contacts parallel",
               error[0]);
    result.add("fabric/by_chance", std::sqrt(1 / static_cast<double>(contacts.size())), "1",
               "anisotropy that as many contacts of random directions have by chance");
    result.add_line("anisotropy of the contacts", with_unit(fabric.anisotropy, "1") + "   (by chance " +
                                                      with_unit(std::sqrt(1 / static_cast<double>(contacts.size())), "1") + ")");
    return result;
}

}  // namespace

Measure fabric_measure() {
    return {.name = "fabric",
            .summary = "fabric tensor of the contacts and its anisotropy",
            .run = run_fabric,
            .options = {contact_tolerance_option()}};
}

}  // namespace coagula::characterize
