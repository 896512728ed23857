// Numbers out of Python's hands: the usual ones (three floats in a tuple, a small array of float64) are read here, all
// others are numpy's affair.
#include "arrays.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace palpate::python {

namespace {

constexpr py::ssize_t kAxes = 3;

std::string formatShape(const py::array& array) {
  std::string words = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) words += fmt::format("{}{}", i == 0 ? "" : ", ", array.shape(i));
  return words + (array.ndim() == 1 ? ",)" : ")");
}

}  // namespace

FloatArray toArray(const Vec3& point) { return py::array_t<double>(kAxes, point.data()); }

py::array_t<double, py::array::c_style> asFloats(py::handle given, const char* what, py::ssize_t last) {
  // Text and objects would be converted in silence, complex numbers cut.
  const py::array any = py::array::ensure(given);
  if (!any || std::string("biuf").find(any.dtype().kind()) == std::string::npos) {
    PyErr_Clear();
    throw py::type_error(fmt::format("{}: expected numbers, not {}", what, Py_TYPE(given.ptr())->tp_name));
  }
  auto floats = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(any);
  if (!floats) throw py::error_already_set();
  if (last != 0 && (floats.ndim() == 0 || floats.shape(floats.ndim() - 1) != last)) {
    throw py::value_error(
        fmt::format("{}: the last axis must be {} long, not of shape {}", what, last, formatShape(floats)));
  }
  return py::reinterpret_borrow<py::array_t<double, py::array::c_style>>(floats);
}

Vec3 asPoint(py::handle given, const char* what) {
  const auto floats = asFloats(given, what);
  if (floats.ndim() != 1 || floats.shape(0) != kAxes) {
    throw py::value_error(fmt::format("{}: expected three numbers, not {}", what, formatShape(floats)));
  }
  return {floats.at(0), floats.at(1), floats.at(2)};
}

}  // namespace palpate::python
