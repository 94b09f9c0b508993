// SPDX-License-Identifier: GPL-3.0-or-later
#include "pore_conduction.hpp"

#include <coagula/common/checks.hpp>

#include "voxel_rows.hpp"

namespace coagula::characterize {

namespace {

/// Fewer voxels are not worth the start of threads.
bool is_large(const Eigen::Array3i& count) {
    return count.prod() > 30000;
}

/// The rows of a grid, with one value per voxel.
class Rows {
public:
    Rows(const FaceConductances& g, const Eigen::ArrayXf& value) : g_(g), value_(value.data()) {}

    /// Number of the first voxel.
    Index home(int y, int z) const { return (static_cast<Index>(z) * g_.count[1] + y) * g_.count[0]; }

    VoxelRow operator()(int y, int z) const {
        const Eigen::Array3i& n = g_.count;
        const Index here = home(y, z);
        const Index front = home(y == 0 ? n[1] - 1 : y - 1, z), back = home(y + 1 == n[1] ? 0 : y + 1, z);
        const Index below = home(y, z == 0 ? n[2] - 1 : z - 1), above = home(y, z + 1 == n[2] ? 0 : z + 1);
        const auto& [gx, gy, gz] = g_.of_face;
        return {.count = n[0],
                .gx = gx.data() + here,
                .gy = gy.data() + here,
                .gy_front = gy.data() + front,
                .gz = gz.data() + here,
                .gz_below = gz.data() + below,
                .here = value_ + here,
                .front = value_ + front,
                .back = value_ + back,
                .below = value_ + below,
                .above = value_ + above};
    }

private:
    const FaceConductances& g_;
    const float* value_;
};

/// Calls visit(y, z, scratch) for each row; scratch has room for a row.
template <class Visit>
void for_rows(const Eigen::Array3i& n, Visit&& visit) {
#pragma omp parallel if (is_large(n))
    {
        std::vector<float> scratch(static_cast<std::size_t>(n[0]));
#pragma omp for schedule(static)
        for (int z = 0; z < n[2]; ++z) {
            for (int y = 0; y < n[1]; ++y) {
                visit(y, z, scratch.data());
            }
        }
    }
}

Eigen::ArrayXf diagonal_of(const FaceConductances& g) {
    Eigen::ArrayXf diagonal(g.of_face[0].size());
    const Eigen::ArrayXf ones = Eigen::ArrayXf::Ones(diagonal.size());
    const Rows rows(g, ones);
    for_rows(g.count, [&](int y, int z, float*) { sum_neighbours(rows(y, z), diagonal.data() + rows.home(y, z)); });
    return diagonal;
}

/// First voxel of a row that has this colour, odd or even x + y + z.
int first_of_colour(int colour, int y, int z) {
    return (y + z + colour) & 1;
}

/// Gauss-Seidel on the voxels of one colour, which have neighbours of the other only.
void relax(const FaceConductances& g, const Eigen::ArrayXf& inverse_diagonal, const Eigen::ArrayXf& right_side, int colour,
           Eigen::ArrayXf& u) {
    const Rows rows(g, u);
    for_rows(g.count, [&](int y, int z, float* sum) {
        const int first = first_of_colour(colour, y, z);
        const Index home = rows.home(y, z);
        sum_neighbours_of_colour(rows(y, z), first, sum);
        for (int x = first; x < g.count[0]; x += 2) {
            u[home + x] = (right_side[home + x] + sum[x]) * inverse_diagonal[home + x];
        }
    });
}

/// Conductances between blocks of 2 x 2 x 2: four faces side by side, over twice the distance.
FaceConductances coarsen(const FaceConductances& fine) {
    FaceConductances coarse{fine.count / 2, {}};
    for (auto& face : coarse.of_face) {
        face = Eigen::ArrayXf::Zero(fine.of_face[0].size() / 8);
    }
    Index voxel = 0;
    for (int z = 0; z < fine.count[2]; ++z) {
        for (int y = 0; y < fine.count[1]; ++y) {
            const Index parents = (static_cast<Index>(z / 2) * coarse.count[1] + y / 2) * coarse.count[0];
            for (int x = 0; x < fine.count[0]; ++x, ++voxel) {
                const Index parent = parents + x / 2;
                coarse.of_face[0][parent] += (x & 1) != 0 ? fine.of_face[0][voxel] / 2 : 0.0F;
                coarse.of_face[1][parent] += (y & 1) != 0 ? fine.of_face[1][voxel] / 2 : 0.0F;
                coarse.of_face[2][parent] += (z & 1) != 0 ? fine.of_face[2][voxel] / 2 : 0.0F;
            }
        }
    }
    return coarse;
}

/// What colour 0 and then colour 1 of Gauss-Seidel from zero on leave, summed over blocks of 2 x 2 x 2. Nothing is left at colour
/// 1, and at colour 0 what the new values of colour 1 bring.
Eigen::ArrayXf restrict_rest(const FaceConductances& g, const Eigen::ArrayXf& u) {
    const Eigen::Array3i n = g.count / 2;
    Eigen::ArrayXf left = Eigen::ArrayXf::Zero(u.size() / 8);
    const Rows rows(g, u);
    for_rows(n, [&](int parent_y, int parent_z, float*) {
        std::vector<float> sum(static_cast<std::size_t>(g.count[0]));
        float* parent = left.data() + (static_cast<Index>(parent_z) * n[1] + parent_y) * n[0];
        for (int child = 0; child < 4; ++child) {
            const int y = 2 * parent_y + (child & 1);
            const int z = 2 * parent_z + child / 2;
            const int first = first_of_colour(0, y, z);
            sum_neighbours_of_colour(rows(y, z), first, sum.data());
            for (int x = 0; x < n[0]; ++x) {
                const int child_x = 2 * x + first;
                parent[x] += sum[static_cast<std::size_t>(child_x)];
            }
        }
    });
    return left;
}

/// Adds to each voxel what its block of 2 x 2 x 2 has.
void prolong(const Eigen::Array3i& count, const Eigen::ArrayXf& correction, Eigen::ArrayXf& u) {
    for_rows(count, [&](int y, int z, float*) {
        const float* parent = correction.data() + (static_cast<Index>(z / 2) * (count[1] / 2) + y / 2) * (count[0] / 2);
        float* child = u.data() + (static_cast<Index>(z) * count[1] + y) * count[0];
        for (int x = 0; x < count[0] / 2; ++x) {
            child[0] += parent[x];
            child[1] += parent[x];
            child += 2;
        }
    });
}

/// Sum of products in an order that does not depend on the number of threads.
double dot(const Eigen::ArrayXf& a, const Eigen::ArrayXf& b) {
    constexpr Index chunk = 65536;
    const Index chunks = (a.size() + chunk - 1) / chunk;
    Eigen::ArrayXd partial(chunks);
#pragma omp parallel for schedule(static) if (chunks > 1)
    for (Index k = 0; k < chunks; ++k) {
        const Index count = std::min(chunk, a.size() - k * chunk);
        partial[k] = (a.segment(k * chunk, count).cast<double>() * b.segment(k * chunk, count).cast<double>()).sum();
    }
    return partial.sum();
}

/// The flux that a unit gradient alone would leave in each voxel.
Eigen::ArrayXf flux_left(const FaceConductances& g, int axis, double spacing) {
    const Eigen::ArrayXf& faces = g.of_face[static_cast<std::size_t>(axis)];
    const Eigen::Array3i& n = g.count;
    const auto width = static_cast<float>(spacing);
    Eigen::ArrayXf left(faces.size());
    for_rows(n, [&](int y, int z, float*) {
        for (int x = 0; x < n[0]; ++x) {
            Eigen::Array3i before(x, y, z);
            before[axis] = before[axis] == 0 ? n[axis] - 1 : before[axis] - 1;
            const Index here = (static_cast<Index>(z) * n[1] + y) * n[0] + x;
            left[here] = width * (faces[here] - faces[(static_cast<Index>(before[2]) * n[1] + before[1]) * n[0] + before[0]]);
        }
    });
    return left;
}

}  // namespace

FaceConductances face_conductances(const VoxelGrid& grid, const OpenFaces& faces) {
    FaceConductances conductances{grid.count, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double edge = grid.edge[static_cast<Index>(axis)];
        const double whole = grid.edge.prod() / (edge * edge);
        conductances.of_face[axis] =
            (whole * Eigen::Map<const Eigen::ArrayXd>(faces[axis].data(), std::ssize(faces[axis]))).cast<float>();
    }
    return conductances;
}

ConductionSolver::ConductionSolver(FaceConductances conductances) {
    while (true) {
        Eigen::ArrayXf diagonal = diagonal_of(conductances);
        diagonal = (diagonal > 0).select(diagonal.inverse(), 0.0F);
        levels_.push_back({std::move(conductances), std::move(diagonal)});
        const Eigen::Array3i& n = levels_.back().conductances.count;
        if ((n < 4).any() || (n.unaryExpr([](int k) { return k & 1; }) != 0).any()) {
            return;
        }
        conductances = coarsen(levels_.back().conductances);
    }
}

/// A V-cycle; both colours before and, in the opposite order, after, so that it is symmetric.
Eigen::ArrayXf ConductionSolver::precondition(std::size_t level, const Eigen::ArrayXf& residual) const {
    const auto& [g, inverse_diagonal] = levels_[level];
    Eigen::ArrayXf u = residual * inverse_diagonal;
    relax(g, inverse_diagonal, residual, 1, u);
    if (level + 1 == levels_.size()) {
        for (int sweep = 0; sweep < 10; ++sweep) {
            relax(g, inverse_diagonal, residual, 0, u);
            relax(g, inverse_diagonal, residual, 1, u);
        }
    } else {
        prolong(g.count, precondition(level + 1, restrict_rest(g, u)), u);
    }
    relax(g, inverse_diagonal, residual, 1, u);
    relax(g, inverse_diagonal, residual, 0, u);
    return u;
}

Eigen::ArrayXf ConductionSolver::solve(int axis, double spacing, double tolerance) const {
    const FaceConductances& g = levels_.front().conductances;
    const Eigen::ArrayXf& inverse_diagonal = levels_.front().inverse_diagonal;
    const Eigen::ArrayXf diagonal = (inverse_diagonal > 0).select(inverse_diagonal.inverse(), 0.0F);
    Eigen::ArrayXf residual = flux_left(g, axis, spacing);
    Eigen::ArrayXf u = Eigen::ArrayXf::Zero(residual.size());
    Eigen::ArrayXf direction = precondition(0, residual);
    Eigen::ArrayXf applied(u.size());
    double steep = dot(residual, direction);
    const double goal = tolerance * tolerance * steep;
    constexpr int most = 500;
    for (int iteration = 0; iteration < most && steep > goal; ++iteration) {
        const Rows rows(g, direction);
        for_rows(g.count, [&](int y, int z, float* sum) {
            sum_neighbours(rows(y, z), sum);
            for (Index x = 0, here = rows.home(y, z); x < g.count[0]; ++x, ++here) {
                applied[here] = diagonal[here] * direction[here] - sum[x];
            }
        });
        const auto step = static_cast<float>(steep / dot(direction, applied));
        u += step * direction;
        residual -= step * applied;
        const Eigen::ArrayXf next = precondition(0, residual);
        const double now = dot(residual, next);
        direction = next + static_cast<float>(now / steep) * direction;
        steep = now;
    }
    if (steep > goal) {
        throw std::runtime_error("Laplace's equation in the pores was not solved after " + std::to_string(most) + " iterations");
    }
    return u;
}

double ConductionSolver::power(const FaceConductances& conductances, const Eigen::ArrayXf& potential, int axis, double spacing) {
    const FaceConductances& g = conductances;
    std::array<double, 3> applied{};
    applied[static_cast<std::size_t>(axis)] = spacing;
    const Rows rows(g, potential);
    Eigen::ArrayXd of_row(static_cast<Index>(g.count[1]) * g.count[2]);
    for_rows(g.count,
             [&](int y, int z, float*) { of_row[static_cast<Index>(z) * g.count[1] + y] = row_power(rows(y, z), applied); });
    return of_row.sum();
}

}  // namespace coagula::characterize
