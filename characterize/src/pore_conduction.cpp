#include "pore_conduction.hpp"

#include <coagula/common/checks.hpp>

namespace coagula::characterize {

namespace {

/// Fewer voxels are not worth the start of threads.
bool is_large(const Eigen::Array3i& count) {
    return count.prod() > 30000;
}

/// Calls visit(voxel, neighbours -x +x -y +y -z +z) for the voxels of one row; those of odd or even x + y + z only, if step is 2.
template <class Visit>
void for_row(const Eigen::Array3i& n, int y, int z, int first, int step, Visit&& visit) {
    const auto row = [&](int ry, int rz) { return (static_cast<Index>(rz) * n[1] + ry) * n[0]; };
    const Index home = row(y, z);
    const Index below_y = row(y == 0 ? n[1] - 1 : y - 1, z), above_y = row(y + 1 == n[1] ? 0 : y + 1, z);
    const Index below_z = row(y, z == 0 ? n[2] - 1 : z - 1), above_z = row(y, z + 1 == n[2] ? 0 : z + 1);
    for (int x = first; x < n[0]; x += step) {
        const Index left = home + (x == 0 ? n[0] - 1 : x - 1), right = home + (x + 1 == n[0] ? 0 : x + 1);
        visit(home + x, left, right, below_y + x, above_y + x, below_z + x, above_z + x);
    }
}

template <class Visit>
void for_all(const Eigen::Array3i& n, Visit&& visit) {
#pragma omp parallel for schedule(static) if (is_large(n))
    for (int z = 0; z < n[2]; ++z) {
        for (int y = 0; y < n[1]; ++y) {
            for_row(n, y, z, 0, 1, visit);
        }
    }
}

/// Sum of conductance times neighbour.
struct NeighbourSum {
    const double *gx, *gy, *gz, *u;

    NeighbourSum(const FaceConductances& g, const Eigen::ArrayXd& potential)
        : gx(g.of_face[0].data()), gy(g.of_face[1].data()), gz(g.of_face[2].data()), u(potential.data()) {}

