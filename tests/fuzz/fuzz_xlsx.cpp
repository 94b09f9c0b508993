// SPDX-License-Identifier: GPL-3.0-or-later
// Workbooks of XML in this process, without the child in which the program reads them.
#include "measured_contract.hpp"
#include "workbook_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string path = fuzz::input_file(data, size, "measured.xlsx");
    fuzz::expect_value_or_sentence(path, [&] { io::text_of_xlsx(path); });
    return 0;
}
