// The functions that bind the other files of the module palpate.measure, for bind_measure.cpp.
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

/// Means of presses; needs Estimate bound before.
void bindAverages(pybind11::module_& module);
/// The sheet to punch.
void bindStencil(pybind11::module_& module);
/// Pictures of a back that was never there, with the truth that they show.
void bindSynthesis(pybind11::module_& module);

}  // namespace palpate::python
