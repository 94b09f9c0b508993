// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/applicable.hpp>
#include <coagula/characterize/bond_order.hpp>
#include <coagula/characterize/inner_particles.hpp>

#include "sample/averaged_particles.hpp"

namespace coagula::characterize {

namespace {

double legendre_4(double x2) {
    return (3 + x2 * (-30 + 35 * x2)) / 8;
}

double legendre_6(double x2) {
    return (-5 + x2 * (105 + x2 * (-315 + 231 * x2))) / 16;
}

struct CellOrder {
    double q4, q6;
    int facets;
};

struct Face {
    Eigen::Vector3d normal;
    double area;
};

/// Bond order of a cell, by the addition theorem: sum_m |sum_f a_f Y_lm(n_f)|^2 = (2 l + 1) / (4 pi) sum_fg a_f a_g P_l(n_f . n_g).
CellOrder measure_cell(const std::vector<Face>& faces) {
    constexpr double negligible = 1e-6;
    double surface = 0;
    for (const Face& face : faces) {
        surface += face.area;
    }
    CellOrder order{0, 0, 0};
    for (std::size_t f = 0; f < faces.size(); ++f) {
        order.facets += faces[f].area > negligible * surface ? 1 : 0;
        for (std::size_t g = 0; g <= f; ++g) {
            const double cosine = faces[f].normal.dot(faces[g].normal);
            const double weight = (f == g ? 1 : 2) * faces[f].area * faces[g].area / (surface * surface);
            order.q4 += weight * legendre_4(cosine * cosine);
            order.q6 += weight * legendre_6(cosine * cosine);
        }
    }
    order.q4 = std::sqrt(std::max(0.0, order.q4));
    order.q6 = std::sqrt(std::max(0.0, order.q6));
    return order;
}

std::vector<std::vector<Face>> faces_by_cell(const VoronoiFaces& faces) {
    std::vector<std::vector<Face>> cells(static_cast<std::size_t>(faces.neighbours.particles));
    for (Index k = 0; k < faces.neighbours.size(); ++k) {
        const Eigen::Vector3d normal = faces.neighbours.branch.col(k).normalized();
        for (int end = 0; end < 2; ++end) {  // the sign of the normal does not matter: l is even
            cells[static_cast<std::size_t>(faces.neighbours.ends(end, k))].push_back({normal, faces.areas[k]});
        }
    }
    return cells;
}

}  // namespace

BondOrder measure_bond_order(const Packing& packing) {
    check(packing);
    return measure_bond_order(packing, measure_voronoi_faces(packing), inner_particles(packing));
}

BondOrder measure_bond_order(const Packing& packing, const VoronoiFaces& faces, const std::vector<bool>& inner) {
    const std::vector<std::vector<Face>> cells = faces_by_cell(faces);
    const Blocks shares = make_blocks(packing, inner);
    const Index blocks = std::max<Index>(1, shares.count);
    BondOrder result;
    result.q4 = result.q6 = Eigen::VectorXd::Constant(packing.size(), unset);
    BlockSums q4(blocks), q6(blocks), q4_squares(blocks), q6_squares(blocks), count(blocks);
    for (Index i = 0; i < packing.size(); ++i) {
        const auto& cell = cells[static_cast<std::size_t>(i)];
        if (!inner[static_cast<std::size_t>(i)] || cell.empty()) {
            continue;
        }
        const CellOrder order = measure_cell(cell);
        const int block = std::max(0, shares.of_particle[i]);
        result.q4[i] = order.q4;
        result.q6[i] = order.q6;
        q4.add(block, order.q4);
        q6.add(block, order.q6);
        q4_squares.add(block, order.q4 * order.q4);
        q6_squares.add(block, order.q6 * order.q6);
        count.add(block, order.facets);
    }
    require_applicable(count.weight() > 0,
                       "the packing is open and has " + std::to_string(packing.size()) +
                           " particles, but none lies so far inside that its Voronoi cell is certain: a larger sample is needed");
    result.q4_mean = q4.mean();
    result.q4_mean_stderr = q4.mean_stderr();
    result.q6_mean = q6.mean();
    result.q6_mean_stderr = q6.mean_stderr();
    result.q4_spread = std::sqrt(std::max(0.0, q4_squares.mean() - result.q4_mean * result.q4_mean));
    result.q6_spread = std::sqrt(std::max(0.0, q6_squares.mean() - result.q6_mean * result.q6_mean));
    result.facets = count.mean();
    result.facets_stderr = count.mean_stderr();
    return result;
}

}  // namespace coagula::characterize
