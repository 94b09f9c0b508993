// Minimisation of a function of few variables without derivatives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace coagula::diagnose {

/// The simplex method of Nelder and Mead (Comput. J. 7 (1965) 308), started anew at its result until that brings no more.
/// @param steps edge of the first simplex in each direction.
template <std::size_t size, class Function>
std::array<double, size> minimise_by_simplex(const Function& function, std::array<double, size> start,
                                             const std::array<double, size>& steps) {
    constexpr int most_rounds = 300;
    constexpr double precision = 1e-9;  // of the function between the corners
    using Point = std::array<double, size>;
    struct Corner {
        Point at;
        double value;
    };
    const auto corner = [&](const Point& at) { return Corner{at, function(at)}; };
    const auto along = [](const Point& from, const Point& to, double part) {
        Point point;
        for (std::size_t i = 0; i < size; ++i) {
            point[i] = from[i] + part * (to[i] - from[i]);
        }
        return point;
    };
    for (double before = function(start);;) {
        std::array<Corner, size + 1> corners;
        corners[0] = {start, before};
        for (std::size_t i = 0; i < size; ++i) {
            Point shifted = start;
            shifted[i] += steps[i];
            corners[i + 1] = corner(shifted);
        }
        const auto sort = [&] {
            std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.value < b.value; });
        };
        sort();
        for (int round = 0; round < most_rounds && corners[size].value - corners[0].value > precision; ++round) {
            Point centre{};
            for (std::size_t k = 0; k < size; ++k) {
                for (std::size_t i = 0; i < size; ++i) {
                    centre[i] += corners[k].at[i] / static_cast<double>(size);
                }
            }
            Corner& worst = corners[size];
            const Corner reflected = corner(along(centre, worst.at, -1));
            if (reflected.value < corners[0].value) {
                const Corner expanded = corner(along(centre, worst.at, -2));
                worst = expanded.value < reflected.value ? expanded : reflected;
            } else if (reflected.value < corners[size - 1].value) {
                worst = reflected;
            } else {
                const Corner contracted = corner(along(centre, reflected.value < worst.value ? reflected.at : worst.at, 0.5));
                if (contracted.value < std::min(reflected.value, worst.value)) {
                    worst = contracted;
                } else {
                    for (std::size_t k = 1; k <= size; ++k) {
                        corners[k] = corner(along(corners[0].at, corners[k].at, 0.5));
                    }
                }
            }
            sort();
        }
        start = corners[0].at;
        if (!(before - corners[0].value > 1e-6)) {
            return start;
        }
        before = corners[0].value;
    }
}

}  // namespace coagula::diagnose
