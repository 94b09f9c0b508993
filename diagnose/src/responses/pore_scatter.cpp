// SPDX-License-Identifier: GPL-3.0-or-later
#include "pore_scatter.hpp"

#include <coagula/common/checks.hpp>
#include <coagula/common/surface_distance.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace coagula::diagnose {

namespace {

using Complex = std::complex<double>;

constexpr Index waves = 9;

/// Points in the middles of equal boxes that fill the cell.
class Grid {
public:
    explicit Grid(const Packing& packing) : cell_(packing.cell) {
        constexpr double points_in_a_radius = 3;
        constexpr int fewest = 32;
        constexpr int most = 96;
        const double spacing = mean_radius(packing) / points_in_a_radius;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            count_[axis] = std::clamp(static_cast<int>(cell_.lengths()[static_cast<Index>(axis)] / spacing), fewest, most);
            for (int k = 0; k < count_[axis]; ++k) {
                phases_[axis].push_back(std::polar(1.0, 2 * std::numbers::pi * (k + 0.5) / count_[axis]));
            }
        }
    }

    int count(std::size_t axis) const { return count_[axis]; }
    double points() const { return static_cast<double>(count_[0]) * count_[1] * count_[2]; }

    Eigen::Vector3d point(int x, int y, int z) const {
        const Eigen::Array3d place(x + 0.5, y + 0.5, z + 0.5);
        return cell_.origin().array() + cell_.lengths().array() * place / Eigen::Array3d(count_[0], count_[1], count_[2]);
    }

    /// One, for the mean, then the waves at a point.
    Eigen::RowVector<Complex, 1 + waves> waves_at(int x, int y, int z) const {
        const Complex a = phases_[0][static_cast<std::size_t>(x)];
        const Complex b = phases_[1][static_cast<std::size_t>(y)];
        const Complex c = phases_[2][static_cast<std::size_t>(z)];
        Eigen::RowVector<Complex, 1 + waves> all;
        all << 1.0, a, b, c, a * b, a * std::conj(b), b * c, b * std::conj(c), c * a, c * std::conj(a);
        return all;
    }

private:
    Cell cell_;
    std::array<int, 3> count_{};
    std::array<std::vector<Complex>, 3> phases_;
};

/// How many of the radii, `step` apart [m], a point of the void is farther from any surface than; 0: it lies in a particle.
Index radii_exceeded(double distance, double step) {
    return static_cast<Index>(std::clamp(std::ceil(distance / step), 0.0, static_cast<double>(scatter_radii)));
}

/// Mean over the points of the space farther than each radius from all surfaces, and its waves: radii x (1 + waves).
Eigen::MatrixXcd waves_of_pores(const Packing& packing) {
    const Grid grid(packing);
    const double step = scatter_step * mean_radius(packing);
    const CellList cells(packing.cell, packing.positions, scatter_radii * step + packing.radii.maxCoeff());
    const Eigen::MatrixXcd nothing = Eigen::MatrixXcd::Zero(scatter_radii + 1, 1 + waves);
    std::vector<Eigen::MatrixXcd> layers(static_cast<std::size_t>(grid.count(2)), nothing);
#pragma omp parallel for schedule(dynamic)
    for (int z = 0; z < grid.count(2); ++z) {
        for (int y = 0; y < grid.count(1); ++y) {
            for (int x = 0; x < grid.count(0); ++x) {
                const double distance = surface_distance(cells, packing, grid.point(x, y, z));
                layers[static_cast<std::size_t>(z)].row(radii_exceeded(distance, step)) += grid.waves_at(x, y, z);
            }
        }
    }
    Eigen::MatrixXcd all = nothing;
    for (const Eigen::MatrixXcd& layer : layers) {
        all += layer;
    }
    for (Index radius = scatter_radii; radius-- > 0;) {
        all.row(radius) += all.row(radius + 1);  // what is beyond the next radius is beyond this one
    }
    return all.bottomRows(scatter_radii) / grid.points();
}

}  // namespace

std::vector<double> covariance_of_pores(const Packing& packing) {
    const Eigen::MatrixXcd pores = waves_of_pores(packing);
    const Eigen::VectorXd means = pores.col(0).real();
    require(means[0] > 0, "there is no space between the particles");
    const Eigen::RowVectorXcd voids = pores.row(0).tail(waves);
    Eigen::MatrixXcd probability = (pores.rightCols(waves) - means / means[0] * voids) / means[0];
    const double of_voids = std::max(voids.squaredNorm(), std::numeric_limits<double>::min());
    const Eigen::VectorXd slopes = (probability * voids.adjoint()).real() / of_voids;
    probability -= slopes * voids;
    const double free_waves = waves - 0.5;  // a slope is one real number
    const Eigen::MatrixXd covariance = (probability * probability.adjoint()).real() / free_waves;
    return {covariance.reshaped().begin(), covariance.reshaped().end()};
}

}  // namespace coagula::diagnose
