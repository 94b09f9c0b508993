// SPDX-License-Identifier: GPL-3.0-or-later
// CSV with or without titles, headings and units.
#include "measured_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return coagula::fuzz::read_by(coagula::io::csv_reader, data, size);
}
