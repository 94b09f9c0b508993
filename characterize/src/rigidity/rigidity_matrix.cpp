// SPDX-License-Identifier: GPL-3.0-or-later
#include "rigidity_matrix.hpp"

#include <algorithm>
#include <utility>

namespace coagula::characterize {

namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

RigidityMatrix::End end_matrix(Bonds bonds, double sign, double arm, const Eigen::Vector3d& normal) {
    if (bonds == Bonds::central) {
        return sign * normal.transpose();
    }
    RigidityMatrix::End end(3, 6);
    end << sign * Eigen::Matrix3d::Identity(), arm * cross_matrix(normal);
    return end;
}

/// @param pairs of blocks that share an entry: first <= second.
EliminationOrder order_of(Index blocks, std::vector<std::pair<Index, Index>> pairs, Index block_size) {
    for (Index k = 0; k < blocks; ++k) {
        pairs.emplace_back(k, k);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<Index> start(static_cast<std::size_t>(blocks) + 1, 0);
    std::vector<Index> row;
    for (const auto& [column, other] : pairs) {
        row.push_back(other);
        start[static_cast<std::size_t>(column) + 1] = static_cast<Index>(row.size());
    }
    return {start, row, static_cast<int>(block_size), Ordering::nested_dissection};
}

}  // namespace

RigidityMatrix::RigidityMatrix(const Packing& packing, const ContactNetwork& contacts, Bonds bonds)
    : particles_(packing.size()),
      freedoms_(bonds == Bonds::central ? 3 : 6),
      rows_(bonds == Bonds::central ? 1 : 3),
      ends_(contacts.ends) {
    const double r0 = mean_radius(packing);
    first_.reserve(static_cast<std::size_t>(contacts.size()));
    second_.reserve(first_.capacity());
    for (Index contact = 0; contact < contacts.size(); ++contact) {
        const double r_first = packing.radii[contacts.ends(0, contact)];
        const double share = r_first / (r_first + packing.radii[contacts.ends(1, contact)]);
        const double distance = contacts.branch.col(contact).norm();
        const Eigen::Vector3d normal = contacts.branch.col(contact) / distance;
        first_.push_back(end_matrix(bonds, -1, share * distance / r0, normal));
        second_.push_back(end_matrix(bonds, 1, (1 - share) * distance / r0, normal));
    }
}

Eigen::MatrixXd RigidityMatrix::apply(const Eigen::MatrixXd& x) const {
    Eigen::MatrixXd y(constraints(), x.cols());
    for (Index contact = 0; contact < contacts(); ++contact) {
        y.middleRows(rows_ * contact, rows_) = end(contact, 0) * x.middleRows(freedoms_ * particle(contact, 0), freedoms_) +
                                               end(contact, 1) * x.middleRows(freedoms_ * particle(contact, 1), freedoms_);
    }
    return y;
}

Eigen::MatrixXd RigidityMatrix::apply_transposed(const Eigen::MatrixXd& y) const {
    Eigen::MatrixXd x = Eigen::MatrixXd::Zero(unknowns(), y.cols());
    for (Index contact = 0; contact < contacts(); ++contact) {
        for (int which = 0; which < 2; ++which) {
            x.middleRows(freedoms_ * particle(contact, which), freedoms_) +=
                end(contact, which).transpose() * y.middleRows(rows_ * contact, rows_);
        }
    }
    return x;
}

Eigen::SparseMatrix<double> RigidityMatrix::gram(double shift, const std::vector<bool>& pinned) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(unknowns() + 3 * freedoms_ * freedoms_ * contacts()));
    for (Index unknown = 0; unknown < unknowns(); ++unknown) {
        const auto place = static_cast<int>(unknown);
        entries.emplace_back(place, place, pinned[static_cast<std::size_t>(unknown)] ? 1.0 : shift);
    }
    for (Index contact = 0; contact < contacts(); ++contact) {
        for (int a = 0; a < 2; ++a) {
            for (int b = 0; b < 2; ++b) {
                const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6> block =
                    end(contact, a).transpose() * end(contact, b);
                for (Index r = 0; r < freedoms_; ++r) {
                    for (Index c = 0; c < freedoms_; ++c) {
                        const Index row = freedoms_ * particle(contact, a) + r;
                        const Index column = freedoms_ * particle(contact, b) + c;
                        if (row >= column && !pinned[static_cast<std::size_t>(row)] && !pinned[static_cast<std::size_t>(column)]) {
                            entries.emplace_back(static_cast<int>(row), static_cast<int>(column), block(r, c));
                        }
                    }
                }
            }
        }
    }
    Eigen::SparseMatrix<double> lower(unknowns(), unknowns());
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
}

