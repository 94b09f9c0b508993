// From settings to the numbers that an instrument would show, for every observation of an experiment.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// One number that was measured.
struct Observation {
    std::size_t measurement;
    std::size_t row;
    bool loss;              ///< G'', else G'
    double value;           ///< [Pa]
    double standard_error;  ///< [Pa]; NaN where the table has none
    // Where and when; NaN where the table does not say.
    double strain;             ///< amplitude
    double angular_frequency;  ///< [rad/s]
    double time;               ///< since the first run on the sample [s]
    double gap;                ///< [m]
    double plate_radius;       ///< [m]
    ErrorLaw errors = {};
};

/// The moduli of all tables of moduli, row by row, cells that were left out skipped.
std::vector<Observation> observations_of(const Experiment& experiment);

/// Predicts observations. Not for several threads at once.
class Forward {
public:
    Forward(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator);

    /// @param exact run the simulator at the settings themselves instead of between the nodes of its grids.
    Eigen::VectorXd predict(const Settings& settings, bool exact = false) const;

    const Experiment& experiment() const { return experiment_; }

private:
    std::complex<double> seen_by_instrument(const Settings& settings, const Observation& observation,
                                            std::complex<double> modulus) const;
    std::vector<std::complex<double>> amplitude_factors(const Settings& settings, bool exact) const;
    std::vector<std::complex<double>> material(const Settings& settings, bool exact) const;

    const Experiment& experiment_;
    const std::vector<Observation>& observations_;
    Simulator& simulator_;
    // The material of the last call: fits vary stiffness and instrument more often than anything else.
    mutable Settings last_settings_;
    mutable std::vector<std::complex<double>> last_material_;
};

}  // namespace coagula::diagnose
