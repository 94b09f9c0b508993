// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/statistics.hpp>

#include <cmath>

namespace coagula {

MeanWithError mean_and_standard_error(const Eigen::VectorXd& values) {
    require(values.size() > 0, "the mean of no values is not defined");
    require(values.allFinite(), "the values of a mean must be finite");
    MeanWithError found{.count = values.size(), .mean = values.mean()};
    if (values.size() > 1) {
        const auto count = static_cast<double>(values.size());
        found.standard_deviation = std::sqrt((values.array() - found.mean).square().sum() / (count - 1));
        found.standard_error = found.standard_deviation / std::sqrt(count);
    }
    return found;
}

}  // namespace coagula
