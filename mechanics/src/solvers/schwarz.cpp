// SPDX-License-Identifier: GPL-3.0-or-later
#include "schwarz.hpp"

#include <coagula/common/parallel.hpp>

#include "block_factor.hpp"
#include "single_precision_factor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

namespace coagula::mechanics {

namespace {

/// The six numbers of a PaddedRow.
using SixFloats = Eigen::Map<Eigen::Matrix<float, 1, 6>>;
using SixFloatsRead = Eigen::Map<const Eigen::Matrix<float, 1, 6>>;

/// Regular division of the cell into boxes of about equal edge.
struct Grid {
    std::array<int, 3> count{};

    Grid(const Eigen::Vector3d& lengths, double boxes) {
        const double edge = std::cbrt(lengths.prod() / std::max(1.0, boxes));
        for (int axis = 0; axis < 3; ++axis) {
            count[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(std::lround(lengths[axis] / edge)));
        }
    }
    Index size() const { return static_cast<Index>(count[0]) * count[1] * count[2]; }
    Index number(const std::array<int, 3>& box) const {
        return (static_cast<Index>(box[2] % count[2]) * count[1] + box[1] % count[1]) * count[0] + box[0] % count[0];
    }
    Index box_of(const Eigen::Vector3d& fraction) const {
        std::array<int, 3> box{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box[axis] = std::min(static_cast<int>(fraction[static_cast<Index>(axis)] * count[axis]), count[axis] - 1);
        }
        return number(box);
    }
    std::array<int, 3> place_of(Index box) const {
        return {static_cast<int>(box % count[0]), static_cast<int>(box / count[0] % count[1]),
                static_cast<int>(box / count[0] / count[1])};
    }
    /// How many boxes two of them lie apart, along the axis where that is most.
    int distance(Index one, Index other) const {
        int most = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int apart = std::abs(place_of(one)[axis] - place_of(other)[axis]);
            most = std::max(most, std::min(apart, count[axis] - apart));
        }
        return most;
    }
    /// Boxes at most so far away whose number is not smaller, ascending.
    std::vector<Index> from_here_on(Index box, int reach) const {
        const std::array<int, 3> here = place_of(box);
        std::vector<Index> found;
        for (int z = -std::min(reach, count[2] / 2); z <= std::min(reach, count[2] / 2); ++z) {
            for (int y = -std::min(reach, count[1] / 2); y <= std::min(reach, count[1] / 2); ++y) {
                for (int x = -std::min(reach, count[0] / 2); x <= std::min(reach, count[0] / 2); ++x) {
                    found.push_back(number({here[0] + x + count[0], here[1] + y + count[1], here[2] + z + count[2]}));
                }
            }
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        found.erase(found.begin(), std::lower_bound(found.begin(), found.end(), box));
        return found;
    }
};

/// The first `own` particles in boxes with `overlap` layers of neighbours, each list sorted.
std::vector<std::vector<Index>> overlapping_boxes(const Grid& grid, const BlockMatrix& full, const Eigen::Matrix3Xd& fraction,
                                                  Index own, int overlap) {
    std::vector<std::vector<Index>> boxes(static_cast<std::size_t>(grid.size()));
    for (Index particle = 0; particle < own; ++particle) {
        boxes[static_cast<std::size_t>(grid.box_of(fraction.col(particle)))].push_back(particle);
    }
    std::erase_if(boxes, [](const auto& box) { return box.empty(); });
    for (auto& box : boxes) {
        for (int layer = 0; layer < overlap; ++layer) {
            const std::vector<Index> inner = box;
            for (const Index particle : inner) {
                const auto row = static_cast<std::size_t>(particle);
                box.insert(box.end(), full.column.begin() + full.start[row], full.column.begin() + full.start[row + 1]);
            }
            std::sort(box.begin(), box.end());
            box.erase(std::unique(box.begin(), box.end()), box.end());
        }
    }
    return boxes;
}

/// Rows and columns of a box, renumbered.
BlockMatrix restrict_to(const BlockMatrix& upper, const std::vector<Index>& particles) {
    BlockMatrix local;
    local.start.push_back(0);
    for (std::size_t row = 0; row < particles.size(); ++row) {
        const auto global = static_cast<std::size_t>(particles[row]);
        auto place = particles.begin() + static_cast<std::ptrdiff_t>(row);
        for (auto k = static_cast<std::size_t>(upper.start[global]); k < static_cast<std::size_t>(upper.start[global + 1]); ++k) {
            place = std::lower_bound(place, particles.end(), upper.column[k]);
            if (place != particles.end() && *place == upper.column[k]) {
                local.column.push_back(place - particles.begin());
                local.block.push_back(upper.block[k]);
            }
        }
        local.start.push_back(static_cast<Index>(local.column.size()));
    }
    return local;
}

/// One particle's share in the eight grid nodes around it (trilinear).
struct Weights {
    std::array<Index, 8> node{};
    std::array<double, 8> weight{};
};

Weights trilinear(const Grid& grid, const Eigen::Vector3d& fraction) {
    std::array<int, 3> low{};
    std::array<double, 3> part{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double place = fraction[static_cast<Index>(axis)] * grid.count[axis];
        low[axis] = static_cast<int>(std::floor(place));
        part[axis] = place - low[axis];
    }
    Weights weights;
    for (std::size_t corner = 0; corner < 8; ++corner) {
        std::array<int, 3> node = low;
        double weight = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool upper = ((corner >> axis) & 1U) != 0;
            node[axis] += upper ? 1 : 0;
            weight *= upper ? part[axis] : 1 - part[axis];
        }
        weights.node[corner] = grid.number(node);
        weights.weight[corner] = weight;
    }
    return weights;
}

}  // namespace

