// SPDX-License-Identifier: GPL-3.0-or-later
// Packings, bonds and findings as Python sees them: arrays are views of the values, which they keep alive.
#pragma once

#include "running.hpp"

#include <coagula/io/structure_file.hpp>
#include <coagula/stages/findings.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <vector>

namespace coagula::python {

/// What a stage found, and all that a file keeps of it.
struct Stage {
    stages::Findings findings;
    std::shared_ptr<Packing> packing;  ///< that a generator made; otherwise null
    std::shared_ptr<ContactNetwork> bonds;
    std::vector<io::Frame> earlier;
    double time = 0;
    io::Provenance provenance;
    bool generated = false;
};

/// A read-only array of numbers that live in `owner`. Shape as in C, last index fastest.
template <class Number>
py::array view(const Number* numbers, std::vector<py::ssize_t> shape, const py::handle& owner) {
    py::array array(py::dtype::of<Number>(), std::move(shape), numbers, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

/// A d x N matrix of columns as N rows of d.
template <class Matrix>
py::array rows_of(const Matrix& columns, const py::handle& owner) {
    return view(columns.data(), {columns.cols(), columns.rows()}, owner);
}

void define_values(py::module_& module);
void define_stages(py::module_& module);
void define_sets(py::module_& module);

}  // namespace coagula::python
