// SPDX-License-Identifier: GPL-3.0-or-later
// Every format of measured tables: which it is, the content says.
#include "measured_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string path = fuzz::input_file(data, size, "measured.csv");
    fuzz::expect_value_or_sentence(path, [&] { fuzz::check_file(io::read_measured_file(path)); });
    return 0;
}
