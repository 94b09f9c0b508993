// SPDX-License-Identifier: GPL-3.0-or-later
#include "yield_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace coagula::diagnose {

using Eigen::Index;

namespace {

/// Phases of the first quarter of an oscillation over which its mean is taken.
constexpr int strains_of_quarter = 4;
/// Part of what bonds had carried that is missing while the strain has the sign at which they broke: where it turns, many of their
/// contacts close again and push (eight structures of 200 particles: waveforms in steps of 1.5 critical strains).
constexpr double missing = 0.8;

/// Part of the first of two changes, which have the same sign, in their sum.
double part_of(double first, double second) {
    const double sum = first + second;
    return sum == 0 ? 0.5 : std::clamp(first / sum, 0.0, 1.0);
}

/// For every step between loads the slope at its start over the sum of those at its ends, slopes at loads lying between the mean
/// slopes of the steps on either side; nothing changes before the first one.
Eigen::ArrayXXd starts_of(const std::vector<double>& loads, const Eigen::MatrixXd& curves) {
    const Index steps = curves.cols() - 1;
    Eigen::ArrayXd widths(steps);
    Eigen::ArrayXXd slopes(curves.rows(), steps);
    for (Index step = 0; step < steps; ++step) {
        widths[step] = std::log(loads[static_cast<std::size_t>(step) + 1] / loads[static_cast<std::size_t>(step)]);
        slopes.col(step) = (curves.col(step + 1) - curves.col(step)).array() / widths[step];
    }
    Eigen::ArrayXXd at_loads = Eigen::ArrayXXd::Zero(curves.rows(), steps + 1);
    for (Index load = 1; load < steps; ++load) {
        const double share = widths[load - 1] / (widths[load - 1] + widths[load]);
        at_loads.col(load) = (1 - share) * slopes.col(load - 1) + share * slopes.col(load);
    }
    at_loads.col(steps) = slopes.col(steps - 1);
    return at_loads.leftCols(steps).binaryExpr(at_loads.rightCols(steps), &part_of);
}

}  // namespace

YieldCurves::YieldCurves(std::vector<double> loads, const Eigen::MatrixXcd& settled) : loads_(std::move(loads)) {
    loads_.insert(loads_.begin(), 0.5 * loads_.front());
    curves_.setOnes(settled.rows(), settled.cols() + 1);
    curves_.rightCols(settled.cols()) = settled;
    for (Index node = 1; node < curves_.cols(); ++node) {
        // In units of an oscillation at the critical strain.
        const double load = loads_[static_cast<std::size_t>(node)];
        const Eigen::VectorXd sum = curves_.col(node - 1).imag() + load * load * curves_.col(node).imag();
        curves_.col(node).imag() = sum;
    }
    starts_.resize(curves_.rows(), curves_.cols() - 1);
    starts_.real() = starts_of(loads_, curves_.real()).matrix();
    starts_.imag() = starts_of(loads_, curves_.imag()).matrix();
}

template <int Rows>
Eigen::Vector<std::complex<double>, Rows> YieldCurves::at(double load, Index rows) const {
    using Values = Eigen::Vector<std::complex<double>, Rows>;
    const auto curve = [&](const Eigen::MatrixXcd& curves, Index column) -> Values {
        return curves.col(column).template head<Rows>(rows);
    };
    const auto above = std::upper_bound(loads_.begin(), loads_.end(), load);
    if (above == loads_.begin()) {
        return curve(curves_, 0);
    }
    if (above == loads_.end()) {
        return curve(curves_, curves_.cols() - 1);
    }
    const Index next = above - loads_.begin();
    const double way = std::log(load / *(above - 1)) / std::log(*above / *(above - 1));
    // The integral of a slope that goes linearly from its start to its end.
    const auto share = [&](const auto& start) { return (2 * way - 2 * way * way) * start.array() + way * way; };
    Values found = curve(curves_, next - 1);
    const Values change = curve(curves_, next) - found;
    const Values start = curve(starts_, next - 1);
    found.real().array() += share(start.real()) * change.real().array();
    found.imag().array() += share(start.imag()) * change.imag().array();
    return found;
}

std::array<double, 4> YieldCurves::storage(double from, double to, double sine) const {
    const double before = at<1>(from)[0].real();
    if (to <= from) {
        return {before, before, before, before};
    }
    const double lost = before - at<1>(to)[0].real();
    const double here = before - at<1>(std::max(from, sine * to))[0].real();
    return {before - missing * here, before - missing * lost, before - (1 - missing) * lost - missing * here, before - lost};
}

/// Half of the bonds that break do so while the strain grows in its first quarter and half of them, those on the other side, in its
/// third; until then they carry load. What they lose is the energy between the two loads, however large the step.
Eigen::VectorXcd YieldCurves::response(double from, double to) const {
    const Eigen::VectorXcd before = at<Eigen::Dynamic>(from, curves_.rows());
    if (to <= from) {
        return before.real().cast<std::complex<double>>();
    }
    const Eigen::VectorXcd after = at<Eigen::Dynamic>(to, curves_.rows());
    Eigen::VectorXd growing = Eigen::VectorXd::Zero(after.size());
    for (int k = 0; k < strains_of_quarter; ++k) {
        const double sine = std::sin((k + 0.5) * std::numbers::pi / (2 * strains_of_quarter));
        growing += 2 * sine * sine / strains_of_quarter * at<Eigen::Dynamic>(std::max(from, sine * to), curves_.rows()).real();
    }
    Eigen::VectorXcd response(after.size());
    response.real() = 0.5 * (before.real() + after.real()) - 0.5 * missing * (before.real() - growing);
    response.imag() = (after.imag() - before.imag()) / (to * to);
    return response;
}

}  // namespace coagula::diagnose
