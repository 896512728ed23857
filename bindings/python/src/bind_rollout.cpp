#include "bindings.h"
namespace palpate::python {
void bindRollout(pybind11::module_&) {}
}  // namespace palpate::python
