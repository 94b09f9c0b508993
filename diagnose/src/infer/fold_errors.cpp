// SPDX-License-Identifier: GPL-3.0-or-later
#include "fold_errors.hpp"

#include <algorithm>
#include <string_view>

namespace coagula::diagnose {

namespace {

Column& column_of(Experiment& experiment, const Observation& one) {
    std::vector<Column>& columns = experiment.measurements[one.measurement].columns;
    const std::string_view name = observable_of(one).key;
    return *std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
}

}  // namespace

DataSet with_errors_of_the_rest(const DataSet& data, const std::vector<bool>& held_out, const Experiment& experiment,
                                const Eigen::VectorXd& structure_deviation, const DiagnosisOptions& options) {
    const std::vector<TableErrors>& errors = options.errors.tables;
    if (std::none_of(errors.begin(), errors.end(),
                     [](const TableErrors& one) { return one.source == ErrorSource::noise && !one.columns.empty(); })) {
        return data;
    }
    Experiment rest = experiment;
    for (std::size_t k = 0; k < data.observations.size(); ++k) {
        const Observation& one = data.observations[k];
        if (held_out[k] && is_modulus_or_viscosity(one)) {
            column_of(rest, one).values[one.row] = unset;
        }
    }
    const std::vector<NoiseModel> noise = noise_of_tables(rest.measurements, options.stated_noise);
    DataSet found = data_set_of(experiment, estimated_errors(experiment, noise, options.stated_noise, options.errors));
    found.noise.widen(structure_deviation);
    return found;
}

}  // namespace coagula::diagnose
