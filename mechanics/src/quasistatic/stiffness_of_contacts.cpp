// SPDX-License-Identifier: GPL-3.0-or-later
#include "stiffness_of_contacts.hpp"

#include <coagula/common/dense.hpp>
#include <coagula/common/parallel.hpp>

#include <algorithm>

namespace coagula::mechanics {

namespace {

using Ends = Eigen::Matrix<double, 9, 6>;

/// (branch, rotation of first, rotation of second) per unknown of one end.
Ends along_first_end() {
    Ends ends = Ends::Zero();
    ends.block<3, 3>(0, 0) = -Eigen::Matrix3d::Identity();
    ends.block<3, 3>(3, 3) = Eigen::Matrix3d::Identity();
    return ends;
}
Ends along_second_end() {
    Ends ends = Ends::Zero();
    ends.block<3, 3>(0, 0) = Eigen::Matrix3d::Identity();
    ends.block<3, 3>(6, 3) = Eigen::Matrix3d::Identity();
    return ends;
}

/// Blocks of the same column are added up.
void append_row(std::vector<std::pair<Index, Block>>& row, BlockMatrix& matrix) {
    std::stable_sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [column, block] : row) {
        const bool is_new = static_cast<Index>(matrix.column.size()) == matrix.start.back() || matrix.column.back() != column;
        if (is_new) {
            matrix.column.push_back(column);
            matrix.block.push_back(block);
        } else {
            matrix.block.back() += block;
        }
    }
    matrix.start.push_back(static_cast<Index>(matrix.column.size()));
}

}  // namespace

StiffnessOfContacts::StiffnessOfContacts(const ShearedNetwork& network, const Trial& trial) : particles_(network.particles()) {
    const auto slopes = network.linearise(trial);
    const auto& contacts = network.contacts();
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        if (!slopes[k].isZero(0)) {
            links_.push_back({static_cast<Index>(k), trial.memory[k].bonded, contacts[k].first, contacts[k].second, slopes[k],
                              network.strain_rate(trial.memory[k])});
        }
    }
    ContactNetwork pairs;
    pairs.particles = particles_;
    pairs.ends.resize(2, static_cast<Index>(links_.size()));
    for (std::size_t k = 0; k < links_.size(); ++k) {
        pairs.ends.col(static_cast<Index>(k)) << static_cast<std::int32_t>(links_[k].first),
            static_cast<std::int32_t>(links_[k].second);
    }
    groups_ = group_by_particle(pairs);
}

Motion StiffnessOfContacts::operator*(const Motion& motion) const {
    return gather([&](const Link& link) -> Wrench {
        Wrench relative;
        relative << motion.segment<3>(6 * link.second) - motion.segment<3>(6 * link.first), motion.segment<3>(6 * link.first + 3),
            motion.segment<3>(6 * link.second + 3);
        return link.slope * relative;
    });
}

Motion StiffnessOfContacts::strain_load() const {
    return gather([](const Link& link) -> Wrench { return -link.slope.leftCols<3>() * link.strain_rate; });
}

template <class Change>
Motion StiffnessOfContacts::gather(const Change& change_of) const {
    std::vector<Wrench> change(links_.size());
    const auto count = static_cast<Index>(links_.size());
#pragma omp parallel for schedule(static) if (worth_threads(count, 50))
    for (Index k = 0; k < count; ++k) {
        change[static_cast<std::size_t>(k)] = change_of(links_[static_cast<std::size_t>(k)]);
    }
    Motion sum(6 * particles_);
#pragma omp parallel for schedule(static) if (worth_threads(particles_, 100))
    for (Index particle = 0; particle < particles_; ++particle) {
        Eigen::Matrix<double, 6, 1> all = Eigen::Matrix<double, 6, 1>::Zero();
        const auto row = static_cast<std::size_t>(particle);
        for (Index entry = groups_.start[row]; entry < groups_.start[row + 1]; ++entry) {
            const auto k = static_cast<std::size_t>(groups_.contact[static_cast<std::size_t>(entry)]);
            if (links_[k].first == links_[k].second) {  // its own image: listed twice
                all.tail<3>() += 0.5 * (change[k].segment<3>(3) + change[k].tail<3>());
            } else if (links_[k].first == particle) {
                all.head<3>() -= change[k].head<3>();
                all.tail<3>() += change[k].segment<3>(3);
            } else {
                all.head<3>() += change[k].head<3>();
                all.tail<3>() += change[k].tail<3>();
            }
        }
        sum.segment<6>(6 * particle) = all;
    }
    return sum;
}

Slope StiffnessOfContacts::part_of(const Link& link, Convex convex) {
    const Slope part = 0.5 * (link.slope + link.slope.transpose());
    return link.bonded && convex != Convex::all ? part : Slope(dense::nearest_semidefinite(part));
}

void StiffnessOfContacts::for_each_part(Convex convex, const std::function<void(Index, const Slope&)>& visit) const {
    for (const Link& link : links_) {
        visit(link.contact, part_of(link, convex));
    }
}

BlockMatrix StiffnessOfContacts::symmetric_part(Convex convex) const {
    static const Ends first = along_first_end();
    static const Ends second = along_second_end();
    std::vector<Slope> parts(links_.size());
    const auto count = static_cast<Index>(links_.size());
#pragma omp parallel for schedule(static) if (worth_threads(count, 1000))
    for (Index k = 0; k < count; ++k) {
        parts[static_cast<std::size_t>(k)] = part_of(links_[static_cast<std::size_t>(k)], convex);
    }
    BlockMatrix matrix;
    matrix.start.push_back(0);
    for (Index particle = 0; particle < particles_; ++particle) {
        std::vector<std::pair<Index, Block>> row{{particle, Block::Zero()}};
        const auto at = static_cast<std::size_t>(particle);
        for (Index entry = groups_.start[at]; entry < groups_.start[at + 1]; ++entry) {
            const Link& link = links_[static_cast<std::size_t>(groups_.contact[static_cast<std::size_t>(entry)])];
            const Slope& part = parts[static_cast<std::size_t>(groups_.contact[static_cast<std::size_t>(entry)])];
            if (link.first == link.second) {
                row.front().second += 0.5 * (first + second).transpose() * part * (first + second);
                continue;
            }
            const bool is_first = link.first == particle;
            const Ends& here = is_first ? first : second;
            const Ends& there = is_first ? second : first;
            const Index other = is_first ? link.second : link.first;
            row.front().second += here.transpose() * part * here;
            if (other > particle) {
                row.emplace_back(other, here.transpose() * part * there);
            }
        }
        append_row(row, matrix);
    }
    return matrix;
}

}  // namespace coagula::mechanics
