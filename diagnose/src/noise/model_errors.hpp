// Errors of a prediction that comes from a sample of its own, such as some structures.
#pragma once

#include <Eigen/Core>

#include <limits>

namespace coagula::diagnose {

/// Independent errors of a prediction.
struct ModelErrors {
    Eigen::MatrixXd changes = {};                              ///< numbers x errors: what one standard error changes them by
    double degrees = std::numeric_limits<double>::infinity();  ///< of freedom from which their common scale is known
};

}  // namespace coagula::diagnose
