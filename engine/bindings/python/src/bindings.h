// The functions that bind each file of the module palpate._core, in the order of module.cpp: a type must be known
// before a signature names it.
#pragma once

#include <pybind11/pybind11.h>

namespace palpate::python {

void bindErrors(pybind11::module_& module);    // palpate.Error
void bindWorld(pybind11::module_& module);     // World
void bindFinger(pybind11::module_& module);    // FingerSettings, Touch, Finger
void bindRollout(pybind11::module_& module);   // World.rollout
void bindLumps(pybind11::module_& module);     // Lump, World(lumps=...), World.lumps
void bindPickle(pybind11::module_& module);    // World, FingerSettings, Lump: pickled and copied
void bindPressure(pybind11::module_& module);  // World.pressure
void bindFingers(pybind11::module_& module);   // Fingers
void bindTools(pybind11::module_& module);     // Tools
void bindSkin(pybind11::module_& module);      // Skin
void bindSessions(pybind11::module_& module);  // recordings: read, replay, iterate
void bindTissue(pybind11::module_& module);    // force laws and layered tissue
void bindDevices(pybind11::module_& module);   // devices: list, open, drive
void bindFits(pybind11::module_& module);      // fits of measured curves, with the resulting tissue (bind_tissue.cpp)
void bindLoops(pybind11::module_& module);     // loops over devices: by the servo's thread, or turned by a script

}  // namespace palpate::python
