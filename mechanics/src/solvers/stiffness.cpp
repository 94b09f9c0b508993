// SPDX-License-Identifier: GPL-3.0-or-later
#include "stiffness.hpp"

#include "six_column_kernels.hpp"

#include <coagula/common/parallel.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace coagula::mechanics {

namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

using EndMatrix = Deformations<6>;

/// Deformation of the bond per unknown of one end.
EndMatrix end_matrix(double sign, double arm, const Eigen::Vector3d& normal) {
    const Eigen::Matrix3d signs = sign * Eigen::Matrix3d::Identity();
    EndMatrix b = EndMatrix::Zero();
    b.topLeftCorner<3, 3>() = signs;
    b.topRightCorner<3, 3>() = arm * cross_matrix(normal);
    b.block<3, 3>(3, 3) = signs;
    b.bottomLeftCorner<3, 3>() = signs;
    return b;
}
EndMatrix first_end(const LinearBond& bond) {
    return end_matrix(-1, bond.first_arm, bond.normal);
}
EndMatrix second_end(const LinearBond& bond) {
    return end_matrix(1, bond.second_arm, bond.normal);
}

ContactTangent reduced(const ContactTangent& k, double reference, double length) {
    const double moment = reference * length * length;
    return {k.normal / reference, k.shear / reference, k.bending / moment, k.twisting / moment, k.tension / reference};
}

struct Entry {
    Index row;
    Index column;
    Index bond;
};

/// Sorted places of the off-diagonal blocks, one per bond.
std::vector<Entry> off_diagonal_entries(const std::vector<LinearBond>& bonds) {
    std::vector<Entry> entries;
    entries.reserve(bonds.size());
    for (std::size_t k = 0; k < bonds.size(); ++k) {
        const auto [low, high] = std::minmax(bonds[k].first, bonds[k].second);
        if (low >= 0 && low != high) {
            entries.push_back({low, high, static_cast<Index>(k)});
        }
    }
    std::stable_sort(entries.begin(), entries.end(),
                     [](const Entry& a, const Entry& b) { return a.row != b.row ? a.row < b.row : a.column < b.column; });
    return entries;
}

/// Pattern with one diagonal block per row and one block per bonded pair; values zero.
BlockMatrix empty_pattern(Index rows, const std::vector<Entry>& entries) {
    BlockMatrix matrix;
    matrix.start.assign(static_cast<std::size_t>(rows) + 1, 0);
    auto entry = entries.begin();
    for (Index row = 0; row < rows; ++row) {
        matrix.column.push_back(row);
        for (; entry != entries.end() && entry->row == row; ++entry) {
            if (matrix.column.back() != entry->column) {
                matrix.column.push_back(entry->column);
            }
        }
        matrix.start[static_cast<std::size_t>(row) + 1] = static_cast<Index>(matrix.column.size());
    }
    matrix.block.assign(matrix.column.size(), Block::Zero());
    return matrix;
}

/// A bond as one of its particles sees it.
struct BondEnd {
    const LinearBond* bond = nullptr;
    Eigen::Vector3d contact = Eigen::Vector3d::Zero();  ///< from the centre of the particle
};

/// Whether nothing resists the spin of a particle about the line through the contacts of its only two bonds.
bool spins_freely(const LinearBond& one, const LinearBond& other) {
    constexpr double certainly_straight = 1e-6;
    const bool straight = one.normal.cross(other.normal).norm() < certainly_straight;
    const auto resists = [&](const LinearBond& bond) {
        return bond.tangent.twisting > 0 || (!straight && (bond.tangent.bending > 0 || bond.tangent.tension != 0));
    };
    return !resists(one) && !resists(other);
}

}  // namespace

Eigen::Matrix<double, 3, 6> affine_displacements(const Eigen::Vector3d& b) {
    Eigen::Matrix<double, 3, 6> e;
    e << b.x(), 0, 0, 0, 0.5 * b.z(), 0.5 * b.y(),  //
        0, b.y(), 0, 0.5 * b.z(), 0, 0.5 * b.x(),   //
        0, 0, b.z(), 0.5 * b.y(), 0.5 * b.x(), 0;
    return e;
}

