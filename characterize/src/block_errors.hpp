// Standard errors from blocks of space. Internal.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <limits>

namespace coagula::characterize {

/// Jackknife standard error of the ratio sum(numerators) / sum(denominators) over blocks; blocks without denominator do not count.
/// NaN with fewer than two blocks. Source: Efron, The Jackknife, the Bootstrap and Other Resampling Plans (1982), section 3.
template <class Numerators, class Denominators>
double ratio_stderr(const Numerators& numerators, const Denominators& denominators) {
    const double numerator = numerators.sum(), denominator = denominators.sum();
    double count = 0, sum = 0, squares = 0;
    for (Eigen::Index block = 0; block < numerators.size(); ++block) {
        const double left = denominator - denominators[block];
        if (denominators[block] > 0 && left > 0) {
            const double change = (numerator - numerators[block]) / left - numerator / denominator;
            count += 1;
            sum += change;
            squares += change * change;
        }
    }
    return count < 2 ? std::numeric_limits<double>::quiet_NaN()
                     : std::sqrt((count - 1) / count * std::max(0.0, squares - sum * sum / count));
}

}  // namespace coagula::characterize
