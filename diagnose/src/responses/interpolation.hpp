// SPDX-License-Identifier: GPL-3.0-or-later
// Cubic interpolation between nodes that are equally spaced, most in the logarithm.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace coagula::diagnose {

struct NodeAxis {
    double low;
    double high;
    int count;

    double node(int k) const { return low * std::pow(high / low, static_cast<double>(k) / (count - 1)); }
    double place(double value) const { return (count - 1) * std::log(value / low) / std::log(high / low); }
};

/// Nodes that are equally spaced as they stand.
struct LinearAxis {
    double low;
    double high;
    int count;

    double node(int k) const { return low + (high - low) * k / (count - 1); }
    double place(double value) const { return (count - 1) * (value - low) / (high - low); }
};

/// The four nodes nearest to a value, and their weights in the cubic through them; outside the axis those of its end.
struct NearNodes {
    int first;
    std::array<double, 4> weight;
};

template <class AnyAxis>
NearNodes near_nodes(const AnyAxis& axis, double value) {
    const double place = std::clamp(axis.place(value), 0.0, static_cast<double>(axis.count - 1));
    const int first = std::clamp(static_cast<int>(std::floor(place)) - 1, 0, axis.count - 4);
    const double t = place - first;
    return {first,
            {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2, t * (t - 1) * (t - 2) / 6}};
}

/// The value at `value` from those at the nodes, at(k).
template <class AnyAxis, class At>
auto interpolate_nodes(const AnyAxis& axis, double value, const At& at) {
    const auto [first, weight] = near_nodes(axis, value);
    std::decay_t<decltype(at(first))> sum = weight[0] * at(first);
    for (int k = 1; k < 4; ++k) {
        sum += weight[static_cast<std::size_t>(k)] * at(first + k);
    }
    return sum;
}

/// The same in two directions of one axis, from at(k, l).
template <class AnyAxis, class At>
auto interpolate_nodes(const AnyAxis& axis, double first, double second, const At& at) {
    return interpolate_nodes(axis, first, [&](int k) { return interpolate_nodes(axis, second, [&](int l) { return at(k, l); }); });
}

/// The same for positive values that vary over decades, in their logarithms; `f` takes the value of a node.
template <class Function>
double interpolate(const NodeAxis& axis, double value, const Function& f) {
    return std::exp(interpolate_nodes(axis, value, [&](int k) { return std::log(std::max(f(axis.node(k)), 1e-300)); }));
}

}  // namespace coagula::diagnose
