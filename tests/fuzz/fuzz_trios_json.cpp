// SPDX-License-Identifier: GPL-3.0-or-later
// TRIOS as JSON.
#include "measured_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return coagula::fuzz::read_by(coagula::io::trios_json_reader, data, size);
}
