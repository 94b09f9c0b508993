// SPDX-License-Identifier: GPL-3.0-or-later
#include "design.hpp"

#include <coagula/common/checks.hpp>

#include <boost/random/sobol.hpp>

#include <limits>
#include <random>
#include <utility>

namespace coagula::stages {

namespace {

/// A number from 0 to below 1 from the upper 53 bits.
double unit_number(std::mt19937_64& generator) {
    return static_cast<double>(generator() >> 11U) * 0x1.0p-53;
}

std::vector<std::vector<double>> latin_hypercube(const Design& design, std::size_t dimensions) {
    const auto samples = static_cast<std::size_t>(design.samples);
    std::mt19937_64 generator(design.seed);
    std::vector<std::vector<double>> points(samples, std::vector<double>(dimensions));
    std::vector<std::size_t> layers(samples);
    for (std::size_t axis = 0; axis < dimensions; ++axis) {
        for (std::size_t k = 0; k < samples; ++k) {
            layers[k] = k;
        }
        for (std::size_t k = samples; k > 1; --k) {  // Fisher and Yates; std::shuffle differs from library to library
            std::swap(layers[k - 1], layers[static_cast<std::size_t>(unit_number(generator) * static_cast<double>(k))]);
        }
        for (std::size_t k = 0; k < samples; ++k) {
            points[k][axis] = (static_cast<double>(layers[k]) + unit_number(generator)) / static_cast<double>(samples);
        }
    }
    return points;
}

std::vector<std::vector<double>> sobol(const Design& design, std::size_t dimensions) {
    boost::random::sobol generator(dimensions);
    std::vector<std::vector<double>> points(static_cast<std::size_t>(design.samples), std::vector<double>(dimensions));
    for (std::vector<double>& point : points) {
        for (double& coordinate : point) {
            coordinate = static_cast<double>(generator()) / (static_cast<double>(boost::random::sobol::max()) + 1.0);
        }
    }
    return points;
}

}  // namespace

std::vector<std::vector<double>> space_filling_points(const Design& design, std::size_t dimensions) {
    if (dimensions == 0) {
        return std::vector<std::vector<double>>(static_cast<std::size_t>(design.samples));
    }
    return design.kind == Design::Kind::sobol ? sobol(design, dimensions) : latin_hypercube(design, dimensions);
}

}  // namespace coagula::stages