struct SchwarzPreconditioner::Box {
    std::vector<Index> particles;  ///< in the order of elimination, once there is a factor
    std::unique_ptr<SinglePrecisionFactor> factor;
    mutable std::vector<PaddedRow> motion;  ///< of the last solution, in that order
};

struct SchwarzPreconditioner::Coarse {
    std::vector<Weights> weights;  ///< one per particle
    std::unique_ptr<CholeskyFactor> factor;
    Index nodes = 0;
};

namespace {

/// Z^T K Z for the trilinear coarse motion: blocks between nodes, from the first `own` rows of K.
BlockMatrix coarse_matrix(const BlockMatrix& full, const std::vector<Weights>& weights, Index own, Index nodes) {
    std::vector<std::vector<std::pair<Index, Block>>> rows(static_cast<std::size_t>(nodes));
    for (Index node = 0; node < nodes; ++node) {
        rows[static_cast<std::size_t>(node)].emplace_back(node, Block::Zero());
    }
    const auto add = [&](Index row, Index column, const Block& block) {
        auto& entries = rows[static_cast<std::size_t>(row)];
        auto place =
            std::lower_bound(entries.begin(), entries.end(), column, [](const auto& entry, Index c) { return entry.first < c; });
        if (place == entries.end() || place->first != column) {
            place = entries.insert(place, {column, Block::Zero()});
        }
        place->second += block;
    };
    for (Index row = 0; row < own; ++row) {
        const Weights& left = weights[static_cast<std::size_t>(row)];
        for (auto k = static_cast<std::size_t>(full.start[static_cast<std::size_t>(row)]);
             k < static_cast<std::size_t>(full.start[static_cast<std::size_t>(row) + 1]); ++k) {
            const Weights& right = weights[static_cast<std::size_t>(full.column[k])];
            for (std::size_t p = 0; p < 8; ++p) {
                for (std::size_t q = 0; q < 8; ++q) {
                    if (right.node[q] >= left.node[p]) {
                        add(left.node[p], right.node[q], left.weight[p] * right.weight[q] * full.block[k]);
                    }
                }
            }
        }
    }
    BlockMatrix matrix;
    matrix.start.push_back(0);
    for (const auto& entries : rows) {
        for (const auto& [column, block] : entries) {
            matrix.column.push_back(column);
            matrix.block.push_back(block);
        }
        matrix.start.push_back(static_cast<Index>(matrix.column.size()));
    }
    return matrix;
}

/// How far apart two nodes with a block lie at most, in any of the processes.
int reach_of(const BlockMatrix& matrix, const Grid& grid, const SharedPart& part) {
    std::vector<double> seen(1 + static_cast<std::size_t>(*std::max_element(grid.count.begin(), grid.count.end())) / 2, 0.0);
    for (Index node = 0; node < matrix.rows(); ++node) {
        for (auto k = static_cast<std::size_t>(matrix.start[static_cast<std::size_t>(node)]);
             k < static_cast<std::size_t>(matrix.start[static_cast<std::size_t>(node) + 1]); ++k) {
            seen[static_cast<std::size_t>(grid.distance(node, matrix.column[k]))] = 1;
        }
    }
    part.sum(seen.data(), static_cast<Index>(seen.size()));
    return static_cast<int>(std::find_if(seen.rbegin(), seen.rend(), [](double count) { return count > 0; }).base() -
                            seen.begin()) -
           1;
}

/// The sum of the matrices of all processes.
BlockMatrix summed(const BlockMatrix& matrix, const Grid& grid, const SharedPart& part) {
    const int reach = reach_of(matrix, grid, part);
    BlockMatrix all;
    all.start.push_back(0);
    for (Index node = 0; node < grid.size(); ++node) {
        const std::vector<Index> near = grid.from_here_on(node, reach);
        const std::size_t begin = all.column.size();
        all.column.insert(all.column.end(), near.begin(), near.end());
        all.block.resize(all.column.size(), Block::Zero());
        for (auto k = static_cast<std::size_t>(matrix.start[static_cast<std::size_t>(node)]);
             k < static_cast<std::size_t>(matrix.start[static_cast<std::size_t>(node) + 1]); ++k) {
            const auto place = std::lower_bound(near.begin(), near.end(), matrix.column[k]);
            all.block[begin + static_cast<std::size_t>(place - near.begin())] = matrix.block[k];
        }
        all.start.push_back(static_cast<Index>(all.column.size()));
    }
    part.sum(all.block.front().data(), 36 * static_cast<Index>(all.block.size()));
    return all;
}

}  // namespace

