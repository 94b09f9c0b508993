// SPDX-License-Identifier: GPL-3.0-or-later
// The extension module below the Python package `coagula`, which is what people import.
#include "running.hpp"
#include "values.hpp"

#include <coagula/common/blas_kernels.hpp>
#include <coagula/common/checks.hpp>
#include <coagula/io/standard_descriptors.hpp>

#include <filesystem>
#include <stdexcept>

namespace coagula::python {

namespace {

/// Sentences of the program as Python spells them; the package sets the function.
py::handle spelling = py::none().release();

void raise(const py::handle& kind, const char* sentence) {
    if (spelling.is_none()) {
        PyErr_SetString(kind.ptr(), sentence);
    } else {
        PyErr_SetObject(kind.ptr(), py::reinterpret_borrow<py::object>(spelling)(sentence).ptr());
    }
}

void define_exceptions(py::module_& module) {
    static py::handle input_error = py::exception<InputError>(module, "InputError", PyExc_ValueError).release();
    module.def("spell_errors_by", [](const py::object& function) { spelling = py::object(function).release(); });
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const InputError& error) {
            raise(input_error, error.what());
        } catch (const std::invalid_argument& error) {
            raise(input_error, error.what());
        } catch (const Cancelled& error) {
            PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
        } catch (const std::filesystem::filesystem_error& error) {
            PyErr_SetString(PyExc_OSError, (error.path1().string() + " cannot be used: " + error.code().message()).c_str());
        }
    });
}

}  // namespace

}  // namespace coagula::python

PYBIND11_MODULE(_coagula, module) {
    coagula::io::occupy_standard_descriptors();
    coagula::python::prepare_for_forks();
    module.def("take_newest_blas_kernels", &coagula::take_newest_blas_kernels);
    coagula::python::define_exceptions(module);
    coagula::python::define_values(module);
    coagula::python::define_stages(module);
    coagula::python::define_sets(module);
}
