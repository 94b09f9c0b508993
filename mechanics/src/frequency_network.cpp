#include "frequency_network.hpp"

#include <coagula/common/contact_model.hpp>

namespace coagula::mechanics {

namespace {

/// The same stiffness for every bond: along (n n^T), or in all directions (I).
std::vector<ContactTangent> alike(const ContactNetwork& bonds, const ContactTangent& tangent) {
    return std::vector<ContactTangent>(static_cast<std::size_t>(bonds.size()), tangent);
}

Eigen::VectorXd drag_of(const Packing& packing, const LoadBearing& kept) {
    const double r0 = mean_radius(packing);
    Eigen::VectorXd drag(6 * static_cast<Index>(kept.particle.size()));
    for (std::size_t place = 0; place < kept.particle.size(); ++place) {
        const double radius = packing.radii[kept.particle[place]] / r0;
        drag.segment<3>(6 * static_cast<Index>(place)).setConstant(translation_drag(radius));
        drag.segment<3>(6 * static_cast<Index>(place) + 3).setConstant(rotation_drag(radius));
    }
    return drag;
}

/// v x, as a matrix; Eigen's own cross product conjugates complex vectors.
Eigen::Matrix3cd cross_matrix(const Eigen::Vector3d& v) {
    Eigen::Matrix3cd m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

std::vector<Block> free_spins(const LinearNetwork& network, BlockMatrix upper) {
    for (Block& block : upper.block) {
        block.setZero();
    }
    network.stiffen_spins(upper);
    std::vector<Block> spins;
    for (Index particle = 0; particle < upper.rows(); ++particle) {
        spins.push_back(upper.diagonal(particle));
    }
    return spins;
}

}  // namespace

FrequencyNetwork::FrequencyNetwork(const Packing& packing, const ContactNetwork& bonds, const LoadBearing& kept)
    : along_(packing, bonds, kept, alike(bonds, {.normal = 1}), 1),
      isotropic_(packing, bonds, kept, alike(bonds, {.normal = 1, .shear = 1}), 1),
      upper_(along_.stiffness()),
      along_matrix_(both_triangles(upper_)),
      isotropic_matrix_(both_triangles(isotropic_.stiffness())),
      along_loads_(along_.loads()),
      isotropic_loads_(isotropic_.loads()),
      spin_(free_spins(along_, upper_)),
      drag_(drag_of(packing, kept)),
      load_scale_(along_.affine_energy().diagonal().transpose().array().sqrt()) {}

ComplexBlocks FrequencyNetwork::matrix(const Ratios& ratios) const {
    ComplexBlocks result;
    result.block.resize(along_matrix_.block.size());
    for (Index row = 0; row < particles(); ++row) {
        for (auto k = static_cast<std::size_t>(along_matrix_.start[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(along_matrix_.start[static_cast<std::size_t>(row) + 1]); ++k) {
            result.block[k] = (1.0 - ratios.shear) * along_matrix_.block[k].cast<Complex>() +
                              ratios.shear * isotropic_matrix_.block[k].cast<Complex>();
            if (along_matrix_.column[k] == row) {
                result.block[k].diagonal() += ratios.drag * drag_.segment<6>(6 * row).cast<Complex>();
            }
        }
    }
    return result;
}

ComplexLoads FrequencyNetwork::loads(const Ratios& ratios) const {
    return (1.0 - ratios.shear) * along_loads_.cast<Complex>() + ratios.shear * isotropic_loads_.cast<Complex>();
}

void FrequencyNetwork::multiply(const ComplexBlocks& matrix, const ComplexLoads& x, ComplexLoads& y) const {
    y.resize(x.rows(), 6);
#pragma omp parallel for schedule(static)
    for (Index row = 0; row < particles(); ++row) {
        Eigen::Matrix<Complex, 6, 6, Eigen::RowMajor> sum = Eigen::Matrix<Complex, 6, 6, Eigen::RowMajor>::Zero();
        for (auto k = static_cast<std::size_t>(along_matrix_.start[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(along_matrix_.start[static_cast<std::size_t>(row) + 1]); ++k) {
            sum.noalias() += matrix.block[k] * x.middleRows<6>(6 * along_matrix_.column[k]);
        }
        y.middleRows<6>(6 * row) = sum;
    }
}

template <class Visit>
void FrequencyNetwork::for_each_upper(const Visit& visit) const {
    for (Index row = 0; row < particles(); ++row) {
        for (auto k = static_cast<std::size_t>(along_matrix_.start[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(along_matrix_.start[static_cast<std::size_t>(row) + 1]); ++k) {
            const bool diagonal = along_matrix_.column[k] == row;
            if (along_matrix_.column[k] < row) {
                continue;
            }
            for (int r = 0; r < 6; ++r) {
                for (int c = diagonal ? r : 0; c < 6; ++c) {
                    visit(row, k, r, c);
                }
            }
        }
    }
}

void FrequencyNetwork::scalar_pattern(std::vector<int>& row, std::vector<int>& column) const {
    for_each_upper([&](Index block_row, std::size_t k, int r, int c) {
        row.push_back(static_cast<int>(6 * block_row) + r);
        column.push_back(static_cast<int>(6 * along_matrix_.column[k]) + c);
    });
}

std::vector<Complex> FrequencyNetwork::scalar_values(const ComplexBlocks& matrix, double shift) const {
    std::vector<Complex> values;
    for_each_upper([&](Index row, std::size_t k, int r, int c) {
        Complex value = matrix.block[k](r, c);
        if (shift > 0 && along_matrix_.column[k] == row) {
            value += spin_[static_cast<std::size_t>(row)](r, c) + (r == c ? shift : 0.0);
        }
        values.push_back(value);
    });
    return values;
}

Forms FrequencyNetwork::forms(const ComplexLoads& motion) const {
    using Three = Eigen::Matrix<Complex, 3, 6>;
    Forms sum;
    for (const LinearBond& bond : along_.bonds()) {
        const Eigen::RowVector3cd n = bond.normal.transpose().cast<Complex>();
        const Three turn =
            bond.first_arm * motion.middleRows<3>(6 * bond.first + 3) + bond.second_arm * motion.middleRows<3>(6 * bond.second + 3);
        Three delta = affine_displacements(bond.branch).cast<Complex>() + motion.middleRows<3>(6 * bond.second) -
                      motion.middleRows<3>(6 * bond.first);
        delta += cross_matrix(bond.normal) * turn;
        const Eigen::Matrix<Complex, 1, 6> along = n * delta;
        const Three across = delta - n.transpose() * along;
        sum.along += along.transpose() * along;
        sum.across += across.transpose() * across;
        sum.along_power += along.cwiseAbs2().transpose();
        sum.across_power += across.colwise().squaredNorm().transpose();
    }
    sum.drag = motion.transpose() * drag_.cast<Complex>().asDiagonal() * motion;
    sum.drag_power = motion.cwiseAbs2().transpose() * drag_;
    return sum;
}

}  // namespace coagula::mechanics
