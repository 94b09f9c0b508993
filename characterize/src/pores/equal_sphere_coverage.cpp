// SPDX-License-Identifier: GPL-3.0-or-later
#include "coverage.hpp"
#include "geometry/arc_terms.hpp"

#include <vector>

namespace coagula::characterize {

namespace {

/// Sums of volume_inside_ball over many orthoschemes at all radii of a grid. All cases of that function but one are polynomials in
/// rho: their coefficients are kept as differences that set in at a radius. Only d1 < rho < d2 is evaluated radius by radius.
class RadialSums {
public:
    explicit RadialSums(const RadialGrid& grid) : grid_(grid), coefficients_(3, grid.count + 1), arcs_(grid.count) {
        coefficients_.setZero();
        arcs_.setZero();
    }

    /// Adds the orthoschemes of the counted sites around one edge. The two sites of a side see mirror images.
    void add(const EdgeGeometry& edge, const std::array<int, 3>& counted) {
        ArcSides sides;
        for (std::size_t k = 0; k < 3; ++k) {
            const EdgeSide& side = edge.sides[k];
            const int sites = counted[static_cast<std::size_t>(side.first)] + counted[static_cast<std::size_t>(side.second)];
            sides.a[k] = side.first_distance;
            sides.b[k] = std::abs(side.foot_distance);
            sides.weight[k] = sites * sign(side.foot_distance);
        }
        sides.d1 = std::sqrt(sides.a[0] * sides.a[0] + sides.b[0] * sides.b[0]);
        const std::array<double, 2> heights = {std::abs(edge.height[0]), std::abs(edge.height[1])};
        const OrthoschemeAngles angles = orthoscheme_angles(sides, heights);
        for (std::size_t k = 0; k < 6; ++k) {
            const double weight = sides.weight[k / 2] * sign(edge.height[k % 2]);
            if (weight != 0) {
                add_polynomials(sides.a[k / 2], sides.b[k / 2] * heights[k % 2], angles.d2[k], angles.phi[k], angles.psi[k],
                                weight);
            }
        }
        add_arcs(edge, sides);
    }

    void add(const RadialSums& other) {
        coefficients_ += other.coefficients_;
        arcs_ += other.arcs_;
        cells_ += other.cells_;
    }

    double cells() const { return cells_; }

    Eigen::VectorXd covered() const {
        Eigen::VectorXd volume(grid_.count);
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (Index k = 0; k < grid_.count; ++k) {
            sum += coefficients_.col(k);
            const double rho = grid_[k];
            volume[k] = sum[0] + rho * rho * (sum[1] + rho * sum[2]) + arcs_[k];
        }
        return volume;
    }

private:
    void add_polynomials(double a, double bc, double d2, double phi, double psi, double weight) {
        const Eigen::Vector3d within_cone(0, 0, (phi - psi) / 3);
        const Eigen::Vector3d cut_by_plane(-phi * a * a * a / 6, phi * a / 2, -psi / 3);
        const Eigen::Vector3d whole(a * bc / 6, 0, 0);
        coefficients_.col(0) += weight * within_cone;
        coefficients_.col(grid_.first_above(a)) += weight * (cut_by_plane - within_cone);
        coefficients_.col(grid_.first_above(d2)) += weight * (whole - cut_by_plane);
        cells_ += weight * whole[0];
    }

    /// The arc terms do not depend on the heights, and d1 is the same for the three sides: ends on opposite sides of the plane of
    /// the sites cancel up to the smaller d2.
    void add_arcs(const EdgeGeometry& edge, const ArcSides& sides) {
        const double squared_d1 = sides.a[0] * sides.a[0] + sides.b[0] * sides.b[0];
        std::array<Index, 2> last{};
        for (std::size_t which = 0; which < 2; ++which) {
            last[which] = grid_.first_above(std::sqrt(squared_d1 + edge.height[which] * edge.height[which]));
        }
        const std::array<double, 2> signs = {sign(edge.height[0]), sign(edge.height[1])};
        const bool cancel = signs[0] + signs[1] == 0;
        const Index begin = cancel ? std::min(last[0], last[1]) : grid_.first_above(sides.d1);
        const Index end = std::max(last[0], last[1]);
        if (begin >= end) {
            return;
        }
        const auto blocks = static_cast<int>((end - begin + arc_block - 1) / arc_block);
        terms_.resize(std::max(terms_.size(), static_cast<std::size_t>(blocks * arc_block)));
        sum_arc_terms(sides, grid_[begin], grid_.step, blocks, terms_.data());
        for (Index k = begin; k < end; ++k) {
            const double times = (k < last[0] ? signs[0] : 0.0) + (k < last[1] ? signs[1] : 0.0);
            arcs_[k] += times * terms_[static_cast<std::size_t>(k - begin)];
        }
    }

