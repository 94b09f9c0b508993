// The extension module below the Python package `coagula`, which is what people import.
#include "values.hpp"

#include <coagula/common/checks.hpp>

#include <filesystem>
#include <stdexcept>

namespace coagula::python {

namespace {

void define_exceptions(py::module_& module) {
    static py::handle input_error = py::exception<InputError>(module, "InputError", PyExc_ValueError).release();
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (const InputError& error) {
            PyErr_SetString(input_error.ptr(), error.what());
        } catch (const std::invalid_argument& error) {
            PyErr_SetString(input_error.ptr(), error.what());
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
    coagula::python::define_exceptions(module);
    coagula::python::define_values(module);
    coagula::python::define_stages(module);
}
