#include "bindings.h"
namespace palpate::python {
void bindFinger(pybind11::module_&) {}
}  // namespace palpate::python
