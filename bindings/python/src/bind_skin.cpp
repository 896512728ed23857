#include "bindings.h"
namespace palpate::python {
void bindSkin(pybind11::module_&) {}
}  // namespace palpate::python
