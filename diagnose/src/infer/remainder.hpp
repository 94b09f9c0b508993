// What a model leaves over: a smooth departure on top of it (Kennedy and O'Hagan, J. R. Stat. Soc. B 63 (2001) 425).
#pragma once

#include "smooth.hpp"

#include <Eigen/Core>

namespace coagula::diagnose {

struct SmoothRemainder {
    double log_factor = 0;          ///< on the evidence of the fit, averaged over coordinates, amplitudes and lengths
    std::vector<Coordinate> along;  ///< those of the best one
    Eigen::MatrixXd directions;     ///< whitened ones of that, of unit deviation
    Eigen::VectorXd departure;      ///< most probable one along them, of every number
};

/// At a fit, whose stiffness and parameters follow (linearised there; those at an active end of their prior stay).
SmoothRemainder find_remainder(const Inference& inference, const Fit& fit, const SmoothDepartures& departures);

/// Factor on the evidence of the fit by a remainder along these directions alone, as a logarithm.
double log_factor_along(const Inference& inference, const Fit& fit, const Eigen::MatrixXd& directions);

}  // namespace coagula::diagnose
