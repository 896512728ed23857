// Pictures of a back that was never there, with the truth that they show (bind_measure.cpp).
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

void bindSynthesis(pybind11::module_& module);

}  // namespace palpate::python
