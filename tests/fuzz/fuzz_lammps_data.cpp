// SPDX-License-Identifier: GPL-3.0-or-later
#include "packing_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return coagula::fuzz::read_packing(data, size, coagula::io::TextFormat::lammps_data);
}
