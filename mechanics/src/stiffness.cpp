#include "stiffness.hpp"

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

using EndMatrix = Eigen::Matrix<double, 3, 6>;

/// Relative displacement at the contact per unknown of one end.
EndMatrix end_matrix(double sign, double arm, const Eigen::Vector3d& normal) {
    EndMatrix b;
    b.leftCols<3>() = sign * Eigen::Matrix3d::Identity();
    b.rightCols<3>() = arm * cross_matrix(normal);
    return b;
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

}  // namespace

Eigen::Matrix<double, 3, 6> affine_displacements(const Eigen::Vector3d& b) {
    Eigen::Matrix<double, 3, 6> e;
    e << b.x(), 0, 0, 0, 0.5 * b.z(), 0.5 * b.y(),  //
        0, b.y(), 0, 0.5 * b.z(), 0, 0.5 * b.x(),   //
        0, 0, b.z(), 0.5 * b.y(), 0.5 * b.x(), 0;
    return e;
}

LinearNetwork::LinearNetwork(const Packing& packing, const ContactNetwork& network, const LoadBearing& kept,
                             const BondedContact& law)
    : particles_(static_cast<Index>(kept.particle.size())), law_(1.0, law.shear_stiffness() / law.normal_stiffness()) {
    const double r0 = mean_radius(packing);
    bonds_.reserve(kept.bond.size());
    for (const Index bond : kept.bond) {
        const Index first = network.ends(0, bond);
        const Index second = network.ends(1, bond);
        const Eigen::Vector3d branch = network.branch.col(bond) / r0;
        const double share = packing.radii[first] / (packing.radii[first] + packing.radii[second]);
        const double distance = branch.norm();
        bonds_.push_back({kept.number[static_cast<std::size_t>(first)], kept.number[static_cast<std::size_t>(second)],
                          branch / distance, branch, share * distance, (1 - share) * distance});
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
Block LinearNetwork::coupling(const LinearBond& bond) const {
    return end_matrix(-1, bond.first_arm, bond.normal).transpose() * law_.tangent(bond.normal) *
           end_matrix(1, bond.second_arm, bond.normal);
}

void LinearNetwork::add_to_diagonal(BlockMatrix& matrix, const LinearBond& bond) const {
    const Eigen::Matrix3d tangent = law_.tangent(bond.normal);
    if (bond.first >= 0) {
        const EndMatrix end = end_matrix(-1, bond.first_arm, bond.normal);
        matrix.diagonal(bond.first) += end.transpose() * tangent * end;
    }
    if (bond.second >= 0) {
        const EndMatrix end = end_matrix(1, bond.second_arm, bond.normal);
        matrix.diagonal(bond.second) += end.transpose() * tangent * end;
    }
    if (bond.first >= 0 && bond.first == bond.second) {  // bonded to its own periodic image
        const Block block = coupling(bond);
        matrix.diagonal(bond.first) += block + block.transpose();
    }
}

Loads LinearNetwork::loads() const {
    Loads f = Loads::Zero(6 * particles_, 6);
    for (const LinearBond& bond : bonds_) {
        const Eigen::Matrix<double, 3, 6> force = law_.tangent(bond.normal) * affine_displacements(bond.branch);
        if (bond.first >= 0) {
            f.middleRows<6>(6 * bond.first) -= end_matrix(-1, bond.first_arm, bond.normal).transpose() * force;
        }
        if (bond.second >= 0) {
            f.middleRows<6>(6 * bond.second) -= end_matrix(1, bond.second_arm, bond.normal).transpose() * force;
        }
    }
    return f;
}

Block LinearNetwork::affine_energy() const {
    Block energy = Block::Zero();
    for (const LinearBond& bond : bonds_) {
        const auto e = affine_displacements(bond.branch);
        energy += e.transpose() * law_.tangent(bond.normal) * e;
    }
    return energy;
}

Eigen::Matrix<double, 3, 6> LinearNetwork::deformation(const LinearBond& bond, const Loads& motion) const {
    Eigen::Matrix<double, 3, 6> delta = affine_displacements(bond.branch);
    if (bond.first >= 0) {
        delta += end_matrix(-1, bond.first_arm, bond.normal) * motion.middleRows<6>(6 * bond.first);
    }
    if (bond.second >= 0) {
        delta += end_matrix(1, bond.second_arm, bond.normal) * motion.middleRows<6>(6 * bond.second);
    }
    return delta;
}

Block LinearNetwork::energy(const Loads& motion) const {
    Block sum = Block::Zero();
    for (const LinearBond& bond : bonds_) {
        const auto delta = deformation(bond, motion);
        sum += delta.transpose() * law_.tangent(bond.normal) * delta;
    }
    return sum;
}

Block LinearNetwork::virial(const Loads& motion, const std::vector<double>& weight) const {
    Block sum = Block::Zero();
    for (std::size_t k = 0; k < bonds_.size(); ++k) {
        const LinearBond& bond = bonds_[k];
        sum += weight[k] * affine_displacements(bond.branch).transpose() * law_.tangent(bond.normal) * deformation(bond, motion);
    }
    return sum;
}

Index LinearNetwork::stiffen_spins(BlockMatrix& matrix) const {
    std::vector<int> degree(static_cast<std::size_t>(particles_), 0);
    std::vector<std::array<Eigen::Vector3d, 2>> contact(static_cast<std::size_t>(particles_));
    const auto note = [&](Index particle, const Eigen::Vector3d& point) {
        if (particle >= 0) {
            const auto place = static_cast<std::size_t>(particle);
            contact[place][static_cast<std::size_t>(degree[place] % 2)] = point;
            ++degree[place];
        }
    };
    for (const LinearBond& bond : bonds_) {
        note(bond.first, bond.first_arm * bond.normal);
        note(bond.second, -bond.second_arm * bond.normal);
    }
    Index spins = 0;
    for (std::size_t particle = 0; particle < degree.size(); ++particle) {
        if (degree[particle] == 2) {
            const Eigen::Vector3d axis = (contact[particle][1] - contact[particle][0]).normalized();
            Eigen::Matrix<double, 6, 1> spin;
            spin << contact[particle][0].cross(axis), axis;  // the contact points stay where they are
            spin.normalize();
            matrix.diagonal(static_cast<Index>(particle)) += spin * spin.transpose();
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
    const Index rows = full.rows();
    y.resize(x.rows(), 6);
#pragma omp parallel for schedule(static)
    for (Index row = 0; row < rows; ++row) {
        Eigen::Matrix<double, 6, 6, Eigen::RowMajor> sum = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>::Zero();
        for (Index k = full.start[static_cast<std::size_t>(row)]; k < full.start[static_cast<std::size_t>(row) + 1]; ++k) {
            sum.noalias() +=
                full.block[static_cast<std::size_t>(k)] * x.middleRows<6>(6 * full.column[static_cast<std::size_t>(k)]);
        }
        y.middleRows<6>(6 * row) = sum;
    }
}

}  // namespace coagula::mechanics
