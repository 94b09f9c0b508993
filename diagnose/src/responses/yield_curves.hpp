// SPDX-License-Identifier: GPL-3.0-or-later
// How a network whose bonds break yields under growing strain, between the loads at which it was run.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace coagula::diagnose {

/// Some curves over the same loads, a load being a strain over the critical one: storage modulus over that at rest once nothing
/// breaks any more, and the energy that was lost up to there. Between the loads their slopes over the logarithm of the load go
/// smoothly into each other: a row of a sweep loses the difference of two places, which would jump with the nodes otherwise.
class YieldCurves {
public:
    /// @param loads growing, the first above 0. @param settled curves x loads: storage modulus over that at rest in the second
    /// oscillation at a load, and as imaginary part what the first one lost over it.
    YieldCurves(std::vector<double> loads, const Eigen::MatrixXcd& settled);

    /// G* / G of every curve in the first oscillation at load `to` of a network that had seen load `from`. Where that is larger,
    /// nothing breaks and nothing is lost any more. Past the last load nothing changes any more.
    Eigen::VectorXcd response(double from, double to) const;

    /// Storage modulus of the first curve, over that at rest, in each quarter of that oscillation where the strain is `to` x
    /// `sine`, up to the sign.
    std::array<double, 4> storage(double from, double to, double sine) const;

private:
    /// Values of the first `rows` curves at a load.
    template <int Rows>
    Eigen::Vector<std::complex<double>, Rows> at(double load, Eigen::Index rows = Rows) const;

    std::vector<double> loads_;  ///< from half of the first one on, up to which nothing breaks
    Eigen::MatrixXcd curves_;    ///< curves x loads: settled storage and, imaginary, energy lost so far
    Eigen::MatrixXcd starts_;    ///< curves x steps between loads: change per logarithm of the load at the start of a step over
                                 ///< the sum of those at its ends
};

}  // namespace coagula::diagnose