SchwarzPreconditioner::SchwarzPreconditioner(const BlockMatrix& upper, const BlockMatrix& full, const Eigen::Matrix3Xd& fraction,
                                             const Eigen::Vector3d& lengths, const SchwarzOptions& options,
                                             const Progress& progress)
    : SchwarzPreconditioner(upper, full, fraction, lengths, options, progress,
                            {.own = fraction.cols(), .all = fraction.cols(), .sum = {}}) {}

SchwarzPreconditioner::SchwarzPreconditioner(const BlockMatrix& upper, const BlockMatrix& full, const Eigen::Matrix3Xd& fraction,
                                             const Eigen::Vector3d& lengths, const SchwarzOptions& options,
                                             const Progress& progress, SharedPart part)
    : part_(std::move(part)) {
    const Grid grid(lengths, static_cast<double>(part_.all) / options.particles_per_box);
    for (auto& particles : overlapping_boxes(grid, full, fraction, part_.own, options.overlap)) {
        boxes_.push_back(std::make_unique<Box>());
        boxes_.back()->particles = std::move(particles);
    }
    factorise_boxes(upper, options, progress);
    list_copies(fraction.cols());

    coarse_ = std::make_unique<Coarse>();
    coarse_->nodes = grid.size();
    for (Index particle = 0; particle < fraction.cols(); ++particle) {
        coarse_->weights.push_back(trilinear(grid, fraction.col(particle)));
    }
    BlockMatrix coarse = coarse_matrix(full, coarse_->weights, part_.own, coarse_->nodes);
    if (part_.sum) {
        coarse = summed(coarse, grid, part_);
    }
    coarse_->factor = std::make_unique<CholeskyFactor>(shifted(coarse, options.shift * options.particles_per_box),
                                                       elimination_order(coarse, Ordering::nested_dissection));
}

