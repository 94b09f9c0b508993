// SPDX-License-Identifier: GPL-3.0-or-later
#include "shared_errors.hpp"

#include "data/table_cells.hpp"
#include "responses/imaged_centres.hpp"
#include "responses/pore_response.hpp"

#include <cmath>
#include <cstddef>

namespace coagula::diagnose {

namespace {

/// Adds columns of zeros.
void add_columns(Eigen::MatrixXd& errors, Index count) {
    errors.conservativeResizeLike(Eigen::MatrixXd::Zero(errors.rows(), errors.cols() + count));
}

/// Errors of images: those of the structures, which all images share, then each image's own.
Eigen::MatrixXd errors_of_images(const std::vector<Observation>& observations, Simulator& simulator) {
    Eigen::MatrixXd all(static_cast<Index>(observations.size()), 0);
    Eigen::MatrixXd of_structures;
    Eigen::MatrixXd own;
    std::size_t image = observations.size();  // the measurement whose own errors are the last columns
    for (std::size_t k = 0; k < observations.size(); ++k) {
        const Observation& observation = observations[k];
        const auto* seen = as<Neighbours>(observation);
        if (seen == nullptr) {
            continue;
        }
        if (all.cols() == 0) {
            of_structures = neighbour_errors_of_structures(simulator);
            add_columns(all, of_structures.cols());
        }
        if (image != observation.measurement) {
            image = observation.measurement;
            own = neighbour_errors_of_image(simulator, seen->centres, seen->mutual);
            add_columns(all, own.cols());
        }
        const auto shells = Eigen::seqN(static_cast<Index>(observation.row), static_cast<Index>(seen->shells));
        all.row(static_cast<Index>(k)).head(of_structures.cols()) = of_structures(shells, Eigen::all).colwise().sum();
        all.row(static_cast<Index>(k)).tail(own.cols()) = own(shells, Eigen::all).colwise().sum();
    }
    return all;
}

}  // namespace

Eigen::MatrixXd errors_of_pores(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator,
                                const StructureChange& change) {
    std::vector<std::size_t> rows;
    std::vector<double> radii;
    for (std::size_t k = 0; k < observations.size(); ++k) {
        if (const auto* pore = as<Pore>(observations[k])) {
            rows.push_back(k);
            radii.push_back(pore->radius * simulator.radius() / experiment.sample.particle_radius);
        }
    }
    Eigen::MatrixXd all(static_cast<Index>(observations.size()), 0);
    if (rows.empty()) {
        return all;
    }
    const Eigen::MatrixXd errors = pore_errors(simulator, change, radii);
    add_columns(all, errors.cols());
    all(rows, Eigen::all) = errors / std::sqrt(static_cast<double>(simulator.structures()));
    std::size_t table = observations.size();  // the measurement whose sample's errors are the last columns
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t number = observations[rows[k]].measurement;
        if (!find_column(experiment.measurements[number], "exclusion_probability")->standard_errors.empty()) {
            continue;
        }
        if (table != number) {
            table = number;
            add_columns(all, errors.cols());
        }
        all.row(static_cast<Index>(rows[k])).tail(errors.cols()) = errors.row(static_cast<Index>(k));
    }
    return all;
}

Eigen::MatrixXd shared_errors(const Experiment& experiment, const std::vector<Observation>& observations, Simulator& simulator) {
    const Eigen::MatrixXd images = errors_of_images(observations, simulator);
    const Eigen::MatrixXd pores = errors_of_pores(experiment, observations, simulator, {});
    Eigen::MatrixXd all(images.rows(), images.cols() + pores.cols());
    all << images, pores;
    return all;
}

}  // namespace coagula::diagnose
