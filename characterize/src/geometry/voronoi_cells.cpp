// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/characterize/voronoi_cells.hpp>

#include "voronoi_of_diagram.hpp"

#include <coagula/common/special_functions.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace coagula::characterize {

namespace {

constexpr std::size_t chunks = 64;  // fixed, so that sums do not depend on the number of threads

/// 6 x the volumes on either side of the face between two sites that an edge of the face adds: pyramids over the triangle from the
/// point of the face on the line of the sites to the ends of the edge.
std::array<double, 2> pyramids(const PowerDiagram& diagram, int first, int second, const Eigen::Vector3d& begin,
                               const Eigen::Vector3d& end) {
    const Eigen::Vector3d line = diagram.positions.col(second) - diagram.positions.col(first);
    const double difference = (diagram.radii[first] - diagram.radii[second]) * (diagram.radii[first] + diagram.radii[second]);
    const double share = 0.5 * (1 + difference / line.squaredNorm());
    const Eigen::Vector3d middle = diagram.positions.col(first) + share * line;
    const double product = line.dot((begin - middle).cross(end - middle));
    return {share * product, (1 - share) * product};
}

/// These volumes for an edge with an end that is flat, whose place is not known.
std::array<double, 2> pyramids(const EdgeGeometry& geometry, std::size_t side) {
    const EdgeSide& view = geometry.sides[side];
    const double product = view.foot_distance * (geometry.height[0] + geometry.height[1]);
    return {view.first_distance * product, view.second_distance * product};
}

/// Volumes of the counted cells from some of the edges.
void add_volumes(const PowerDiagram& diagram, std::size_t begin, std::size_t end, Eigen::VectorXd& volumes) {
    for (std::size_t k = begin; k < end; ++k) {
        const DiagramEdge& edge = diagram.edges[k];
        const DiagramVertex& top = diagram.vertices[static_cast<std::size_t>(edge.end[0])];
        const DiagramVertex& bottom = diagram.vertices[static_cast<std::size_t>(edge.end[1])];
        const bool is_known = top.relative_volume > 0 && bottom.relative_volume > 0;
        const EdgeGeometry geometry = is_known ? EdgeGeometry{} : measure_edge(diagram, edge);
        for (std::size_t side = 0; side < 3; ++side) {
            const int first = edge.around[side];
            const int second = edge.around[(side + 1) % 3];
            const std::array<double, 2> volume =
                is_known ? pyramids(diagram, first, second, bottom.place, top.place) : pyramids(geometry, side);
            if (diagram.counted[static_cast<std::size_t>(first)] != 0) {
                volumes[first] += volume[0] / 6;
            }
            if (diagram.counted[static_cast<std::size_t>(second)] != 0) {
                volumes[second] += volume[1] / 6;
            }
        }
    }
}

/// Part of the face between a counted particle and a site.
struct FacePart {
    int particle = 0;
    int site = 0;
    double area = 0;
};

std::vector<FacePart> face_parts(const PowerDiagram& diagram) {
    std::vector<FacePart> parts;
    for (const DiagramEdge& edge : diagram.edges) {
        const EdgeGeometry geometry = measure_edge(diagram, edge);
        const double height = (geometry.height[0] + geometry.height[1]) / 2;
        for (const EdgeSide& side : geometry.sides) {
            const std::array<int, 2> sites = {edge.around[static_cast<std::size_t>(side.first)],
                                              edge.around[static_cast<std::size_t>(side.second)]};
            for (std::size_t which = 0; which < 2; ++which) {
                if (diagram.counted[static_cast<std::size_t>(sites[which])] != 0) {
                    parts.push_back({sites[which], sites[1 - which], side.foot_distance * height});
                }
            }
        }
    }
    std::sort(parts.begin(), parts.end(), [](const FacePart& one, const FacePart& other) {
        return std::pair(one.particle, one.site) < std::pair(other.particle, other.site);
    });
    return parts;
}

/// Of a face that is seen from both of its sides, one view is kept.
bool keeps(const PowerDiagram& diagram, const FacePart& part) {
    const int other = diagram.particle[static_cast<std::size_t>(part.site)];
    if (part.particle != other) {
        return part.particle < other || diagram.counted[static_cast<std::size_t>(other)] == 0;
    }
    Eigen::Vector3d step = diagram.positions.col(part.site) - diagram.positions.col(part.particle);
    constexpr double rounding = 1e-9;  // that a tilted box leaves of zero
    step = (step.array().abs() > rounding * step.norm()).select(step, 0.0);
    return step[0] != 0 ? step[0] > 0 : (step[1] != 0 ? step[1] > 0 : step[2] > 0);
}

double kolmogorov_distance(Eigen::VectorXd x, double shape) {
    std::sort(x.begin(), x.end());
    double distance = 0;
    const auto count = static_cast<double>(x.size());
    for (Index i = 0; i < x.size(); ++i) {
        const double law = gamma_p(shape, shape * x[i]);
        distance = std::max({distance, law - static_cast<double>(i) / count, static_cast<double>(i + 1) / count - law});
    }
    return distance;
}

}  // namespace

