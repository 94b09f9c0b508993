// SPDX-License-Identifier: GPL-3.0-or-later
// From a model to the numbers that an instrument would show, for every observation of an experiment: structures and contacts ->
// modulus of the material -> geometry -> tool.
#pragma once

#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/model.hpp>
#include <coagula/diagnose/run_clock.hpp>
#include <coagula/diagnose/simulator.hpp>

#include "data/strain_history.hpp"
#include "noise/prediction.hpp"
#include "observables/observations.hpp"
#include "responses/amplitude_response.hpp"
#include "responses/linear_modulus.hpp"
#include "responses/response.hpp"
#include "smooth_material.hpp"
#include "uncertain_moduli.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace coagula::diagnose {

/// Bonds as weak as the weaker of the two causes makes them.
Settings with_weakest_bonds(Settings settings);

/// An oscillation as bonds feel it: the strain at 1 Hz that takes as large a part of their strength.
struct BondStrain {
    double amplitude = unset;  ///< NaN where the row has no strain
    double before = 0;         ///< the largest before it on the sample, 0: none
};

/// Throws InputError unless structures stand for every row of a structure series.
void check_structure_series(const Experiment& experiment, const std::vector<Observation>& observations);

/// Predicts observations. Each thread needs a copy of its own.
class Forward {
public:
    Forward(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator);

    /// @param exact run the simulator at the settings themselves instead of between the nodes of its grids.
    Eigen::VectorXd predict(const Model& model, bool exact = false) const;
    /// Between the nodes, with these errors of the prediction.
    Eigen::VectorXd predict(const Model& model, const Eigen::VectorXd& errors) const;

    /// The same between the nodes, with how it changes with the level of a sample and with the independent standard errors that so
    /// few structures leave: in how they yield (amplitude_response), in the responses of the network (Scatter), and in what images
    /// and pore curves show (shared_errors), last. About those errors of a smooth material that the data ask for; else about none.
    Prediction prediction(const Model& model) const;
    /// The same about these errors.
    Prediction prediction(const Model& model, const Eigen::VectorXd& errors) const;
    /// How a prediction changes where the logarithm of the stiffness grows by a small step and its errors stay.
    Prediction change_by_stiffness(const Model& model, const Prediction& here, double step) const;

    /// Whether the prediction of a model is not linear in its errors.
    bool is_nonlinear(const Model& model) const { return remembered_material(model, false).logarithms.cols() > 0; }
    /// How many errors the prediction of a model has.
    Index errors_of(const Model& model) const { return remembered_material(model, false).errors() + shared_.cols(); }

    const Experiment& experiment() const { return experiment_; }
    Simulator& simulator() const { return simulator_; }

    /// Standard deviation of the error that so few structures leave in the prediction of the rows of structure series
    /// (structure_error) where these have about such values: in proportion to the base model, because a value that is
    /// low by chance is no less uncertain. Zero elsewhere, where it scales all rows alike.
    Eigen::VectorXd structure_deviation(const Eigen::VectorXd& values) const;

    /// The same for the level of all other rows, relative to it.
    double level_error() const { return experiment_.material.kind == MaterialKind::network ? structure_error(simulator_) : 0.0; }

    bool is_smooth() const { return smooth_.has_value(); }

    /// Whether an observation is in proportion to the stiffness of the particles, or to the viscosity of a Newtonian material.
    bool scales(const Observation& observation) const {
        return is_modulus_or_viscosity(observation) && !is_fluid(observation) && experiment_.material.kind != MaterialKind::smooth;
    }

private:
    std::complex<double> seen_by_instrument(const Model& model, std::size_t number, std::complex<double> modulus) const;
    double seen_of_structure(const Settings& settings, const Observation& observation, bool exact) const;
    bool strain_varies(const Settings& settings, const Observation& observation) const;
    Eigen::VectorXcd breaking_response(const Settings& settings, const Observation& observation, const BondStrain& strain) const;
    std::vector<Yielded> exact_breaking_response(const Settings& settings, const Observation& observation,
                                                 const std::vector<double>& amplitudes) const;
    std::complex<double> third_harmonic(const Model& model, const Settings& given, const Observation& observation,
                                        const BondStrain& bonds) const;
    std::array<double, 4> storage_while_breaking(const Settings& settings, const Observation& observation, const BondStrain& strain,
                                                 double sine) const;
    std::vector<double> strains_before(std::size_t table, const std::vector<double>& strains) const;
    std::vector<double> growing_strains(std::size_t table, const std::vector<double>& strains) const;
    Eigen::VectorXcd exact_amplitude_factors(const Settings& settings) const;
    std::vector<double> largest_strains_before(const std::vector<double>& strains) const;
    std::vector<BondStrain> bond_strains(const Settings& settings) const;
    Eigen::MatrixXcd amplitude_factors(const Settings& given, bool exact) const;
    Eigen::VectorXcd factors_of(const Response& response, const Settings& settings, bool exact) const;
    Eigen::VectorXcd linear_responses(const Settings& settings, bool exact) const;
    /// Returns for every observation the first one whose conditions are the same to a response.
    const std::vector<std::size_t>& first_alike(const Response& response) const {
        return response.follows_strain ? first_of_row_ : first_of_frequency_;
    }
    UncertainModuli material(const Model& model, bool exact) const;
    UncertainModuli network(const Model& model, bool exact) const;
    void scale(UncertainModuli& moduli, const Model& model, bool exact) const;
    void replace_fluids(UncertainModuli& moduli) const;
    void add_scatter(const Response& response, const Settings& settings, UncertainModuli& moduli) const;
    static bool shows_in_proportion(const Model& model);
    const Eigen::MatrixXd& shared_errors_of(const Model& model) const;
    const UncertainModuli& remembered_material(const Model& model, bool exact) const;
    Eigen::VectorXd seen(const Model& model, const Eigen::VectorXcd& moduli, bool exact) const;
    Eigen::VectorXd level_slope(const Model& model, const Eigen::VectorXcd& moduli, const Eigen::VectorXd& values) const;
    Eigen::MatrixXd changes_by_instrument(const Model& model, const Eigen::MatrixXcd& moduli, const Eigen::VectorXd& values) const;

    const Experiment& experiment_;
    const std::vector<Observation>& observations_;
    std::vector<std::size_t> first_of_row_;        ///< of every observation the first one that shows the same G*
    std::vector<std::size_t> first_of_frequency_;  ///< ... at the same frequency, of the same structures
    Simulator& simulator_;
    std::vector<RunTime> runs_;
    StrainHistory history_;
    std::vector<BondStrain> bond_strains_;  ///< where strength does not depend on the frequency
    std::optional<SmoothMaterial> smooth_;
    // The material of the last call: fits vary stiffness and instrument more often than anything else.
    mutable Settings last_settings_;
    mutable std::vector<ActingMechanism> last_acting_;
    mutable UncertainModuli last_material_;
    mutable Eigen::MatrixXd shared_;         ///< errors of images and pore curves (shared_errors) ...
    mutable StructureChange shared_change_;  ///< ... of structures with this change
};

}  // namespace coagula::diagnose
