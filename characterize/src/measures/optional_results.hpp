// SPDX-License-Identifier: GPL-3.0-or-later
// Results that a packing may not have, and calculations that a packing may be too small for.
#pragma once

#include <coagula/characterize/measure.hpp>

#include <cmath>

namespace coagula::characterize {

/// Adds a value that is a number; a NaN means that the packing does not say it.
inline void add_known(MeasureResult& result, const std::string& name, double value, const std::string& unit,
                      const std::string& description, double standard_error = unset) {
    if (std::isfinite(value)) {
        result.add(name, value, unit, description, standard_error);
    }
}

inline void add_known(MeasureResult& result, const std::string& name, const Eigen::VectorXd& values, const std::string& unit,
                      const std::string& description) {
    if (values.allFinite()) {
        result.add_vector(name, values, unit, description);
    }
}

/// The result of the calculation; what it refuses about the packing becomes NotApplicable.
template <class Calculate>
auto if_applicable(Calculate&& calculate) {
    try {
        return calculate();
    } catch (const std::invalid_argument& reason) {
        throw NotApplicable(reason.what());
    }
}

/// The pore-size curve of a packing that has one.
inline const PoreSizes& known_pores(const MeasureInput& input) {
    return *if_applicable([&] { return &input.pores(); });
}

}  // namespace coagula::characterize
