// SPDX-License-Identifier: GPL-3.0-or-later
// The experiment file: TOML that names a sample, an instrument and tables of measured data (docs/reference/experiment-file.md).
#pragma once

#include <coagula/experiment/export_metadata.hpp>

#include <coagula/common/checks.hpp>
#include <coagula/diagnose/measurement.hpp>
#include <coagula/diagnose/noise.hpp>

#include <string>
#include <utility>
#include <vector>

namespace coagula::experiment {

/// Facts about the table of a measurement besides its columns.
struct TableFacts {
    std::vector<std::string> not_understood;                 ///< columns with numbers, as "'heading [unit]'"
    std::vector<std::pair<std::string, std::size_t>> flags;  ///< of a status column, and in how many rows
};

struct ExperimentFile {
    diagnose::Experiment experiment;
    diagnose::StatedNoise noise;
    double expected_storage_modulus = unset;  ///< at small strain, of planned measurements [Pa]
    std::vector<std::string> files;           ///< that it names
    std::vector<TableFacts> facts;            ///< one per measurement
    std::vector<TakenOver> taken_over;        ///< from the exports
    std::vector<std::string> notes;           ///< what is worth knowing but no error, such as fewer points than announced
};

/// Reads the file and the tables it names, in SI units; unreadable cells are listed in `left_out`. Paths are relative to the folder
/// of the file. Throws InputError with a sentence that names the file, the key or column and the rule.
ExperimentFile read_experiment(const std::string& path);

/// Returns the result of `work` with an experiment; an InputError of it names the experiment file first.
template <typename Work>
auto naming(const std::string& path, const Work& work) {
    try {
        return work();
    } catch (const InputError& error) {
        throw InputError(path + ": " + error.what());
    }
}

}  // namespace coagula::experiment
