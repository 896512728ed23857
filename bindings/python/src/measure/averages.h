// Means of presses and the sheet to punch, for Python (bind_measure.cpp).
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

/// Needs Estimate bound before.
void bindAverages(pybind11::module_& module);
void bindStencil(pybind11::module_& module);

}  // namespace palpate::python