    RadialGrid grid_;
    Eigen::Matrix3Xd coefficients_;  ///< of 1, rho^2, rho^3: changes at each radius
    Eigen::VectorXd arcs_;
    double cells_ = 0;           ///< volume of the whole orthoschemes
    std::vector<double> terms_;  ///< scratch
};

/// Some of the edges around the cells of one block.
struct Task {
    int block = 0;
    std::size_t begin = 0;
    std::size_t end = 0;  ///< in edges_of_block[block]
};

int block_of(const PowerDiagram& diagram, const Blocks& blocks, int site) {
    return diagram.counted[static_cast<std::size_t>(site)] != 0 ? blocks.of_particle[site] : -1;
}

std::vector<std::vector<int>> edges_by_block(const PowerDiagram& diagram, const Blocks& blocks) {
    std::vector<std::vector<int>> lists(static_cast<std::size_t>(blocks.count));
    for (std::size_t edge = 0; edge < diagram.edges.size(); ++edge) {
        for (const int site : diagram.edges[edge].around) {
            const int block = block_of(diagram, blocks, site);
            if (block >= 0) {
                auto& list = lists[static_cast<std::size_t>(block)];
                if (list.empty() || list.back() != static_cast<int>(edge)) {
                    list.push_back(static_cast<int>(edge));
                }
            }
        }
    }
    return lists;
}

/// How many times longer than usual an edge takes.
std::size_t effort(const RadialGrid& radii) {
    constexpr Index usual = 1000;
    return static_cast<std::size_t>(std::max<Index>(1, radii.count / usual));
}

/// Fixed tasks, summed in order: the result does not depend on the number of threads, and rounding errors stay small.
std::vector<Task> make_tasks(const std::vector<std::vector<int>>& lists, const RadialGrid& radii) {
    constexpr std::size_t least_edges = 64;
    constexpr std::size_t most_edges = 8192;
    const std::size_t edges_per_task = std::max(least_edges, most_edges / effort(radii));
    std::vector<Task> tasks;
    for (std::size_t block = 0; block < lists.size(); ++block) {
        const std::size_t parts = (lists[block].size() + edges_per_task - 1) / edges_per_task;
        for (std::size_t part = 0; part < parts; ++part) {
            tasks.push_back(
                {static_cast<int>(block), lists[block].size() * part / parts, lists[block].size() * (part + 1) / parts});
        }
    }
    return tasks;
}

RadialSums run_task(const PowerDiagram& diagram, const Blocks& blocks, const RadialGrid& grid, const std::vector<int>& edges,
                    const Task& task) {
    RadialSums sums(grid);
    for (std::size_t k = task.begin; k < task.end; ++k) {
        const DiagramEdge& edge = diagram.edges[static_cast<std::size_t>(edges[k])];
        std::array<int, 3> counted{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            counted[corner] = block_of(diagram, blocks, edge.around[corner]) == task.block ? 1 : 0;
        }
        sums.add(measure_edge(diagram, edge), counted);
    }
    return sums;
}

}  // namespace

Coverage cover_equal_spheres(const PowerDiagram& diagram, const RadialGrid& ball_radii, const Blocks& blocks,
                             const Progress& progress) {
    const std::vector<std::vector<int>> edges = edges_by_block(diagram, blocks);
    const std::vector<Task> tasks = make_tasks(edges, ball_radii);
    std::vector<RadialSums> total(static_cast<std::size_t>(blocks.count), RadialSums(ball_radii));
    const std::size_t tasks_at_once = std::max<std::size_t>(4, 64 / effort(ball_radii));  // whoever interrupts waits for no more
    for (std::size_t first = 0; first < tasks.size(); first += tasks_at_once) {
        const std::size_t end = std::min(first + tasks_at_once, tasks.size());
        std::vector<RadialSums> partial(end - first, RadialSums(ball_radii));
#pragma omp parallel for schedule(dynamic)
        for (std::size_t task = first; task < end; ++task) {
            const auto block = static_cast<std::size_t>(tasks[task].block);
            partial[task - first] = run_task(diagram, blocks, ball_radii, edges[block], tasks[task]);
        }
        for (std::size_t task = first; task < end; ++task) {
            total[static_cast<std::size_t>(tasks[task].block)].add(partial[task - first]);
        }
        progress.update("pore sizes", 0.3 + 0.7 * static_cast<double>(end) / static_cast<double>(tasks.size()));
    }
    Coverage coverage{Eigen::MatrixXd(ball_radii.count, blocks.count), Eigen::MatrixXd(ball_radii.count, blocks.count)};
    for (Index block = 0; block < blocks.count; ++block) {
        const RadialSums& sums = total[static_cast<std::size_t>(block)];
        coverage.covered.col(block) = sums.covered();
        coverage.cells.col(block).setConstant(sums.cells());
    }
    return coverage;
}

}  // namespace coagula::characterize
