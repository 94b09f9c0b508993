// SPDX-License-Identifier: GPL-3.0-or-later
// Values and draws of a fitted hypothesis.
#include "hypothesis.hpp"

#include <algorithm>

namespace coagula::diagnose {

std::vector<double> Fit::values() const {
    std::vector<double> all;
    for (const Mechanism* mechanism : hypothesis) {
        const auto found = std::find_if(model.acting.begin(), model.acting.end(),
                                        [&](const ActingMechanism& one) { return one.mechanism == mechanism; });
        all.insert(all.end(), found->values.begin(), found->values.end());
    }
    return all;
}

std::vector<Model> Fit::drawn(Index count) const {
    std::vector<Model> models;
    for (Index draw = 0; draw < count; ++draw) {
        const Eigen::VectorXd place = draws.col(draw * draws.cols() / count);
        models.emplace_back(hypothesis, Values(place.data() + 1, static_cast<std::size_t>(place.size()) - 1), place[0]);
    }
    return models;
}

}  // namespace coagula::diagnose