VoronoiCells measure_voronoi_cells(const ReducedDiagram& reduced) {
    const PowerDiagram& diagram = reduced.diagram;
    const Index particles = reduced.packing.size();
    VoronoiCells cells{Eigen::VectorXd::Zero(particles), reduced.inner()};
    std::vector<Eigen::VectorXd> parts(chunks);
    const std::size_t used = diagram.edges.size() < 100000 ? 1 : chunks / 8;
#pragma omp parallel for schedule(dynamic)
    for (std::size_t chunk = 0; chunk < used; ++chunk) {
        parts[chunk] = Eigen::VectorXd::Zero(particles);
        add_volumes(diagram, diagram.edges.size() * chunk / used, diagram.edges.size() * (chunk + 1) / used, parts[chunk]);
    }
    for (std::size_t chunk = 0; chunk < used; ++chunk) {
        cells.volumes += parts[chunk];
    }
    cells.volumes = cells.volumes.cwiseMax(0.0) * (reduced.unit * reduced.unit * reduced.unit);
    return cells;
}

VoronoiCells measure_voronoi_cells(const Packing& packing) {
    check(packing);
    return measure_voronoi_cells(reduced_diagram(packing));
}

VoronoiFaces measure_voronoi_faces(const ReducedDiagram& reduced) {
    const PowerDiagram& diagram = reduced.diagram;
    const std::vector<FacePart> parts = face_parts(diagram);
    std::vector<FacePart> faces;
    for (const FacePart& part : parts) {
        if (!keeps(diagram, part)) {
            continue;
        }
        if (faces.empty() || faces.back().particle != part.particle || faces.back().site != part.site) {
            faces.push_back({part.particle, part.site, 0});
        }
        faces.back().area += part.area;
    }
    VoronoiFaces result;
    const auto count = static_cast<Index>(faces.size());
    result.neighbours.particles = reduced.packing.size();
    result.neighbours.ends.resize(2, count);
    result.neighbours.branch.resize(3, count);
    result.areas.resize(count);
    for (Index k = 0; k < count; ++k) {
        const FacePart& face = faces[static_cast<std::size_t>(k)];
        result.neighbours.ends.col(k) << face.particle, diagram.particle[static_cast<std::size_t>(face.site)];
        result.neighbours.branch.col(k) = reduced.unit * (diagram.positions.col(face.site) - diagram.positions.col(face.particle));
        result.areas[k] = reduced.unit * reduced.unit * std::max(face.area, 0.0);
    }
    return result;
}

VoronoiFaces measure_voronoi_faces(const Packing& packing) {
    check(packing);
    return measure_voronoi_faces(reduced_diagram(packing));
}

// log k - digamma(k) = -mean(log x), by Newton's method for log k.
double gamma_shape(double minus_mean_log) {
    if (!(minus_mean_log > 0)) {
        return unset;
    }
    double k = 0.5 / minus_mean_log;
    for (int step = 0; step < 50; ++step) {
        const double value = std::log(k) - digamma(k) - minus_mean_log;
        const double change = value / (1 - k * trigamma(k));
        k *= std::exp(std::clamp(-change, -1.0, 1.0));
        if (std::abs(change) < 1e-13) {
            break;
        }
    }
    return k;
}

VoronoiDistribution fit_voronoi_volumes(const Eigen::VectorXd& volumes, double radius) {
    require_positive(radius, "the radius of the spheres", "m");
    require(volumes.size() >= 2 && volumes.allFinite() && volumes.minCoeff() >= 0,
            "the distribution of Voronoi volumes needs at least two finite volumes that are not negative");
    VoronoiDistribution found;
    found.cells = volumes.size();
    found.mean = volumes.mean();
    found.deviation = std::sqrt((volumes.array() - found.mean).square().sum() / static_cast<double>(volumes.size() - 1));
    const double smallest = smallest_voronoi_volume * radius * radius * radius;
    if (found.mean <= smallest) {
        return found;
    }
    found.width = found.deviation / (found.mean - smallest);
    const Eigen::VectorXd x = (volumes.array() - smallest) / (found.mean - smallest);
    if (x.minCoeff() > 0 && found.width >= narrowest_gamma_law) {
        found.shape = gamma_shape(-x.array().log().mean());
        found.distance = kolmogorov_distance(x, found.shape);
    }
    return found;
}

}  // namespace coagula::characterize
