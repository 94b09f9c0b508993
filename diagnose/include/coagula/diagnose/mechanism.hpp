// The catalogue of causes: each is a term of the simulation or of the instrument with its parameters.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/settings.hpp>

#include <span>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// A parameter with its physical range, over which the prior is uniform (or uniform in the logarithm).
struct MechanismParameter {
    std::string name;
    std::string unit;  ///< UDUNITS text
    double low;
    double high;
    bool logarithmic;
    double Settings::*value;
    /// The place of a fit is a multiple of this, where it is not 0: runs that take long serve other fits again.
    double step = 0;

    /// The value at a place 0 .. 1 of the prior, and back.
    double at(double place) const;
    double place_of(double value) const;
    /// The place where a fit ends that is best at this one.
    double rounded(double place) const;
};

/// One cause.
struct Mechanism {
    std::string name;       ///< "bond-bending"
    std::string term;       ///< what it changes, in words
    std::string signature;  ///< what it does to the data, in words
    std::vector<MechanismParameter> parameters;
    bool in_contact;  ///< a term of the contact model, which `coagula shear --model` can run; else of the instrument or the
                      ///< structure
    /// Whether an experiment says what the mechanism needs (a gap, a plate radius), so that it can be a cause at all.
    bool (*applies)(const Experiment& experiment);
};

/// All of them.
std::span<const Mechanism> catalogue();

/// Null when there is none of this name.
const Mechanism* find_mechanism(const std::string& name);

/// Throws InputError when one of these names no cause of the catalogue.
void require_causes(const std::vector<std::string>& names);

/// Whether a mechanism is among these names; no names stand for all.
bool is_asked_for(const Mechanism& mechanism, const std::vector<std::string>& names);

}  // namespace coagula::diagnose
