// SPDX-License-Identifier: GPL-3.0-or-later
#include "local_motions.hpp"

#include <coagula/common/dense.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace coagula::characterize {

namespace {

constexpr std::size_t many_neighbours = 12;
constexpr double no_stiffness = 1e-9;  // that of a contact is 1

using Block = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;

class LocalElimination {
public:
    explicit LocalElimination(const RigidityMatrix& matrix)
        : freedoms_(matrix.freedoms()),
          diagonal_(static_cast<std::size_t>(matrix.particles()), Block::Zero(freedoms_, freedoms_)),
          beside_(diagonal_.size()),
          pinned_(static_cast<std::size_t>(matrix.unknowns()), false) {
        for (Index contact = 0; contact < matrix.contacts(); ++contact) {
            for (int a = 0; a < 2; ++a) {
                for (int b = 0; b < 2; ++b) {
                    add(static_cast<int>(matrix.particle(contact, a)), static_cast<int>(matrix.particle(contact, b)),
                        matrix.end(contact, a).transpose() * matrix.end(contact, b));
                }
            }
        }
    }

    std::vector<bool> run(bool turns) {
        for (std::size_t particle = 0; particle < beside_.size(); ++particle) {
            queue_.insert({beside_[particle].size(), static_cast<int>(particle)});
        }
        while (!queue_.empty() && queue_.begin()->first <= many_neighbours) {
            eliminate(queue_.begin()->second);
        }
        hold_the_rest(turns);
        return std::move(pinned_);
    }

private:
    void add(int row, int column, const Block& block) {
        if (row == column) {
            diagonal_[static_cast<std::size_t>(row)] += block;
            return;
        }
        const auto [place, is_new] = beside_[static_cast<std::size_t>(row)].try_emplace(column, block);
        if (!is_new) {
            place->second += block;
        }
    }

    void eliminate(int particle) {
        const auto here = static_cast<std::size_t>(particle);
        queue_.erase({beside_[here].size(), particle});
        const std::vector<Index> free = pin_soft(particle);
        const std::map<int, Block> neighbours = std::move(beside_[here]);
        beside_[here].clear();
        for (const auto& [other, block] : neighbours) {
            queue_.erase({beside_[static_cast<std::size_t>(other)].size(), other});
            beside_[static_cast<std::size_t>(other)].erase(particle);
        }
        if (!free.empty()) {
            condense(diagonal_[here](free, free), free, neighbours);
        }
        for (const auto& [other, block] : neighbours) {
            queue_.insert({beside_[static_cast<std::size_t>(other)].size(), other});
        }
    }

    /// The stiffness between the neighbours that goes through the free unknowns of a particle.
    void condense(const Block& stiffness, const std::vector<Index>& free, const std::map<int, Block>& neighbours) {
        const Eigen::LLT<Block> factor(stiffness);
        for (const auto& [column, right] : neighbours) {
            const Block answer = factor.solve(right(free, Eigen::all));
            for (const auto& [row, left] : neighbours) {
                add(row, column, -left(free, Eigen::all).transpose() * answer);
            }
        }
    }

    /// Pins as many unknowns as the particle has directions without stiffness, those that span them best; returns the others.
    std::vector<Index> pin_soft(int particle) {
        const dense::SymmetricModes modes(diagonal_[static_cast<std::size_t>(particle)]);
        const Index soft = (modes.values.array() < no_stiffness).count();
        if (soft > 0) {
            const Eigen::VectorXi best = dense::PivotedQr(modes.vectors.leftCols(soft).transpose()).order;
            for (Index k = 0; k < soft; ++k) {
                pin(particle, best[k]);
            }
        }
        std::vector<Index> free;
        for (Index k = 0; k < freedoms_; ++k) {
            if (!pinned_[static_cast<std::size_t>(freedoms_ * particle + k)]) {
                free.push_back(k);
            }
        }
        return free;
    }

    void pin(int particle, Index freedom) { pinned_[static_cast<std::size_t>(freedoms_ * particle + freedom)] = true; }

    void hold_the_rest(bool turns) {
        std::vector<bool> seen(beside_.size(), false);
        for (const auto& [count, first] : queue_) {
            if (seen[static_cast<std::size_t>(first)]) {
                continue;
            }
            for (Index k = 0; k < (turns ? freedoms_ : 3); ++k) {
                pin(first, k);
            }
            std::vector<int> reached = {first};
            seen[static_cast<std::size_t>(first)] = true;
            while (!reached.empty()) {
                const int here = reached.back();
                reached.pop_back();
                for (const auto& [other, block] : beside_[static_cast<std::size_t>(here)]) {
                    if (!seen[static_cast<std::size_t>(other)]) {
                        seen[static_cast<std::size_t>(other)] = true;
                        reached.push_back(other);
                    }
                }
            }
        }
    }

    Index freedoms_;
    std::vector<Block> diagonal_;
    std::vector<std::map<int, Block>> beside_;  ///< entries of A^T A by neighbour; both triangles
    std::vector<bool> pinned_;
    std::set<std::pair<std::size_t, int>> queue_;  ///< particles not eliminated, by number of neighbours
};

}  // namespace

std::vector<bool> guess_pinned(const RigidityMatrix& matrix, bool turns) {
    return LocalElimination(matrix).run(turns);
}

}  // namespace coagula::characterize