LinearNetwork::LinearNetwork(const Packing& packing, const ContactNetwork& network, const LoadBearing& kept,
                             std::span<const ContactTangent> tangents, double reference)
    : particles_(static_cast<Index>(kept.particle.size())), length_(mean_radius(packing)), kept_bond_(kept.bond) {
    bonds_.reserve(kept.bond.size());
    for (const Index bond : kept.bond) {
        const Index first = network.ends(0, bond);
        const Index second = network.ends(1, bond);
        const Eigen::Vector3d branch = network.branch.col(bond) / length_;
        const double share = packing.radii[first] / (packing.radii[first] + packing.radii[second]);
        const double distance = branch.norm();
        bonds_.push_back({kept.number[static_cast<std::size_t>(first)], kept.number[static_cast<std::size_t>(second)],
                          branch / distance, branch, share * distance, (1 - share) * distance,
                          reduced(tangents[static_cast<std::size_t>(bond)], reference, length_)});
    }
}

void LinearNetwork::strain(const Eigen::Matrix3Xd& strained) {
    for (std::size_t k = 0; k < bonds_.size(); ++k) {
        bonds_[k].branch = strained.col(kept_bond_[k]) / length_;
    }
}

BlockMatrix LinearNetwork::stiffness() const {
    const auto entries = off_diagonal_entries(bonds_);
    BlockMatrix matrix = empty_pattern(particles_, entries);
    for (const LinearBond& bond : bonds_) {
        add_to_diagonal(matrix, bond);
    }
    std::size_t slot = 0;
    for (const Entry& entry : entries) {
        const LinearBond& bond = bonds_[static_cast<std::size_t>(entry.bond)];
        slot = std::max(slot, static_cast<std::size_t>(matrix.start[static_cast<std::size_t>(entry.row)]));
        while (matrix.column[slot] != entry.column) {
            ++slot;
        }
        const Block block = coupling(bond);
        matrix.block[slot] += bond.first < bond.second ? block : Block(block.transpose());
    }
    return matrix;
}

/// Block of the stiffness between the two ends of a bond.
Block LinearNetwork::coupling(const LinearBond& bond) {
    return first_end(bond).transpose() * stresses(bond, second_end(bond));
}

void LinearNetwork::add_to_diagonal(BlockMatrix& matrix, const LinearBond& bond) {
    if (bond.first >= 0) {
        const EndMatrix end = first_end(bond);
        matrix.diagonal(bond.first) += end.transpose() * stresses(bond, end);
    }
    if (bond.second >= 0) {
        const EndMatrix end = second_end(bond);
        matrix.diagonal(bond.second) += end.transpose() * stresses(bond, end);
    }
    if (bond.first >= 0 && bond.first == bond.second) {  // bonded to its own periodic image
        const Block block = coupling(bond);
        matrix.diagonal(bond.first) += block + block.transpose();
    }
}

Loads LinearNetwork::loads() const {
    Loads f = Loads::Zero(6 * particles_, 6);
    for (const LinearBond& bond : bonds_) {
        const Deformations<6> force = stresses(bond, affine_deformations(bond));
        if (bond.first >= 0) {
            f.middleRows<6>(6 * bond.first) -= first_end(bond).transpose() * force;
        }
        if (bond.second >= 0) {
            f.middleRows<6>(6 * bond.second) -= second_end(bond).transpose() * force;
        }
    }
    return f;
}

Block LinearNetwork::affine_energy() const {
    Block energy = Block::Zero();
    for (const LinearBond& bond : bonds_) {
        const Deformations<6> e = affine_deformations(bond);
        energy += e.transpose() * stresses(bond, e);
    }
    return energy;
}

Deformations<6> LinearNetwork::affine_deformations(const LinearBond& bond) {
    Deformations<6> e = Deformations<6>::Zero();
    e.topRows<3>() = affine_displacements(bond.branch);
    e.bottomRows<3>() = e.topRows<3>();
    return e;
}

Deformations<6> LinearNetwork::deformation(const LinearBond& bond, const Loads& motion) {
    Deformations<6> result = affine_deformations(bond);
    if (bond.first >= 0) {
        result += first_end(bond) * motion.middleRows<6>(6 * bond.first);
    }
    if (bond.second >= 0) {
        result += second_end(bond) * motion.middleRows<6>(6 * bond.second);
    }
    return result;
}

