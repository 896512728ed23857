// Objects of bound classes that were made by __new__ alone: there is nothing in them.
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

/// pybind11 would give such an object uninitialised memory, and the first access would end the process. From here on
/// each use of one raises TypeError. For all classes of a module, once they are bound.
inline void refuseUninitialised(const pybind11::module_& module) {
  namespace py = pybind11;
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (PyType_Check(value.ptr()) == 0) continue;
    auto* type = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr()));
    if (type == nullptr) continue;
    type->operator_new = [](std::size_t) -> void* { throw py::type_error("palpate: __init__() was not called"); };
  }
}

}  // namespace palpate::python
