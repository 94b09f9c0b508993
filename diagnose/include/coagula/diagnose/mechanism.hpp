// SPDX-License-Identifier: GPL-3.0-or-later
// The catalogue of causes. Each changes one link of the chain from the structures to the numbers that an instrument shows:
// structures and contacts, the modulus of the material, the geometry of the plates, the tool.
#pragma once

#include <coagula/common/contact_model.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/settings.hpp>

#include <compare>
#include <complex>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace coagula::diagnose {

class Simulator;
class StrainHistory;
struct Knows;
struct Observation;

/// A parameter with its physical range, over which the prior is uniform, or uniform in the logarithm.
struct MechanismParameter {
    std::string name;
    std::string unit;  ///< UDUNITS text
    double low;
    double high;
    bool logarithmic;
    /// The place of a fit is a multiple of this, where it is not 0: runs that take long serve other fits again.
    double step = 0;
    /// Where it is not 0, the prior is about uniform from minus this to this, and uniform in the logarithm beyond: for what has
    /// either sign and may be as small as one knows.
    double small = 0;

    /// The value at a place 0 .. 1 of the prior, and back.
    double at(double place) const;
    double place_of(double given) const;
    /// The place where a fit ends that is best at this one.
    double rounded(double place) const;
};

/// Values of the parameters of a mechanism, in their order.
using Values = std::span<const double>;

/// Knowledge of a material: the experiment, the structures and how they are simulated.
struct SimulatedSample {
    const Experiment& experiment;
    Simulator& simulator;
    const Settings& settings;
    const StrainHistory& history;
    bool exact;  ///< run the simulator at the settings themselves instead of between the nodes of its grids
};

/// Other structures, contacts or images: what the simulation runs.
struct ChangesSimulation {
    void (*set)(Settings& settings, Values values);
};

/// A factor on the modulus of the material in a row.
struct ScalesMaterial {
    std::complex<double> (*factor)(const Observation& row, Values values, const SimulatedSample& sample);
    bool in_oil = false;  ///< an oil in place of the sample shows it, too
};

/// A law of the material that is the same in both directions and has no memory: stress over strain at a momentary strain, over that
/// of small strains. Moduli and third harmonics of an oscillation follow from it.
struct BendsStress {
    double (*secant)(double strain, Values values);
};

/// The modulus that plates or cone show of one of the material [Pa].
struct ChangesGeometry {
    std::complex<double> (*apparent)(std::complex<double> modulus, const Observation& row, Values values);
};

/// The modulus that the tool shows [Pa].
struct ChangesTool {
    std::complex<double> (*apparent)(std::complex<double> modulus, const Observation& row, Values values);
};

using Effect = std::variant<ChangesSimulation, ScalesMaterial, BendsStress, ChangesGeometry, ChangesTool>;

/// The link of the chain from the structures to the numbers that an instrument shows.
enum class Link { structure, material, history, geometry, tool, errors };
/// "structure", "material", "history", "geometry", "tool", "errors".
const char* name_of(Link link);

/// A departure follows one of these.
enum class Axis {
    time,
    age,
    strain,
    frequency,
    shear_rate,
    gap,
    radius,
    normal_force,
    volume_fraction,
    coordination,
    heterogeneity,
    distance,
    pore_radius,
    sample,
    level  ///< none: it is the same in every row
};
/// "time", "age", "strain", "frequency", ...
const char* name_of(Axis axis);

/// A kind of departure: where it acts and what it follows.
struct Kind {
    Link link;
    Axis axis;

    auto operator<=>(const Kind&) const = default;  // NOLINT(modernize-use-nullptr): a false alarm of clang-tidy 14
};

/// This tells a mechanism from others that follow the same axis, also from those that the catalogue does not have.
struct Separation {
    bool (*holds)(const Knows& knows) = nullptr;  ///< whether an experiment has it; null: as the kind of the mechanism says
    std::string by = {};                          ///< what to measure, in words
};

/// One cause.
struct Mechanism {
    std::string name;       ///< "bond-bending"
    std::string term;       ///< what it changes, in words
    std::string signature;  ///< what it does to the data, in words
    Kind kind;
    std::vector<MechanismParameter> parameters;
    Effect effect;
    /// Whether an experiment says what the mechanism needs (a gap, a plate radius), so that it can be a cause at all.
    bool (*applies)(const Knows& knows);
    Separation told_apart = {};
    /// A change of the material that needs no particles: a Newtonian fluid shows it, too.
    bool in_any_fluid = false;
    bool in_contact = false;  ///< `coagula shear --model` can run it
    /// Its term in the model of the contact, where `effect` alone does not say it.
    void (*contact)(ContactModel& model, Values values) = nullptr;
};

/// All of them. Those of the geometry, and those of the tool, act in this order.
std::span<const Mechanism> catalogue();

/// Whether a mechanism can be a cause in an experiment: what has no particles has no contacts and no structure.
bool can_act(const Mechanism& mechanism, const Experiment& experiment);

/// Null when there is none of this name.
const Mechanism* find_mechanism(const std::string& name);

/// Throws InputError when one of these names no cause of the catalogue.
void require_causes(const std::vector<std::string>& names);

/// Whether a mechanism is among these names; no names stand for all.
bool is_asked_for(const Mechanism& mechanism, const std::vector<std::string>& names);

}  // namespace coagula::diagnose
