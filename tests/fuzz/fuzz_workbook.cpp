// SPDX-License-Identifier: GPL-3.0-or-later
// Old Excel workbooks, read by FreeXL in a child process as in the program: what FreeXL does with damaged files does not count, but
// that the child ends in time and the program goes on with a table or a sentence.
#include "measured_contract.hpp"
#include "read_workbook.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string path = fuzz::input_file(data, size, "measured.xls");
    fuzz::expect_value_or_sentence(path, [&] { fuzz::check_file(io::read_workbook(path)); });
    return 0;
}
