// SPDX-License-Identifier: GPL-3.0-or-later
// The options of a stage in the provenance of a file, which coagula info prints as JSON.
#include <coagula/stages/recorded_options.hpp>

#include "reader_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string path = "packing.h5";
    fuzz::expect_value_or_sentence(path, [&] {
        const stages::Json options = stages::recorded_options(path, std::string(fuzz::text_of(data, size)));
        const bool readable = options.is_string() || stages::Json::parse(options.dump()) == options;
        fuzz::expect(readable, "the options are not read back from what is printed of them");
    });
    return 0;
}
