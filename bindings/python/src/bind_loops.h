// Loops over devices: by the engine's servo thread, or turned by a script.
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

void bindLoops(pybind11::module_& module);

}  // namespace palpate::python
