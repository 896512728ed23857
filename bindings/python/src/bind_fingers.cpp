#include "bindings.h"
namespace palpate::python {
void bindFingers(pybind11::module_&) {}
}  // namespace palpate::python
