// SPDX-License-Identifier: GPL-3.0-or-later
#include "flexible.hpp"

#include "noise/low_rank.hpp"

#include <limits>

namespace coagula::diagnose {

Eigen::VectorXd flexible_prediction(const DataSet& data, const Eigen::VectorXd& base, const std::vector<Index>& known,
                                    const SmoothDepartures& departures) {
    const RowNoise noise = data.part(known).noise;
    const Eigen::VectorXd white = noise.whiten((data.values - base)(known));
    const Eigen::VectorXd level = complex_moduli(data.observations, base);
    double best = -std::numeric_limits<double>::infinity();
    Eigen::VectorXd prediction = base;
    for (const std::vector<SmoothDeparture>& group : departures) {
        for (const SmoothDeparture& departure : group) {
            const Eigen::MatrixXd directions = level.asDiagonal() * departure.factor;
            NormalEffects effects(white, noise.whitened(directions(known, Eigen::all)));
            for (const double amplitude : smooth_amplitudes) {
                effects.solve(0, Eigen::VectorXd::Constant(directions.cols(), amplitude), {1.0});
                const double density = -0.5 * (effects.misfit() + effects.log_determinant());
                if (density > best) {
                    best = density;
                    prediction = base + amplitude * directions * effects.most_probable();
                }
            }
        }
    }
    return prediction;
}

}  // namespace coagula::diagnose
