// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/units.hpp>

#include "reader_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string text(fuzz::text_of(data, size));
    for (const std::string unit : {"m", "1", "N/m", "Pa.s", "rad/s", "Hz", "K"}) {
        fuzz::expect_value_or_sentence("is not", [&] {
            fuzz::expect(std::isfinite(io::parse_quantity(text, unit)), "the quantity is not finite in " + unit);
        });
        fuzz::expect_value_or_sentence("is not", [&] {
            const double factor = io::unit_factor(text, unit);
            fuzz::expect(std::isfinite(factor) && factor > 0, "the unit is worth " + to_text(factor) + " " + unit);
        });
        fuzz::expect_value_or_sentence("is not", [&] {
            const double one = io::convert({1.0}, text, unit)[0];
            fuzz::expect(std::isfinite(one), "one of the unit is " + to_text(one) + " " + unit);
        });
    }
    return 0;
}
