// SPDX-License-Identifier: GPL-3.0-or-later
// Data sets as Python sees them: columns of the index as arrays.
#include "values.hpp"

#include <coagula/io/set_file.hpp>

#include <pybind11/stl.h>

#include <algorithm>

namespace coagula::python {

namespace {

template <class Number>
py::object array_of(const std::vector<Number>& values) {
    return py::array_t<Number>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::object array_of(const std::vector<std::string>& values) {
    return py::module_::import("numpy").attr("array")(py::cast(values), py::arg("dtype") = "str");
}

/// Card, sweep, provenance and columns (name, values, unit, description).
py::tuple read_set(const std::string& path) {
    const io::SetHead set = run(py::none(), std::nullopt, [&](const Progress&) { return io::read_set(path); });
    py::dict card;
    for (const auto& [name, text] : set.card) {
        card[name.c_str()] = text;
    }
    py::dict provenance;
    for (const auto& [name, text] : set.provenance) {
        provenance[name.c_str()] = text;
    }
    py::list columns;
    for (const io::SetColumn& column : set.index) {
        columns.append(py::make_tuple(column.name, std::visit([](const auto& values) { return array_of(values); }, column.values),
                                      column.unit, column.description));
    }
    return py::make_tuple(card, set.sweep, provenance, columns);
}

}  // namespace

void define_sets(py::module_& module) {
    using namespace py::literals;
    module.def("read_set", &read_set, "path"_a);
    module.def("structures_in_set", &io::structures_in_set, "path"_a);
    module.def("extract_structure", &io::extract_structure, "set"_a, "id"_a, "path"_a, "overwrite"_a);
}

}  // namespace coagula::python
