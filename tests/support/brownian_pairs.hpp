// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of Brownian particles far from each other, and what one pair does exactly. Units in the names: mean radius, kB T, R^2/D.
#pragma once

#include <coagula/common/random.hpp>
#include <coagula/generators/brownian_dynamics.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace coagula::generators::examples {

inline constexpr double radius = 0.25e-6;
inline constexpr double temperature = 293;
inline constexpr double thermal = boltzmann_constant * temperature;
inline constexpr PairRadii radii{radius, radius};

/// The suspension of Schenker et al. 2012; contact 4e5 kB T/R^2 (by default), at rest at 0.004 R.
inline PairPotential dlvo(double surface_potential, std::vector<PairLaw> more = {}, double stiffness = 4e5) {
    more.emplace_back(HamakerAttraction(4.76e-20, radii));
    more.emplace_back(LinearSuperposition({surface_potential, 10e-9, 81, temperature, 1}, radii));
    return {more, {stiffness * thermal / (radius * radius), 0.004 * radius}};
}

inline double diffusion_time() {
    return choose_time_step(dlvo(0), radius, 0, {}).diffusion_time;
}

/// side^3 pairs on a cubic lattice, too far apart to meet; gap(number) in radii.
inline Packing lattice_of_pairs(int side, const std::function<double(int)>& gap) {
    constexpr double spacing = 7;
    const Index pairs = Index{side} * side * side;
    Packing packing{Cell::periodic(Eigen::Vector3d::Constant(spacing * side * radius)), Eigen::Matrix3Xd(3, 2 * pairs),
                    Eigen::VectorXd::Constant(2 * pairs, radius)};
    for (int pair = 0; pair < pairs; ++pair) {
        const Eigen::Array3i place(pair % side, pair / side % side, pair / side / side);
        const Eigen::Vector3d centre = spacing * (place.cast<double>() + 0.5).matrix();
        const Eigen::Vector3d direction = random_normal(7, RandomPurpose::test, 0, static_cast<std::uint64_t>(pair)).normalized();
        packing.positions.col(Index{2} * pair) = radius * (centre + (1 + gap(pair) / 2) * direction);
        packing.positions.col(Index{2} * pair + 1) = radius * (centre - (1 + gap(pair) / 2) * direction);
    }
    return packing;
}

/// Gaps of the pairs, in radii.
inline std::vector<double> gaps_of(const Cell& cell, const Eigen::Matrix3Xd& positions) {
    std::vector<double> gaps;
    for (Index first = 0; first < positions.cols(); first += 2) {
        gaps.push_back(cell.minimum_image(positions.col(first) - positions.col(first + 1)).norm() / radius - 2);
    }
    return gaps;
}

/// Integral of (2 + gap)^2 exp(-V) weight(gap) over the gap by the midpoint rule.
inline double boltzmann_integral(
    const PairPotential& potential, double low, double high,
    const std::function<double(double)>& weight = [](double) { return 1.0; }) {
    constexpr int points = 20000;
    const double reference = potential.energy(0.5 * (low + high) * radius) / thermal;
    double sum = 0;
    for (int point = 0; point < points; ++point) {
        const double gap = low + (high - low) * (point + 0.5) / points;
        sum += (2 + gap) * (2 + gap) * std::exp(reference - potential.energy(gap * radius) / thermal) * weight(gap);
    }
    return sum * (high - low) / points * std::exp(-reference);
}

/// Share of the pairs that started at one gap and are inside another after a time: the radial Smoluchowski equation with relative
/// diffusion coefficient 2, by finite volumes with exponential fitting (Scharfetter and Gummel 1969), implicit in time and
/// extrapolated to no time step. @param closest gap that a pair comes to.
inline double share_inside(const PairPotential& potential, double start, double inside, double time, double closest = -0.006) {
    std::vector<double> faces{closest};
    while (faces.back() < 1.5) {
        faces.push_back(faces.back() + 2e-4 + 0.01 * std::max(0.0, faces.back() - 0.2));
    }
    const std::size_t cells = faces.size() - 1;
    std::vector<double> volume(cells);
    std::vector<double> energy(cells);
    std::vector<double> centre(cells);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        centre[cell] = 0.5 * (faces[cell] + faces[cell + 1]);
        volume[cell] = (std::pow(2 + faces[cell + 1], 3) - std::pow(2 + faces[cell], 3)) / 3;
        energy[cell] = potential.energy(centre[cell] * radius) / thermal;
    }
    const auto bernoulli = [](double x) { return std::abs(x) < 1e-8 ? 1 - x / 2 : x / std::expm1(x); };
    const auto solve = [&](int steps) {
        std::vector<double> density(cells, 0.0);
        const auto home = static_cast<std::size_t>(std::upper_bound(faces.begin(), faces.end(), start) - faces.begin()) - 1;
        density[home] = 1 / volume[home];
        for (int step = 0; step < steps; ++step) {
            std::vector<double> below(cells, 0.0);
            std::vector<double> diagonal(cells);
            std::vector<double> above(cells, 0.0);
            std::vector<double> right(cells);
            for (std::size_t cell = 0; cell < cells; ++cell) {
                diagonal[cell] = volume[cell] * steps / time;
                right[cell] = diagonal[cell] * density[cell];
            }
            for (std::size_t cell = 0; cell + 1 < cells; ++cell) {
                const double distance = 2 + faces[cell + 1];
                const double conductance = 2 * distance * distance / (centre[cell + 1] - centre[cell]);
                const double rise = energy[cell + 1] - energy[cell];
                diagonal[cell] += conductance * bernoulli(rise);
                above[cell] -= conductance * bernoulli(-rise);
                diagonal[cell + 1] += conductance * bernoulli(-rise);
                below[cell + 1] -= conductance * bernoulli(rise);
            }
            for (std::size_t cell = 1; cell < cells; ++cell) {
                const double factor = below[cell] / diagonal[cell - 1];
                diagonal[cell] -= factor * above[cell - 1];
                right[cell] -= factor * right[cell - 1];
            }
            density[cells - 1] = right[cells - 1] / diagonal[cells - 1];
            for (std::size_t cell = cells - 1; cell-- > 0;) {
                density[cell] = (right[cell] - above[cell] * density[cell + 1]) / diagonal[cell];
            }
        }
        double sum = 0;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            sum += centre[cell] < inside ? density[cell] * volume[cell] : 0.0;
        }
        return sum;
    };
    return 2 * solve(2000) - solve(1000);
}

}  // namespace coagula::generators::examples
