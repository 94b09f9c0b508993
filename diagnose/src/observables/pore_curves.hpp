// Pore curves: what a table of them says, with its errors.
#pragma once

#include "observations.hpp"

#include <cmath>
#include <vector>

namespace coagula::diagnose {

inline bool is_pore(const Observation& observation) {
    return std::isfinite(observation.pore_radius);
}

/// The rows of a table of kind pore-curve with a probability between 0.01 and 1, ends excluded: at r = 0 all structures agree, and
/// beyond 0.01 one largest pore decides. Needs the particle radius.
///
/// The error of a row has two parts. That of the table itself is independent of its neighbours; where none is stated it is that of
/// a curve sampled in a hundred thousand points. The scatter from structure to structure (`scatter_of_probability`) is that of
/// the simulated structures, and of the sample too where its errors are not stated: the sample is then taken to be as large as a
/// simulated structure. Curves scatter as a whole, so that this part is nearly the same in neighbouring rows.
std::vector<Observation> pores_in(const Experiment& experiment, std::size_t number);

/// Standard deviation of the probability p at one pore radius between periodic structures of so many particles: 0.2 p ln^2(p) /
/// sqrt(particles). Found with void expansion structures of 300 particles at two degrees of heterogeneity, where it holds to a
/// third from p = 0.9 to 0.001 (tests: PoreCurves.ScatterFromStructureToStructure).
double scatter_of_probability(double probability, double particles);

}  // namespace coagula::diagnose
