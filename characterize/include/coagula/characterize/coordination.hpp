// Coordination number, rattlers and overlaps.
#pragma once

#include <coagula/common/checks.hpp>
#include <coagula/common/contact_network.hpp>
#include <coagula/common/packing.hpp>

#include <Eigen/Core>

namespace coagula::characterize {

struct CoordinationOptions {
    double contact_tolerance = 0.01;  ///< pairs nearer than (1 + tolerance) (r_i + r_j) are in contact
};

struct Coordination {
    double mean = unset;                   ///< contacts per particle, rattlers included
    double mean_without_rattlers = unset;  ///< contacts among the others, per such particle
    double rattler_fraction = unset;  ///< particles that carry no load: those left with fewer than two contacts when such particles
                                      ///< are removed again and again
    double below_three_fraction = unset;  ///< particles with fewer than three contacts
    Eigen::VectorXi counts;               ///< N, contacts of each particle
    Eigen::VectorXi histogram;            ///< number of particles with 0, 1, 2 ... contacts
    ContactNetwork contacts;
};

Coordination measure_coordination(const Packing& packing, const CoordinationOptions& options = {});

/// Overlap of the contacts as a fraction of r_i + r_j; zero for pairs that do not overlap.
struct Overlaps {
    double mean = unset;  ///< over the overlapping pairs; 0 if there are none
    double rms = unset;
    double max = unset;
    Index pairs = 0;  ///< number of overlapping pairs
};
Overlaps measure_overlaps(const Packing& packing);

}  // namespace coagula::characterize