void SchwarzPreconditioner::list_copies(Index particles) {
    copy_start_.assign(static_cast<std::size_t>(particles) + 1, 0);
    for (const auto& box : boxes_) {
        for (const Index particle : box->particles) {
            ++copy_start_[static_cast<std::size_t>(particle) + 1];
        }
    }
    std::partial_sum(copy_start_.begin(), copy_start_.end(), copy_start_.begin());
    copy_.resize(static_cast<std::size_t>(copy_start_.back()));
    std::vector<Index> next(copy_start_.begin(), copy_start_.end() - 1);
    for (std::size_t b = 0; b < boxes_.size(); ++b) {
        Index place = 0;
        for (const Index particle : boxes_[b]->particles) {
            copy_[static_cast<std::size_t>(next[static_cast<std::size_t>(particle)]++)] = {static_cast<Index>(b), place++};
        }
    }
}

void SchwarzPreconditioner::factorise_boxes(const BlockMatrix& upper, const SchwarzOptions& options, const Progress& progress) {
    constexpr std::size_t batch = 64;  // between two looks at the progress callback
    for (std::size_t begin = 0; begin < boxes_.size(); begin += batch) {
        progress.update("factorising", static_cast<double>(begin) / static_cast<double>(boxes_.size()));
        const std::size_t end = std::min(begin + batch, boxes_.size());
        run_together(end - begin, [&](std::size_t place) {
            const std::size_t b = begin + place;
            Box& box = *boxes_[b];
            const BlockMatrix local = restrict_to(upper, box.particles);
            const EliminationOrder order = elimination_order(local, Ordering::minimum_degree);
            box.factor = std::make_unique<SinglePrecisionFactor>(local, options.shift, order);
            std::vector<Index> eliminated = box.factor->order();
            for (Index& particle : eliminated) {
                particle = box.particles[static_cast<std::size_t>(particle)];
            }
            box.particles = std::move(eliminated);
            box.motion.resize(6 * box.particles.size());
        });
    }
}

SchwarzPreconditioner::~SchwarzPreconditioner() = default;

void SchwarzPreconditioner::solve(const Loads& r, Loads& z) const {
    const auto particles = static_cast<Index>(copy_start_.size()) - 1;
    Loads coarse_load = Loads::Zero(6 * coarse_->nodes, 6);
    for (Index particle = 0; particle < part_.own; ++particle) {
        const Weights& weights = coarse_->weights[static_cast<std::size_t>(particle)];
        for (std::size_t corner = 0; corner < 8; ++corner) {
            coarse_load.middleRows<6>(6 * weights.node[corner]) += weights.weight[corner] * r.middleRows<6>(6 * particle);
        }
    }
    if (part_.sum) {
        part_.sum(coarse_load.data(), coarse_load.size());
    }
    Loads coarse_motion;
    coarse_motion = coarse_->factor->solve(coarse_load);
#pragma omp parallel for schedule(dynamic)
    for (const auto& box : boxes_) {
        for (std::size_t row = 0; row < box->motion.size(); ++row) {
            const Index source = 6 * box->particles[row / 6] + static_cast<Index>(row % 6);
            SixFloats(box->motion[row].value.data()) = r.row(source).cast<float>();
        }
        box->factor->solve(box->motion);
    }
    z.resize(r.rows(), 6);
#pragma omp parallel for schedule(static)
    for (Index particle = 0; particle < particles; ++particle) {
        Eigen::Matrix<double, 6, 6, Eigen::RowMajor> sum = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>::Zero();
        for (Index copy = copy_start_[static_cast<std::size_t>(particle)];
             copy < copy_start_[static_cast<std::size_t>(particle) + 1]; ++copy) {
            const auto [box, place] = copy_[static_cast<std::size_t>(copy)];
            const PaddedRow* row = boxes_[static_cast<std::size_t>(box)]->motion.data() + 6 * place;
            for (Index component = 0; component < 6; ++component, ++row) {
                sum.row(component) += SixFloatsRead(row->value.data()).cast<double>();
            }
        }
        const Weights& weights = coarse_->weights[static_cast<std::size_t>(particle)];
        for (std::size_t corner = 0; corner < 8 && particle < part_.own; ++corner) {
            sum += weights.weight[corner] * coarse_motion.middleRows<6>(6 * weights.node[corner]);
        }
        z.middleRows<6>(6 * particle) = sum;
    }
}

}  // namespace coagula::mechanics