Block LinearNetwork::energy(const Loads& motion) const {
    Block sum = Block::Zero();
    for (const LinearBond& bond : bonds_) {
        const Deformations<6> all = deformation(bond, motion);
        sum += all.transpose() * stresses(bond, all);
    }
    return sum;
}

Block LinearNetwork::virial(const Loads& motion, const std::vector<double>& weight) const {
    Block sum = Block::Zero();
    for (std::size_t k = 0; k < bonds_.size(); ++k) {
        const LinearBond& bond = bonds_[k];
        sum += weight[k] * affine_deformations(bond).transpose() * stresses(bond, deformation(bond, motion));
    }
    return sum;
}

Index LinearNetwork::stiffen_spins(BlockMatrix& matrix) const {
    std::vector<int> degree(static_cast<std::size_t>(particles_), 0);
    std::vector<std::array<BondEnd, 2>> end(static_cast<std::size_t>(particles_));
    const auto note = [&](Index particle, const BondEnd& now) {
        if (particle >= 0) {
            const auto place = static_cast<std::size_t>(particle);
            end[place][static_cast<std::size_t>(degree[place] % 2)] = now;
            ++degree[place];
        }
    };
    for (const LinearBond& bond : bonds_) {
        note(bond.first, {&bond, bond.first_arm * bond.normal});
        note(bond.second, {&bond, -bond.second_arm * bond.normal});
    }
    Index spins = 0;
    for (Index particle = 0; particle < particles_; ++particle) {
        const auto place = static_cast<std::size_t>(particle);
        if (degree[place] == 2 && spins_freely(*end[place][0].bond, *end[place][1].bond)) {
            const Eigen::Vector3d axis = (end[place][1].contact - end[place][0].contact).normalized();
            Eigen::Matrix<double, 6, 1> spin;
            spin << end[place][0].contact.cross(axis), axis;  // the contact points stay where they are
            spin.normalize();
            matrix.diagonal(particle) += spin * spin.transpose();
            ++spins;
        }
    }
    return spins;
}

BlockMatrix both_triangles(const BlockMatrix& upper) {
    const Index rows = upper.rows();
    BlockMatrix full;
    full.start.assign(static_cast<std::size_t>(rows) + 1, 0);
    for (Index row = 0; row < rows; ++row) {
        for (Index k = upper.start[static_cast<std::size_t>(row)]; k < upper.start[static_cast<std::size_t>(row) + 1]; ++k) {
            const Index column = upper.column[static_cast<std::size_t>(k)];
            ++full.start[static_cast<std::size_t>(row) + 1];
            full.start[static_cast<std::size_t>(column) + 1] += column == row ? 0 : 1;
        }
    }
    for (std::size_t row = 1; row < full.start.size(); ++row) {
        full.start[row] += full.start[row - 1];
    }
    std::vector<Index> next(full.start.begin(), full.start.end() - 1);
    full.column.resize(static_cast<std::size_t>(full.start.back()));
    full.block.resize(full.column.size());
    const auto put = [&](Index row, Index column, const Block& block) {
        const auto place = static_cast<std::size_t>(next[static_cast<std::size_t>(row)]++);
        full.column[place] = column;
        full.block[place] = block;
    };
    for (Index row = 0; row < rows; ++row) {
        for (Index k = upper.start[static_cast<std::size_t>(row)]; k < upper.start[static_cast<std::size_t>(row) + 1]; ++k) {
            const Index column = upper.column[static_cast<std::size_t>(k)];
            const Block& block = upper.block[static_cast<std::size_t>(k)];
            put(row, column, block);
            if (column != row) {
                put(column, row, block.transpose());
            }
        }
    }
    return full;
}

void multiply(const BlockMatrix& full, const Loads& x, Loads& y) {
    y.resize(x.rows(), 6);
#pragma omp parallel for schedule(static) if (worth_threads(full.rows(), 500))
    for (Index row = 0; row < full.rows(); ++row) {
        const auto begin = static_cast<std::size_t>(full.start[static_cast<std::size_t>(row)]);
        const auto end = static_cast<std::size_t>(full.start[static_cast<std::size_t>(row) + 1]);
        multiply_row(full.block[begin].data(), full.column.data() + begin, end - begin, x.data(), y.data() + 36 * row);
    }
}

}  // namespace coagula::mechanics
