// SPDX-License-Identifier: GPL-3.0-or-later
// Anton Paar RheoCompass.
#include "measured_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return coagula::fuzz::read_by(coagula::io::rheocompass_reader, data, size);
}
