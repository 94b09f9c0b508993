// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/mechanics/relaxation.hpp>

#include <coagula/common/contact_law.hpp>
#include <coagula/common/dem/relax.hpp>

#include <stdexcept>
#include <string>

namespace coagula::mechanics {

RelaxedNetwork relax(const Packing& packing, const ContactNetwork& bonds, const RelaxationOptions& options,
                     const Progress& progress) {
    require_positive(options.normal_stiffness, "the normal particle stiffness", "N/m");
    require_non_negative(options.shear_stiffness, "the shear particle stiffness", "N/m");
    dem::RelaxOptions stepping;
    stepping.normal_stiffness = stiffness_in_series(options.normal_stiffness, options.normal_stiffness);
    stepping.shear_stiffness = stiffness_in_series(options.shear_stiffness, options.shear_stiffness);
    stepping.method = options.scheme == RelaxationScheme::minimise ? dem::RelaxMethod::fire : dem::RelaxMethod::stopped_steps;
    stepping.tolerance = require_positive(options.tolerance, "the tolerance of the relaxation");
    const dem::Relaxation rest = dem::relax(packing, bonds, stepping, progress);
    if (!rest.converged) {
        throw std::runtime_error("the bonded packing did not come to rest: after " + std::to_string(rest.iterations) +
                                 " iterations the rms force is " + to_text(rest.rms_force) +
                                 " times the contact stiffness and the mean radius, the tolerance is " +
                                 to_text(options.tolerance));
    }
    RelaxedNetwork relaxed{rest.packing, rest.bonds, Eigen::Matrix3Xd(3, packing.size()), rest.rms_force, rest.iterations};
    for (Index particle = 0; particle < packing.size(); ++particle) {
        relaxed.displacement.col(particle) =
            packing.cell.minimum_image(rest.packing.positions.col(particle) - packing.positions.col(particle));
    }
    return relaxed;
}

}  // namespace coagula::mechanics
