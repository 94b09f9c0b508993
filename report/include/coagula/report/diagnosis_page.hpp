// SPDX-License-Identifier: GPL-3.0-or-later
// report.html: what a diagnosis found, as one page that needs no other file.
#pragma once

#include <coagula/diagnose/diagnosis.hpp>
#include <coagula/diagnose/noise.hpp>
#include <coagula/io/structure_file.hpp>

#include <string>
#include <vector>

namespace coagula::report {

/// All that the page and the HDF5 file are made from.
struct DiagnosisRecord {
    const diagnose::Experiment& experiment;
    const diagnose::Diagnosis& diagnosis;
    const std::vector<diagnose::NoiseModel>& noise;
    const diagnose::ErrorSpec& errors;
    io::Provenance provenance;
    std::vector<std::string> structures;  ///< one sentence each
    double level;                         ///< of the test
    std::string model;                    ///< path of the extended model; empty: none
    std::vector<std::string> calls;       ///< that make the structures of the best cause; empty: it changes none
    std::vector<std::string> notes;       ///< what a reader should know about the data and structures
};

/// The verdict in a sentence or two.
std::string verdict_sentence(const diagnose::Diagnosis& found);

/// That, then what the best cause leaves over and what to measure next, where there is such.
std::vector<std::string> verdict_sentences(const diagnose::Diagnosis& found);

/// Says what to measure that tells the best cause from look-alikes, where a single cause lacks nothing else to a name and says what
/// would; else empty.
std::string what_separates(const diagnose::Diagnosis& found);

/// HTML.
std::string diagnosis_page(const DiagnosisRecord& record);

}  // namespace coagula::report