    double operator()(Index here, Index left, Index right, Index front, Index back, Index below, Index above) const {
        return gx[left] * u[left] + gx[here] * u[right] + gy[front] * u[front] + gy[here] * u[back] + gz[below] * u[below] +
               gz[here] * u[above];
    }
};

Eigen::ArrayXd diagonal_of(const FaceConductances& g) {
    Eigen::ArrayXd diagonal(g.of_face[0].size());
    const Eigen::ArrayXd ones = Eigen::ArrayXd::Ones(diagonal.size());
    const NeighbourSum sum(g, ones);
    for_all(g.count, [&](Index here, auto... neighbours) { diagonal[here] = sum(here, neighbours...); });
    return diagonal;
}

/// Gauss-Seidel on the voxels of one colour, which have neighbours of the other only.
void relax(const FaceConductances& g, const Eigen::ArrayXd& inverse_diagonal, const Eigen::ArrayXd& right_side, int colour,
           Eigen::ArrayXd& u) {
    const NeighbourSum sum(g, u);
#pragma omp parallel for schedule(static) if (is_large(g.count))
    for (int z = 0; z < g.count[2]; ++z) {
        for (int y = 0; y < g.count[1]; ++y) {
            for_row(g.count, y, z, (y + z + colour) & 1, 2, [&](Index here, auto... neighbours) {
                u[here] = (right_side[here] + sum(here, neighbours...)) * inverse_diagonal[here];
            });
        }
    }
}

Index parent_of(const Eigen::Array3i& coarse, int x, int y, int z) {
    return (static_cast<Index>(z / 2) * coarse[1] + y / 2) * coarse[0] + x / 2;
}

/// Conductances between blocks of 2 x 2 x 2: four faces side by side, over twice the distance.
FaceConductances coarsen(const FaceConductances& fine) {
    FaceConductances coarse{fine.count / 2, {}};
    for (auto& face : coarse.of_face) {
        face = Eigen::ArrayXd::Zero(fine.of_face[0].size() / 8);
    }
    Index voxel = 0;
    for (int z = 0; z < fine.count[2]; ++z) {
        for (int y = 0; y < fine.count[1]; ++y) {
            for (int x = 0; x < fine.count[0]; ++x, ++voxel) {
                const Index parent = parent_of(coarse.count, x, y, z);
                coarse.of_face[0][parent] += (x & 1) != 0 ? fine.of_face[0][voxel] / 2 : 0.0;
                coarse.of_face[1][parent] += (y & 1) != 0 ? fine.of_face[1][voxel] / 2 : 0.0;
                coarse.of_face[2][parent] += (z & 1) != 0 ? fine.of_face[2][voxel] / 2 : 0.0;
            }
        }
    }
    return coarse;
}

/// Sum of products in an order that does not depend on the number of threads.
double dot(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    constexpr Index chunk = 65536;
    const Index chunks = (a.size() + chunk - 1) / chunk;
    Eigen::ArrayXd partial(chunks);
#pragma omp parallel for schedule(static) if (chunks > 1)
    for (Index k = 0; k < chunks; ++k) {
        const Index count = std::min(chunk, a.size() - k * chunk);
        partial[k] = (a.segment(k * chunk, count) * b.segment(k * chunk, count)).sum();
    }
    return partial.sum();
}

}  // namespace

FaceConductances face_conductances(const VoxelGrid& grid, const OpenFaces& faces) {
    FaceConductances conductances{grid.count, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double edge = grid.edge[static_cast<Index>(axis)];
        conductances.of_face[axis] =
            grid.edge.prod() / (edge * edge) * Eigen::Map<const Eigen::ArrayXd>(faces[axis].data(), std::ssize(faces[axis]));
    }
    return conductances;
}

ConductionSolver::ConductionSolver(FaceConductances conductances) {
    while (true) {
        Eigen::ArrayXd diagonal = diagonal_of(conductances);
        diagonal = (diagonal > 0).select(diagonal.inverse(), 0.0);
        levels_.push_back({conductances, diagonal});
        const Eigen::Array3i& n = levels_.back().conductances.count;
        if ((n < 4).any() || (n.unaryExpr([](int k) { return k & 1; }) != 0).any()) {
            return;
        }
        conductances = coarsen(levels_.back().conductances);
    }
}

/// A V-cycle; both colours before and, in the opposite order, after, so that it is symmetric.
Eigen::ArrayXd ConductionSolver::precondition(std::size_t level, const Eigen::ArrayXd& residual) const {
    const auto& [g, inverse_diagonal] = levels_[level];
    Eigen::ArrayXd u = residual * inverse_diagonal;
    relax(g, inverse_diagonal, residual, 1, u);
    if (level + 1 == levels_.size()) {
        for (int sweep = 0; sweep < 10; ++sweep) {
            relax(g, inverse_diagonal, residual, 0, u);
            relax(g, inverse_diagonal, residual, 1, u);
        }
    } else {
        const Eigen::Array3i coarse = levels_[level + 1].conductances.count;
        Eigen::ArrayXd left = Eigen::ArrayXd::Zero(levels_[level + 1].inverse_diagonal.size());
        const NeighbourSum sum(g, u);
        Eigen::ArrayXd rest(u.size());
        for_all(g.count, [&](Index here, auto... neighbours) {
            const double diagonal = inverse_diagonal[here] > 0 ? u[here] / inverse_diagonal[here] : 0.0;
            rest[here] = inverse_diagonal[here] > 0 ? residual[here] - diagonal + sum(here, neighbours...) : 0.0;
        });
        const auto for_children = [&](auto&& visit) {
            for (int z = 0; z < g.count[2]; ++z) {
                for (int y = 0; y < g.count[1]; ++y) {
                    const Index row = (static_cast<Index>(z) * g.count[1] + y) * g.count[0];
                    for (int x = 0; x < g.count[0]; ++x) {
                        visit(row + x, parent_of(coarse, x, y, z));
                    }
                }
            }
        };
        for_children([&](Index child, Index parent) { left[parent] += rest[child]; });
        const Eigen::ArrayXd correction = precondition(level + 1, left);
        for_children([&](Index child, Index parent) { u[child] += inverse_diagonal[child] > 0 ? correction[parent] : 0.0; });
    }
    relax(g, inverse_diagonal, residual, 1, u);
    relax(g, inverse_diagonal, residual, 0, u);
    return u;
}

Eigen::ArrayXd ConductionSolver::solve(int axis, double spacing, double tolerance) const {
    const FaceConductances& g = levels_.front().conductances;
    const Eigen::ArrayXd& faces = g.of_face[static_cast<std::size_t>(axis)];
    Eigen::ArrayXd residual(faces.size());  // the flux that the gradient alone would leave in each voxel
    for_all(g.count, [&](Index here, Index left, Index, Index front, Index, Index below, Index) {
        const Index before = axis == 0 ? left : (axis == 1 ? front : below);
        residual[here] = spacing * (faces[here] - faces[before]);
    });
    const Eigen::ArrayXd diagonal = (levels_.front().inverse_diagonal > 0).select(levels_.front().inverse_diagonal.inverse(), 0.0);
    Eigen::ArrayXd u = Eigen::ArrayXd::Zero(faces.size());
    Eigen::ArrayXd direction = precondition(0, residual);
    double steep = dot(residual, direction);
    const double goal = tolerance * tolerance * steep;
    constexpr int most = 500;
    for (int iteration = 0; iteration < most && steep > goal; ++iteration) {
        Eigen::ArrayXd applied(u.size());
        const NeighbourSum sum(g, direction);
        for_all(g.count, [&](Index here, auto... neighbours) {
            applied[here] = diagonal[here] * direction[here] - sum(here, neighbours...);
        });
        const double step = steep / dot(direction, applied);
        u += step * direction;
        residual -= step * applied;
        const Eigen::ArrayXd next = precondition(0, residual);
        const double now = dot(residual, next);
        direction = next + now / steep * direction;
        steep = now;
    }
    require(!(steep > goal), "Laplace's equation in the pores was not solved after " + std::to_string(most) + " iterations");
    return u;
}

double ConductionSolver::power(const FaceConductances& g, const Eigen::ArrayXd& u, int axis, double spacing) {
    Eigen::ArrayXd power(u.size());
    for_all(g.count, [&](Index here, Index, Index right, Index, Index back, Index, Index above) {
        const double dx = u[right] - u[here] + (axis == 0 ? spacing : 0.0);
        const double dy = u[back] - u[here] + (axis == 1 ? spacing : 0.0);
        const double dz = u[above] - u[here] + (axis == 2 ? spacing : 0.0);
        power[here] = g.of_face[0][here] * dx * dx + g.of_face[1][here] * dy * dy + g.of_face[2][here] * dz * dz;
    });
    return dot(power, Eigen::ArrayXd::Ones(u.size()));
}

}  // namespace coagula::characterize
