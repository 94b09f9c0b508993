// SPDX-License-Identifier: GPL-3.0-or-later
// Table 2 of Schenker, Filser, Hütter, Gauckler, Granular Matter 14 (2012) 333, as datasets/schenker2012 has it.
#pragma once

#include <string>
#include <vector>

namespace coagula::report {

/// The text of published_structures.csv.
extern const char* const published_structures_csv;

struct PublishedStructure {
    std::string generator;  ///< "vem" or "brownian"
    double parameter;       ///< number of voids, or surface potential [mV]
    double a;
    double coordination;
    double modulus;  ///< [Pa] at particle stiffnesses of 100 and 10 N/m
    double spread;   ///< of the modulus over six orientations [Pa]
};

/// The eleven rows.
std::vector<PublishedStructure> published_structures();

}  // namespace coagula::report
