// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_by_side.hpp"

#include "cell_number.hpp"
#include "measured_text.hpp"
#include "text_reader.hpp"

#include <coagula/io/units.hpp>

#include <algorithm>
#include <numeric>

namespace coagula::io {

namespace {

constexpr std::size_t most_shared = 2;  // columns
constexpr std::size_t widest = 50;

/// Whether the headings behind those that are shared are those of one table, again and again. A last empty column may be missing.
bool repeats(const std::vector<HeadingWithUnit>& headings, const SideBySide& layout) {
    static const HeadingWithUnit none;
    const auto at = [&](std::size_t column) -> const HeadingWithUnit& {
        return column < headings.size() ? headings[column] : none;
    };
    for (std::size_t column = layout.shared + layout.width; column < layout.shared + layout.width * layout.count; ++column) {
        const HeadingWithUnit& one = at(column);
        const HeadingWithUnit& before = at(column - layout.width);
        if (one.heading != before.heading || one.unit != before.unit) {
            return false;
        }
    }
    return true;
}

/// Headings of one table that mean something, no two of them the same.
std::size_t distinct_quantities(const std::vector<HeadingWithUnit>& headings, const SideBySide& layout) {
    std::vector<std::string> quantities;
    for (std::size_t column = 0; column < layout.shared + layout.width; ++column) {
        if (std::string quantity = plain_column(headings[column]).quantity; !quantity.empty()) {
            quantities.push_back(std::move(quantity));
        }
    }
    std::sort(quantities.begin(), quantities.end());
    const bool twice = std::adjacent_find(quantities.begin(), quantities.end()) != quantities.end();
    return twice ? 0 : quantities.size();
}

}  // namespace

std::vector<std::size_t> SideBySide::columns_of(std::size_t table) const {
    std::vector<std::size_t> columns(shared + width);
    std::iota(columns.begin(), columns.end(), 0);
    for (std::size_t column = shared; column < columns.size(); ++column) {
        columns[column] += table * width;
    }
    return columns;
}

std::optional<SideBySide> side_by_side(const std::vector<HeadingWithUnit>& headings, bool labelled) {
    const auto last = std::find_if(headings.rbegin(), headings.rend(), [](const auto& one) { return !one.heading.empty(); });
    const auto filled = static_cast<std::size_t>(headings.rend() - last);
    const std::size_t narrowest = labelled ? 1 : 2;
    for (std::size_t shared = 0; shared <= most_shared; ++shared) {
        for (std::size_t width = narrowest; width <= widest && shared + 2 * width <= filled + 1; ++width) {
            const std::size_t count = (filled - shared + width - 1) / width;
            const SideBySide layout{shared, width, count};
            const bool whole = shared + width * count <= filled + 1;
            if (whole && count > 1 && repeats(headings, layout) && distinct_quantities(headings, layout) > 1) {
                return layout;
            }
        }
    }
    return std::nullopt;
}

std::optional<PlainColumn> temperature_of_label(const std::string& label, std::size_t rows) {
    std::string_view text = label;
    text.remove_prefix(text.find('=') == std::string_view::npos ? 0 : text.find('=') + 1);
    text = trim(text);
    const std::size_t end = std::min(text.find_first_not_of("0123456789.,+-"), text.size());
    const CellNumber number = read_cell(text.substr(0, end), text.substr(0, end).find(',') != std::string_view::npos);
    const std::string unit = normal_unit(text.substr(end));
    if (!number.value || unit.empty()) {
        return std::nullopt;
    }
    try {
        PlainColumn column = plain_column({"temperature", "K"});
        column.values.assign(rows, convert({*number.value}, unit, "K").front());
        return column;
    } catch (const InputError&) {
        return std::nullopt;  // another quantity, such as a concentration
    }
}

}  // namespace coagula::io
