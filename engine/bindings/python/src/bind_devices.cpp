// Devices for Python: what is here, opening one, reading and writing it from a script's own loop. Loops that the engine
// runs or that a script turns by hand are in bind_loops.cpp.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <future>

#include "arrays.h"
#include "bindings.h"
#include "device_handle.h"
#include "dicts.h"
#include "interrupts.h"
#include "palpate/base/error.h"
#include "palpate/device/back_ends.h"
#include "palpate/device/mouse_finger.h"

namespace palpate::python {

LentDevices::LentDevices(std::vector<DevicePointer> handles) : handles_(std::move(handles)) {
  for (const DevicePointer& handle : handles_) {
    if (!handle) throw py::type_error("devices: expected a palpate.devices.Device, not None");
    if (!handle->open) throw py::value_error(handle->device.name + ": the device is closed");
    guards_.push_back(std::make_unique<Busy::Guard>(handle->busy, handle->device.name.c_str()));
  }
}

void LentDevices::releaseDevices() {
  guards_.clear();
  handles_.clear();
}

std::vector<device::Device> LentDevices::devices() const {
  std::vector<device::Device> all;
  for (const DevicePointer& handle : handles_) all.push_back(handle->device);
  return all;
}

namespace {

// --- what is here ---------------------------------------------------------------------------------------------------

Facts probeBackEnd(const std::string& words) {
  const device::DeviceName name = device::deviceNamed(words);
  device::OpenOptions options;
  options.which = name.which;
  const device::Probe probe = unlocked([&](Interrupts&) { return name.back_end->probe(options); });
  Facts facts;
  facts["name"] = std::string(name.back_end->name);
  facts["about"] = std::string(name.back_end->about);
  facts["available"] = probe.available;
  facts["reason"] = probe.reason;
  facts["remedy"] = probe.remedy;
  facts["version"] = probe.version;
  facts["devices"] = probe.devices;
  py::list looked_for;
  for (const device::LookedFor& one : probe.looked_for) {
    Facts entry;
    entry["what"] = one.what;
    entry["where"] = one.where;
    entry["found"] = one.found;
    entry["words"] = one.words;
    looked_for.append(entry);
  }
  facts["looked_for"] = looked_for;
  return facts;
}

FactsList probes(const std::optional<std::vector<std::string>>& names) {
  FactsList all;
  for (const std::string& words : names ? *names : device::backEndNames()) all.append(probeBackEnd(words));
  return all;
}

// --- one device -----------------------------------------------------------------------------------------------------

double checkedRate(double ticks_per_s) {
  if (ticks_per_s >= 1.0 && ticks_per_s <= 1e5) return ticks_per_s;
  throw py::value_error(fmt::format("ticks_per_s = {:g} is out of range: 1 to 100,000", ticks_per_s));
}

DevicePointer opened(const std::string& words, double scale, const ArrayLike& origin_mm, const std::string& axes,
                     const std::string& library, double ticks_per_s) {
  if (!(scale > 0.0 && scale <= 1000.0)) throw py::value_error("scale: must be above 0, at most 1000");
  device::OpenOptions options;
  options.library = library;
  options.axes = axes;
  options.origin_mm = asPoint(origin_mm, "origin_mm");
  options.scale = scale;
  options.tick_s = 1.0 / checkedRate(ticks_per_s);
  std::atomic<bool> give_up{false};
  options.give_up = &give_up;
  return unlocked([&](Interrupts& interrupts) {
    // Another program (remote) may come a minute later: the user may interrupt the wait.
    auto opening = std::async(std::launch::async, [&] { return device::openNamed(words, options); });
    try {
      while (opening.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) interrupts.check();
    } catch (...) {
      give_up = true;
      throw;
    }
    auto handle = std::make_shared<DeviceHandle>();
    handle->device = opening.get();
    return handle;
  });
}

DevicePointer scripted(const ArrayLike& tips) {
  const auto places = asFloats(tips, "tips", 3);
  if (places.ndim() != 2) throw py::value_error("tips: expected an array (T, 3)");
  const auto path = std::make_shared<std::vector<Vec3>>();
  for (py::ssize_t i = 0; i < places.shape(0); ++i) {
    path->emplace_back(places.at(i, 0), places.at(i, 1), places.at(i, 2));
    if (!path->back().allFinite()) throw py::value_error(fmt::format("tips[{}] must be finite", i));
  }
  auto handle = std::make_shared<DeviceHandle>();
  handle->device = device::scriptedDevice("script", path);
  return handle;
}

device::Device& openDevice(DeviceHandle& handle) {
  if (!handle.open) throw py::value_error(handle.device.name + ": the device is closed");
  return handle.device;
}

FloatArray readTip(DeviceHandle& handle, const std::optional<std::uint64_t>& tick) {
  const Busy::Guard guard(handle.busy, handle.device.name.c_str());
  device::Device& device = openDevice(handle);
  if (tick) handle.tick = *tick;
  if (device.exchange) device.exchange();
  return toArray(device.read_tip(handle.tick++));
}

void writeForce(DeviceHandle& handle, const ArrayLike& force_n) {
  const Vec3 force = asPoint(force_n, "force");
  if (!force.allFinite()) throw py::value_error("force: expected three finite numbers");
  const Busy::Guard guard(handle.busy, handle.device.name.c_str());
  device::Device& device = openDevice(handle);
  if (device.write_force) device.write_force(force);
}

Facts readState(DeviceHandle& handle) {
  const Busy::Guard guard(handle.busy, handle.device.name.c_str());
  device::Device& device = openDevice(handle);
  const device::DeviceState state = device.state ? device.state() : device::DeviceState{};
  Facts facts;
  facts["velocity"] = toArray(state.velocity);
  facts["buttons"] = state.buttons;
  facts["faults"] = state.faults;
  facts["notes"] = state.notes;
  facts["age_ticks"] = state.age_ticks;
  facts["trouble"] = device.explain ? device.explain() : std::string();
  return facts;
}

Facts capabilitiesOf(const DeviceHandle& handle) {
  const device::Capabilities& able = handle.device.capabilities;
  Facts facts;
  facts["takes_force"] = able.takes_force;
  facts["max_force_n"] = able.max_force_n;
  facts["continuous_force_n"] = able.continuous_force_n;
  facts["nominal_stiffness_n_per_mm"] = able.nominal_stiffness_n_per_mm;
  facts["rate_hz"] = able.rate_hz;
  facts["delay_ticks"] = able.delay_ticks;
  facts["motion_scale"] = able.motion_scale;
  facts["model"] = able.model;
  facts["version"] = able.version;
  return facts;
}

void closeDevice(DeviceHandle& handle) {
  const Busy::Guard guard(handle.busy, handle.device.name.c_str());
  if (!handle.open) return;
  handle.open = false;
  if (handle.device.write_force) handle.device.write_force(Vec3::Zero());
  const std::string name = handle.device.name;
  device::Device closing = std::exchange(handle.device, {});
  handle.device.name = name;
  unlocked([&](Interrupts&) {  // a driver may take its time
    if (closing.close) closing.close();
    closing = {};
  });
}

void bindDevice(py::module_& module) {
  py::class_<DeviceHandle, DevicePointer>(
      module, "Device",
      "An open device: a position comes out of it, a force goes back. Whoever writes\n"
      "forces from a loop of Python does it at his own risk: nothing here limits them,\n"
      "and the interpreter may be late. palpate.devices.drive and Loop limit them.")
      .def_property_readonly(
          "name", [](const DeviceHandle& d) { return d.device.name; }, "Name under which it was opened.")
      .def_property_readonly(
          "capabilities", capabilitiesOf,
          "dict: takes_force, max_force_n, continuous_force_n, nominal_stiffness_n_per_mm, rate_hz,\n"
          "delay_ticks, motion_scale, model, version; 0 and empty words: it does not say.")
      .def_property_readonly("state", readState,
                             "dict of what came with the last reading: velocity (3,) mm/s, buttons, faults and notes\n"
                             "(bits), age_ticks, trouble (words; empty: none).")
      .def_readonly("tick", &DeviceHandle::tick, "Tick of the next reading.")
      .def(
          "read", readTip, py::arg("tick") = py::none(),
          "Its position (3,), mm in the body's frame; NaN where it has none now. tick: which of a script's positions;\n"
          "None: the next. Raises ValueError once it is closed.")
      .def(
          "write", writeForce, py::arg("force"),
          "The force on the hand, three numbers, N; a device that only points drops it. Read before you write, once a\n"
          "tick. Raises ValueError.")
      .def("close", closeDevice, "Sets zero force and releases the driver. Closing again has no effect.")
      .def(
          "__enter__", [](DevicePointer device) { return device; }, "Returns itself.")
      .def(
          "__exit__", [](DeviceHandle& device, const py::args& /*error*/) { closeDevice(device); }, "Calls close().")
      .def("__repr__", [](const DeviceHandle& d) {
        return fmt::format("Device('{}'{})", d.device.name, d.open ? "" : ", closed");
      });
}

}  // namespace

void bindDevices(py::module_& module) {
  bindDevice(module);
  module.def("probe_devices", probes, py::arg("names") = py::none(),
             "A dict a back end (or of each name): name, about, available, reason, remedy, version, devices,\n"
             "looked_for. Opens nothing for long. Raises Error for a name that there is none of.");
  module.def(
      "open_device", opened, py::arg("words"), py::kw_only(), py::arg("scale") = 1.0,
      py::arg_v("origin_mm", py::reinterpret_borrow<ArrayLike>(py::make_tuple(0.0, 0.0, 0.0)), "(0.0, 0.0, 0.0)"),
      py::arg("axes") = "", py::arg("library") = "", py::arg("ticks_per_s") = 1000.0,
      "\"playback:FILE\", \"hand:stylus_z,omni\", \"openhaptics\" ... (docs/reference/devices.md), and waits for its "
      "first\n"
      "position. scale: mm of the body a mm of the device; origin_mm: where its origin lies in the body.\n"
      "Releases the GIL. Raises Error with the reason.");
  module.def("scripted_device", scripted, py::arg("tips"),
             "A device that plays tips (T, 3), mm, one per tick, and stays at the last. Raises ValueError, Error.");
  bindLoops(module);
}

}  // namespace palpate::python
