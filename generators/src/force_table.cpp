// SPDX-License-Identifier: GPL-3.0-or-later
#include "force_table.hpp"

#include <algorithm>
#include <cmath>

namespace coagula::generators {

namespace {

double squared_distance(double gap) {
    return (2 + gap) * (2 + gap);
}

}  // namespace

ForceTable::ForceTable(const std::function<double(double)>& force, double first, double knot, double last, double spacing)
    : last_(last), inverse_spacing_(1 / (4 * spacing)) {
    const double step = 4 * spacing;  // d(r^2) = 2 r dr at r = 2
    const auto places = [&](double from, double to) { return std::ceil((squared_distance(to) - squared_distance(from)) / step); };
    const double below = places(first, knot);
    first_squared_ = squared_distance(knot) - below * step;
    intervals_ = static_cast<std::size_t>(below + places(knot, last));
    coefficients_.assign(4 * (intervals_ + 1), 0.0);
    const auto over_distance = [&](double place) {
        const double distance = std::sqrt(squared_distance(knot) + (place - below) * step);
        return force(distance - 2) / distance;
    };
    for (std::size_t interval = 0; interval < intervals_; ++interval) {
        const auto left = static_cast<double>(interval);
        // The right knot belongs to this side of a kink as far as values go: forces are continuous.
        const double a = over_distance(left);
        const double b = over_distance(left + 1.0 / 3);
        const double c = over_distance(left + 2.0 / 3);
        const double d = over_distance(left + 1);
        // Newton's form through 0, 1/3, 2/3, 1, multiplied out.
        double* cubic = &coefficients_[4 * interval];
        cubic[0] = a;
        cubic[1] = 0.5 * (-11 * a + 18 * b - 9 * c + 2 * d);
        cubic[2] = 4.5 * (2 * a - 5 * b + 4 * c - d);
        cubic[3] = 4.5 * (-a + 3 * b - 3 * c + d);
    }
}

double ForceTable::force(double gap) const {
    const double place = (squared_distance(gap) - first_squared_) * inverse_spacing_;
    const double inside = std::clamp(place, 0.0, static_cast<double>(intervals_));
    const auto interval = static_cast<std::size_t>(inside);
    const double* cubic = &coefficients_[4 * interval];
    const double t = place - static_cast<double>(interval);
    return (2 + gap) * (cubic[0] + t * (cubic[1] + t * (cubic[2] + t * cubic[3])));
}

double smooth_switch(double gap, double start, double end) {
    const double way = std::clamp((gap - start) / (end - start), 0.0, 1.0);
    return 1 - way * way * (3 - 2 * way);
}

}  // namespace coagula::generators
