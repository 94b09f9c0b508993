// From settings to the numbers that an instrument would show, for every observation of an experiment.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/settings.hpp>
#include <coagula/diagnose/simulator.hpp>

#include "model_errors.hpp"
#include "observations.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// Bonds as weak as the weaker of the two causes makes them.
Settings with_weakest_bonds(Settings settings);

/// Predicts observations. Not for several threads at once.
class Forward {
public:
    Forward(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator);

    /// @param exact run the simulator at the settings themselves instead of between the nodes of its grids.
    Eigen::VectorXd predict(const Settings& settings, bool exact = false) const;

    const Experiment& experiment() const { return experiment_; }

    /// What the prediction changes by, a column for each of the independent standard errors that so few structures leave in the way
    /// in which they yield (Simulator::amplitude_response); no columns where no bonds break or there is one structure.
    ModelErrors yield_errors(const Settings& settings) const;

    /// Standard deviation of the error that so few structures leave in the prediction of the rows of structure series
    /// (Simulator::structure_error) where these have about such values: in proportion to the base model, because a value that is
    /// low by chance is no less uncertain. Zero elsewhere, where it scales all rows alike.
    Eigen::VectorXd structure_deviation(const Eigen::VectorXd& values) const;

    /// The same for the level of all other rows, relative to it.
    double level_error() const { return simulator_.structure_error(); }

private:
    std::complex<double> seen_by_instrument(const Settings& settings, const Observation& observation,
                                            std::complex<double> modulus) const;
    double gradient_factor(const Settings& settings, const Observation& observation, double exponent) const;
    bool strain_varies(const Settings& settings, const Observation& observation) const;
    Eigen::VectorXcd breaking_response(const Settings& settings, const Observation& observation, double before) const;
    std::vector<Yielded> exact_breaking_response(const Settings& settings, const Observation& observation,
                                                 const std::vector<double>& amplitudes) const;
    std::complex<double> third_harmonic(const Settings& settings, const Observation& observation, double before) const;
    double storage_while_breaking(const Settings& settings, const Observation& observation, double before, double phase) const;
    std::vector<double> strains_before(std::size_t table) const;
    std::vector<double> growing_strains(std::size_t table) const;
    Eigen::VectorXcd exact_amplitude_factors(const Settings& settings) const;
    std::vector<double> largest_strains_before() const;
    Eigen::MatrixXcd amplitude_factors(const Settings& settings, bool exact) const;
    std::map<std::size_t, double> linear_moduli(const Settings& settings, bool exact) const;
    Eigen::MatrixXcd material(const Settings& settings, bool exact) const;
    const Eigen::MatrixXcd& remembered_material(const Settings& settings, bool exact) const;
    Eigen::VectorXd seen(const Settings& settings, const Eigen::VectorXcd& moduli, bool exact) const;

    const Experiment& experiment_;
    const std::vector<Observation>& observations_;
    Simulator& simulator_;
    std::vector<double> largest_strains_before_;
    // The material of the last call: fits vary stiffness and instrument more often than anything else.
    mutable Settings last_settings_;
    mutable Eigen::MatrixXcd last_material_;
};

}  // namespace coagula::diagnose
