// palpate::Error becomes palpate.Error, a ValueError that knows file, line and cause. Registered once, for every module
// of the package.
#include <pybind11/pybind11.h>

#include <string>

#include "bindings.h"
#include "palpate/base/error.h"

namespace palpate::python {

namespace py = pybind11;

namespace {

/// Lives as long as the process: translators are never removed.
PyObject* error_type = nullptr;

void raise(const Error& error) {
  const auto text = [](std::string_view words) {  // names of files need not be UTF-8
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(words.data(), static_cast<py::ssize_t>(words.size()), "surrogateescape"));
  };
  const py::object instance = py::reinterpret_borrow<py::object>(error_type)(text(error.what()));
  instance.attr("file") = error.file().empty() ? py::object(py::none()) : text(error.file());
  instance.attr("line") = error.line() == 0 ? py::object(py::none()) : py::object(py::int_(error.line()));
  instance.attr("cause") = text(error.cause());
  PyErr_SetObject(error_type, instance.ptr());
}

}  // namespace

void bindErrors(py::module_& module) {
  const char* doc =
      "Error while loading, building or using something, in one line: `where: cause`.\n\nfile (str or None): the file, "
      "as it was named; line (int or None): counted from 1;\ncause (str): the words without file and line.";
  const py::object none = py::none();
  const py::dict members;
  members["file"] = none;
  members["line"] = none;
  members["cause"] = "";
  error_type = PyErr_NewExceptionWithDoc("palpate.Error", doc, PyExc_ValueError, members.ptr());
  if (error_type == nullptr) throw py::error_already_set();
  module.attr("Error") = py::reinterpret_borrow<py::object>(error_type);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(error);
    }
  });
}

}  // namespace palpate::python
