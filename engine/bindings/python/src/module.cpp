// palpate._core: worlds, fingers, skins, recordings, tissue and devices for Python. The package palpate (../palpate)
// hands out what is here; palpate._view and palpate._measure, modules of their own, use the types that are made here.
#include <pybind11/pybind11.h>

#include "bindings.h"
#include "palpate/scene/host.h"
#include "uninitialised.h"

PYBIND11_MODULE(_core, module) {
  using namespace palpate::python;  // NOLINT(google-build-using-namespace): of one function
  palpate::installHost();
  module.doc() = "The engine of palpate; use the package palpate.";
  module.attr("__version__") = PALPATE_VERSION;
  bindErrors(module);
  bindWorld(module);
  bindFinger(module);
  bindLumps(module);
  bindPickle(module);
  bindRollout(module);
  bindPressure(module);
  bindFingers(module);
  bindTools(module);
  bindSkin(module);
  bindSessions(module);
  bindTissue(module);
  bindDevices(module);
  refuseUninitialised(module);
}
