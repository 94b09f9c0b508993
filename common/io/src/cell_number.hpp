// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as instruments, spreadsheets and people write them into cells.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace coagula::io {

/// Whether the cells of a file have a decimal comma: by majority among the numbers that can be read in one way only.
class DecimalCommaVote {
public:
    void add(std::string_view cell);
    bool comma_wins() const { return commas_ > points_; }

private:
    std::size_t commas_ = 0;
    std::size_t points_ = 0;
};

struct CellNumber {
    std::optional<double> value;
    std::string complaint;  ///< why it cannot be read; empty for a number and for an empty cell
};
CellNumber read_cell(std::string_view text, bool decimal_comma);

/// A number in either notation.
bool looks_like_number(std::string_view text);

/// What programs write where they have no value: "******", "#NAME?", "---", "invalid point", "n/a", "∞".
bool stands_for_no_value(std::string_view text);

}  // namespace coagula::io
