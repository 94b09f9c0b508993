// Packings that the tests of coagula::characterize share: lattices, random sets and measured structures.
#pragma once

#include <coagula/common/packing.hpp>
#include <coagula/common/random.hpp>

#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace coagula::characterize::test {

/// A periodic lattice of cubic cells of edge a with the given basis (fractions of a).
inline Packing lattice(const std::vector<Eigen::Vector3d>& basis, double a, const Eigen::Vector3i& cells, double radius) {
    std::vector<Eigen::Vector3d> points;
    for (int x = 0; x < cells[0]; ++x) {
        for (int y = 0; y < cells[1]; ++y) {
            for (int z = 0; z < cells[2]; ++z) {
                for (const Eigen::Vector3d& site : basis) {
                    points.emplace_back(a * (Eigen::Vector3d(x, y, z) + site));
                }
            }
        }
    }
    Packing packing;
    packing.cell = Cell::periodic(a * cells.cast<double>());
    packing.positions = Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, static_cast<Index>(points.size()));
    packing.radii = Eigen::VectorXd::Constant(packing.size(), radius);
    return packing;
}

// Lattices of touching spheres of the given radius.
inline Packing simple_cubic(const Eigen::Vector3i& cells, double radius) {
    return lattice({{0, 0, 0}}, 2 * radius, cells, radius);
}
inline Packing body_centred(const Eigen::Vector3i& cells, double radius) {
    return lattice({{0, 0, 0}, {.5, .5, .5}}, 4 * radius / std::sqrt(3.0), cells, radius);
}
inline Packing face_centred(const Eigen::Vector3i& cells, double radius) {
    return lattice({{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}}, 2 * std::sqrt(2.0) * radius, cells, radius);
}

/// Points uniform at random (spheres overlap), radii uniform between the two given.
inline Packing random_spheres(Index particles, const Eigen::Vector3d& lengths, double smallest, double largest,
                              std::uint64_t seed) {
    Packing packing;
    packing.cell = Cell::periodic(lengths);
    packing.positions.resize(3, particles);
    packing.radii.resize(particles);
    for (Index i = 0; i < particles; ++i) {
        const auto id = static_cast<std::uint64_t>(i);
        packing.positions.col(i) = random_uniform(seed, RandomPurpose::test, 0, id).cwiseProduct(lengths);
        packing.radii[i] = smallest + (largest - smallest) * random_uniform(seed, RandomPurpose::test, 1, id)[0];
    }
    return packing;
}

/// Columns `first` to `first + 2` of a CSV file with a header line; no columns if there is no such file.
inline Eigen::Matrix3Xd read_points(const std::string& path, int first) {
    std::ifstream file(path);
    std::vector<Eigen::Vector3d> points;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::istringstream fields(line);
        std::string field;
        Eigen::Vector3d point;
        for (int column = 0; column < first + 3 && std::getline(fields, field, ','); ++column) {
            if (column >= first) {
                point[column - first] = std::stod(field);
            }
        }
        points.push_back(point);
    }
    return points.empty() ? Eigen::Matrix3Xd(3, 0)
                          : Eigen::Matrix3Xd(Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, std::ssize(points)));
}

/// One of the reference structures: equal spheres in a periodic cube; empty if the file is absent.
inline Packing reference_structure(const std::string& name) {
    Packing packing;
    packing.cell = Cell::periodic(Eigen::Vector3d::Constant(1.0939048394478881e-05));
    packing.positions = read_points(std::string(COAGULA_SHARED_DATA) + "/reference_structures/" + name + ".csv", 0);
    for (Index i = 0; i < packing.size(); ++i) {
        packing.positions.col(i) = packing.cell.wrap(packing.positions.col(i));
    }
    packing.radii = Eigen::VectorXd::Constant(packing.size(), 2.5e-7);
    return packing;
}

}  // namespace coagula::characterize::test
