// SPDX-License-Identifier: GPL-3.0-or-later
// Whatever the bytes are, they become UTF-8.
#include <coagula/io/printable.hpp>
#include "text_encoding.hpp"

#include "reader_contract.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace coagula;
    const std::string text = io::to_utf8(fuzz::text_of(data, size));
    fuzz::expect(io::is_utf8(text), "the text is not UTF-8");
    fuzz::expect(text.size() <= 4 * size, "the text is longer than any encoding makes it");
    return 0;
}
