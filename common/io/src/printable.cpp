// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/io/printable.hpp>

#include <nlohmann/json.hpp>

#include <cctype>

namespace coagula::io {

using AnyJson = nlohmann::json;

std::string printable(const std::string& text) {
    const std::string quoted = AnyJson(text).dump(-1, ' ', false, AnyJson::error_handler_t::replace);
    auto safe = AnyJson::parse(quoted).get<std::string>();
    for (std::size_t place = 0; place < safe.size(); ++place) {
        const auto byte = static_cast<unsigned char>(safe[place]);
        if (std::iscntrl(byte) != 0) {
            safe[place] = ' ';
        } else if (byte == 0xc2 && static_cast<unsigned char>(safe[place + 1]) < 0xa0) {
            safe.replace(place, 2, " ");  // U+0080 to U+009F
        }
    }
    return safe;
}

}  // namespace coagula::io
