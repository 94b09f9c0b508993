#include <coagula/characterize/bond_order.hpp>

#include "averaged_particles.hpp"
#include "counted_diagram.hpp"
#include "voronoi_facets.hpp"

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

/// By the addition theorem sum_m |sum_f a_f Y_lm(n_f)|^2 = (2 l + 1) / (4 pi) sum_fg a_f a_g P_l(n_f . n_g).
CellOrder measure_cell(const PowerDiagram& diagram, const VoronoiFacet* begin, const VoronoiFacet* end) {
    constexpr double negligible = 1e-6;
    std::vector<Eigen::Vector3d> normals;
    std::vector<double> areas;
    double surface = 0;
    for (const VoronoiFacet* facet = begin; facet != end; ++facet) {
        normals.push_back((diagram.positions.col(facet->neighbour) - diagram.positions.col(facet->site)).normalized());
        areas.push_back(facet->area);
        surface += facet->area;
    }
    CellOrder order{0, 0, 0};
    for (std::size_t f = 0; f < areas.size(); ++f) {
        order.facets += areas[f] > negligible * surface ? 1 : 0;
        for (std::size_t g = 0; g <= f; ++g) {
            const double cosine = normals[f].dot(normals[g]);
            const double weight = (f == g ? 1 : 2) * areas[f] * areas[g] / (surface * surface);
            order.q4 += weight * legendre_4(cosine * cosine);
            order.q6 += weight * legendre_6(cosine * cosine);
        }
    }
    order.q4 = std::sqrt(std::max(0.0, order.q4));
    order.q6 = std::sqrt(std::max(0.0, order.q6));
    return order;
}

}  // namespace

BondOrder measure_bond_order(const Packing& packing) {
    check(packing);
    const PowerDiagram diagram = counted_diagram(packing);
    const std::vector<VoronoiFacet> facets = voronoi_facets(diagram);
    const SpaceBlocks blocks = space_blocks(packing);
    BondOrder result;
    result.q4 = result.q6 = Eigen::VectorXd::Constant(packing.size(), unset);
    BlockSums q4(blocks.count), q6(blocks.count), q4_squares(blocks.count), q6_squares(blocks.count), count(blocks.count);
    for (std::size_t first = 0; first < facets.size();) {
        const int site = facets[first].site;
        std::size_t last = first;
        while (last < facets.size() && facets[last].site == site) {
            ++last;
        }
        const CellOrder order = measure_cell(diagram, facets.data() + first, facets.data() + last);
        const int block = blocks.of_particle[static_cast<std::size_t>(site)];
        result.q4[site] = order.q4;
        result.q6[site] = order.q6;
        q4.add(block, order.q4);
        q6.add(block, order.q6);
        q4_squares.add(block, order.q4 * order.q4);
        q6_squares.add(block, order.q6 * order.q6);
        count.add(block, order.facets);
        first = last;
    }
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
