// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/diagnose/error_spec.hpp>

#include <algorithm>

namespace coagula::diagnose {

const ColumnErrors* find_errors(const ErrorSpec& errors, std::size_t measurement, std::string_view column) {
    if (measurement >= errors.tables.size()) {
        return nullptr;
    }
    const std::vector<ColumnErrors>& columns = errors.tables[measurement].columns;
    const auto found = std::find_if(columns.begin(), columns.end(), [&](const ColumnErrors& one) { return one.column == column; });
    return found == columns.end() ? nullptr : &*found;
}

}  // namespace coagula::diagnose
