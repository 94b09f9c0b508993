// SPDX-License-Identifier: GPL-3.0-or-later
// Scalars of the measures by name.
#pragma once

#include <coagula/characterize/measure.hpp>

#include <stdexcept>
#include <string>

namespace coagula::characterize::test {

/// The scalar at /characterization/<name>. Throws std::out_of_range if there is none.
inline double scalar(const MeasureResult& result, const std::string& name) {
    for (const Dataset& dataset : result.datasets) {
        if (dataset.path == "/characterization/" + name) {
            return std::get<std::vector<double>>(dataset.values).at(0);
        }
    }
    throw std::out_of_range("no " + name);
}

}  // namespace coagula::characterize::test
