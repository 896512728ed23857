// Fits of measured curves, bound with the tissue that they give (bind_tissue.cpp).
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

void bindFits(pybind11::module_& module);

}  // namespace palpate::python
