// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/stepper.hpp>

namespace coagula::dem {

void check(const StepOptions& options) {
    require_positive(options.time_step, "the time step", "s");
    require(options.damping >= 0 && options.damping < 1,
            "the damping coefficient is " + to_text(options.damping) + ", but must lie in [0, 1)");
}

double rms_force(const ParticleSystem& system, Index particles) {
    const Index last = particles < 0 ? system.size() : particles;
    const Slots& slots = system.slots();
    Index counted = 0;
    double sum = 0;
    for (const Chunk& chunk : system.chunks()) {
        for (std::size_t slot = detail::at(chunk.begin); slot < detail::at(chunk.own_end); ++slot) {
            if (slots.particle[slot] < last && slots.inverse_mass[slot] > 0) {
                sum += slots.force[slot].squaredNorm();
                ++counted;
            }
        }
    }
    return counted > 0 ? std::sqrt(sum / static_cast<double>(counted)) : 0.0;
}

}  // namespace coagula::dem
