#include "step_scheme.hpp"

#include <coagula/common/checks.hpp>

#include <cmath>
#include <string>

namespace coagula::generators {

StepScheme euler_maruyama() {
    StepScheme scheme;
    scheme.stages = {{.force = 1, .noise = 1}};
    return scheme;
}

StepScheme stabilised_scheme(int stages, double damping) {
    require(stages >= 1, "the number of stages is " + std::to_string(stages) + ", but a step needs at least 1");
    require_non_negative(damping, "the damping of the stabilised step");
    const auto s = static_cast<std::size_t>(stages);
    const double number = stages;
    const double w0 = 1 + damping / (number * number);
    // Chebyshev polynomials of the first kind, and their first and second derivatives, at w0.
    std::vector<double> value{1, w0};
    std::vector<double> slope{0, 1};
    std::vector<double> bend{0, 0};
    for (std::size_t i = 2; i <= s; ++i) {
        value.push_back(2 * w0 * value[i - 1] - value[i - 2]);
        slope.push_back(2 * value[i - 1] + 2 * w0 * slope[i - 1] - slope[i - 2]);
        bend.push_back(4 * slope[i - 1] + 2 * w0 * bend[i - 1] - bend[i - 2]);
    }
    const double w1 = value[s] / slope[s];
    StepScheme scheme;
    scheme.stages.push_back({.force = w1 / w0, .noise = number * w1 / w0});
    for (std::size_t i = 2; i <= s; ++i) {
        const double current = 2 * w0 * value[i - 1] / value[i];
        scheme.stages.push_back({.force = 2 * w1 * value[i - 1] / value[i], .current = current, .previous = 1 - current});
    }
    scheme.evaluation = number * w1 / 2;
    // |A(p)| <= 1 as long as w0 + w1 p >= -1.
    scheme.stability = (w0 + 1) / w1;
    // A mode with p = -q is multiplied by A = 1 - q + second q^2 and receives B = 1 - growth q times the noise: its variance falls
    // short of the exact 1/(2 q) by growth - (1 + 2 second)/4. B is U_(s-1)(w0 + w1 p)/U_(s-1)(w0) (1 + w1 p/2), U_(s-1) = T_s'/s.
    const double second = bend[s] * w1 * w1 / (2 * value[s]);
    const double growth = w1 / 2 + w1 * bend[s] / slope[s];
    scheme.observation = std::sqrt(std::max(0.0, growth - (1 + 2 * second) / 4));
    return scheme;
}

}  // namespace coagula::generators