EliminationOrder RigidityMatrix::elimination_order() const {
    std::vector<std::pair<Index, Index>> pairs;
    for (Index contact = 0; contact < contacts(); ++contact) {
        pairs.emplace_back(std::minmax<Index>(particle(contact, 0), particle(contact, 1)));
    }
    return order_of(particles_, std::move(pairs), freedoms_);
}

LoadMatrix::LoadMatrix(const RigidityMatrix& motion) : motion_(motion), touches_(static_cast<std::size_t>(motion.particles())) {
    for (Index contact = 0; contact < motion.contacts(); ++contact) {
        for (int end = 0; end < 2; ++end) {
            touches_[static_cast<std::size_t>(motion.particle(contact, end))].push_back({contact, end});
        }
    }
}

Eigen::SparseMatrix<double> LoadMatrix::gram(double shift, const std::vector<bool>& pinned) const {
    const Index rows = motion_.rows_per_contact();
    std::vector<Eigen::Triplet<double>> entries;
    for (Index unknown = 0; unknown < unknowns(); ++unknown) {
        const auto place = static_cast<int>(unknown);
        entries.emplace_back(place, place, pinned[static_cast<std::size_t>(unknown)] ? 1.0 : shift);
    }
    for (const std::vector<Touch>& touches : touches_) {
        for (const Touch& one : touches) {
            for (const Touch& other : touches) {
                const RigidityMatrix::End& end = motion_.end(one.contact, one.end);
                const Eigen::MatrixXd block = end * motion_.end(other.contact, other.end).transpose();
                for (Index entry = 0; entry < rows * rows; ++entry) {
                    const Index row = rows * one.contact + entry % rows;
                    const Index column = rows * other.contact + entry / rows;
                    if (row >= column && !pinned[static_cast<std::size_t>(row)] && !pinned[static_cast<std::size_t>(column)]) {
                        entries.emplace_back(static_cast<int>(row), static_cast<int>(column), block(entry % rows, entry / rows));
                    }
                }
            }
        }
    }
    Eigen::SparseMatrix<double> lower(unknowns(), unknowns());
    lower.setFromTriplets(entries.begin(), entries.end());
    return lower;
}

EliminationOrder LoadMatrix::elimination_order() const {
    std::vector<std::pair<Index, Index>> pairs;
    for (const std::vector<Touch>& touches : touches_) {
        for (std::size_t one = 0; one < touches.size(); ++one) {
            for (std::size_t other = one + 1; other < touches.size(); ++other) {
                pairs.emplace_back(touches[one].contact, touches[other].contact);
            }
        }
    }
    return order_of(motion_.contacts(), std::move(pairs), motion_.rows_per_contact());
}

Eigen::MatrixXd rigid_motions(const Packing& packing, const RigidityMatrix& matrix) {
    const bool turns = packing.cell.is_open();
    Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(matrix.unknowns(), turns ? 6 : 3);
    const double r0 = mean_radius(packing);
    const Eigen::Vector3d centre = packing.positions.rowwise().mean();
    for (Index particle = 0; particle < matrix.particles(); ++particle) {
        auto rows = motions.middleRows(matrix.freedoms() * particle, matrix.freedoms());
        rows.topLeftCorner<3, 3>().setIdentity();
        if (turns) {
            rows.topRightCorner<3, 3>() = -cross_matrix((packing.positions.col(particle) - centre) / r0);
            if (matrix.freedoms() == 6) {
                rows.bottomRightCorner<3, 3>().setIdentity();
            }
        }
    }
    return motions;
}

}  // namespace coagula::characterize
