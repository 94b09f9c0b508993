// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/table.hpp>

#include "reader_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string path = fuzz::input_file(data, size, "table.csv");
    fuzz::expect_value_or_sentence(path, [&] {
        const auto columns = io::read_table(path, {{.name = "a", .unit = "1"},
                                                   {.name = "modulus", .unit = "Pa", .default_unit = 1e6},
                                                   {.name = "error", .unit = "Pa", .required = false}});
        for (const Eigen::VectorXd& column : columns) {
            fuzz::expect(column.size() == columns[0].size() || column.size() == 0, "a column is shorter than the first");
            fuzz::expect(column.allFinite(), "a number is not finite");
        }
    });
    return 0;
}
