// Loop, a servo loop that a script turns; and drive, the engine's own servo thread for some seconds.
#include "bindings.h"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "arrays.h"
#include "dicts.h"
#include "hand_loop.h"
#include "interrupts.h"
#include "palpate/base/error.h"
#include "palpate/engine/recorder.h"
#include "palpate/engine/servo_thread.h"

namespace palpate::python {

namespace {

constexpr const char* kLoopInUse = "this Loop";
using Path = std::optional<std::filesystem::path>;

// --- turned by a script ---------------------------------------------------------------------------------------------

std::unique_ptr<HandLoop> handLoop(const WorldPointer& world, const std::optional<std::vector<DevicePointer>>& devices,
                                   std::size_t fingers, const py::object& settings, const Path& session,
                                   const std::string& notes) {
  const bool held = devices && !devices->empty();
  const std::size_t count = held ? devices->size() : fingers;
  if (count < 1 || count > 64) throw py::value_error(fmt::format("fingers = {} is out of range: 1 to 64", count));
  HandLoopSettings wanted{settingsOf(*world->world, settings, count), session, notes};
  return std::make_unique<HandLoop>(world, held ? *devices : std::vector<DevicePointer>(), std::move(wanted));
}

void requireOpen(const HandLoop& loop) {
  if (loop.closed()) throw py::value_error("the loop is closed");
}

std::vector<contact::FingerOutput> extractContacts(const std::vector<trace::Sample>& samples) {
  std::vector<contact::FingerOutput> touches;
  for (const trace::Sample& sample : samples) touches.push_back(sample.contact);
  return touches;
}

std::vector<contact::FingerOutput> turn(HandLoop& loop, const py::object& tips) {
  const Busy::Guard guard(loop.busy, kLoopInUse);
  requireOpen(loop);
  if (tips.is_none()) {
    if (loop.takesTips()) throw py::value_error("tips: required, because no device moves the fingers");
    return extractContacts(loop.tick());
  }
  if (!loop.takesTips()) throw py::value_error("tips: must be omitted, because devices move the fingers");
  const auto places = asFloats(tips, "tips", 3);
  const auto count = static_cast<py::ssize_t>(loop.fingers());
  if (places.size() != 3 * count || places.ndim() > 2) {
    throw py::value_error(fmt::format("tips: expected an array ({}, 3){}", count, count == 1 ? ", or (3,)" : ""));
  }
  std::vector<Vec3> points;
  for (py::ssize_t i = 0; i < count; ++i) points.emplace_back(Eigen::Map<const Vec3>(places.data() + 3 * i));
  loop.place(points);
  return extractContacts(loop.tick());
}

FloatArray deviceForces(const HandLoop& loop) {
  py::array_t<double> forces({static_cast<py::ssize_t>(loop.felt().size()), py::ssize_t{3}});
  auto out = forces.mutable_unchecked<2>();
  for (std::size_t i = 0; i < loop.felt().size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) out(static_cast<py::ssize_t>(i), axis) = loop.felt()[i].device_force[axis];
  }
  return FloatArray(forces);
}

void closeLoop(HandLoop& loop, std::string_view ended_by) {
  const Busy::Guard guard(loop.busy, kLoopInUse);
  loop.close(ended_by);
}

void bindHandLoop(py::module_& module) {
  py::class_<HandLoop>(
      module, "Loop",
      "A servo loop that a script turns by hand: contact, limiter and devices as the engine's own loop\n"
      "has them, at the pace of the script. One thread at a time; `with` closes it.")
      .def(
          py::init(&handLoop), py::arg("world"), py::arg("devices") = py::none(), py::kw_only(), py::arg("fingers") = 1,
          py::arg("settings") = py::none(), py::arg("session") = py::none(), py::arg("notes") = "",
          "devices: open ones, a finger each, lent to the loop until it is closed; None: `tick` is told where so many\n"
          "`fingers` are. settings: FingerSettings, one or one a finger; None: the scene's. session: a file that\n"
          "records every tick. Raises Error, ValueError, RuntimeError (a device in use).")
      .def("tick", turn, py::arg("tips") = py::none(),
           "One tick of all fingers: a Touch each. tips (F, 3), mm: where they are, when no device holds them. The\n"
           "first positions must be outside the body, like a hand that comes to it.")
      .def(
          "lift",
          [](HandLoop& loop, std::size_t finger) {
            const Busy::Guard guard(loop.busy, kLoopInUse);
            requireOpen(loop);
            if (finger >= loop.fingers()) throw py::index_error("finger: number out of range");
            loop.lift(finger);
          },
          py::arg("finger") = 0, "Lifts the finger; the next tip may be anywhere.")
      .def(
          "mark",
          [](HandLoop& loop, const std::string& text) {
            const Busy::Guard guard(loop.busy, kLoopInUse);
            requireOpen(loop);
            loop.mark(text);
          },
          py::arg("text"), "Sets a mark at the newest tick of the session. Raises ValueError if none is recorded.")
      .def_property_readonly(
          "device_forces", deviceForces,
          "Forces sent to the devices in the last tick (F, 3), N: the contact force after the safety limits.")
      .def_property_readonly("ticks", &HandLoop::ticks, "Number of ticks so far.")
      .def(
          "close", [](HandLoop& loop) { closeLoop(loop, "done"); },
          "Sets zero force, returns the devices and completes the session file.")
      .def(
          "__enter__", [](HandLoop& loop) -> HandLoop& { return loop; }, py::return_value_policy::reference_internal,
          "Returns itself.")
      .def(
          "__exit__",
          [](HandLoop& loop, const py::object& type, const py::args& /*error*/) {
            closeLoop(loop, type.is_none() ? "done" : "an exception");
          },
          "Calls close().");
}

// --- by the servo thread --------------------------------------------------------------------------------------------

Facts durations(const servo::DurationPercentiles& of) {
  Facts facts;
  facts["p50"] = of.p50_us;
  facts["p99"] = of.p99_us;
  facts["p99_9"] = of.p99_9_us;
  facts["max"] = of.max_us;
  return facts;
}

Facts loopReportFacts(const servo::LoopReport& report) {
  Facts facts;
  facts["ticks"] = report.ticks;
  facts["overruns"] = report.overruns;
  facts["slow_ticks"] = report.slow_ticks;
  facts["stalls"] = report.stalls;
  facts["wall_s"] = report.wall_s;
  facts["compute_us"] = durations(report.compute);
  facts["lateness_us"] = durations(report.lateness);
  facts["note"] = report.grant.note;
  return facts;
}

struct Drive {
  WorldPointer world;
  std::vector<device::Device> devices;
  std::vector<contact::FingerSettings> settings;
  double seconds = 0.0;
  Path session;
  std::string notes;
};

/// Until the seconds are over or a signal wants the end, which presses the emergency stop first.
void waitOut(engine::ServoThread& servo, double seconds, Interrupts& interrupts) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  trace::Sample sample;
  try {
    while (std::chrono::steady_clock::now() < end) {
      const auto left = end - std::chrono::steady_clock::now();
      std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(std::chrono::milliseconds(10), left));
      interrupts.check();
      while (servo.pop(sample)) {
      }
    }
  } catch (...) {
    servo.emergencyStop().press();
    throw;
  }
}

engine::RecorderSettings recorderFor(const Drive& drive) {
  const scene::World& world = *drive.world->world;
  engine::RecorderSettings settings;
  settings.file = *drive.session;
  settings.header = engine::recordingHeader(world.scene.ticks_per_s);
  settings.header.notes = drive.notes.empty() ? world.scene.title : drive.notes;
  for (std::size_t i = 0; i < drive.devices.size(); ++i) {
    settings.fingers.push_back(engine::recordingFinger(nameOfFinger(world, i), drive.devices[i]));
  }
  return settings;
}

servo::LoopReport driven(const Drive& drive, Interrupts& interrupts) {
  engine::ServoPlan plan = engine::servoPlan(drive.world->world, drive.settings);
  plan.limiter = limitsFor(*drive.world->world, drive.devices);
  engine::ServoThread servo(std::move(plan), drive.devices);
  std::optional<engine::Recorder> recorder;
  if (drive.session) recorder.emplace(servo, recorderFor(drive));
  try {
    waitOut(servo, drive.seconds, interrupts);
  } catch (...) {
    servo.stop();
    if (recorder) recorder->finish("interrupted");
    throw;
  }
  const servo::LoopReport report = servo.stop();
  if (recorder) recorder->finish("done");
  return report;
}

Facts drive(const WorldPointer& world, const std::vector<DevicePointer>& devices, double seconds,
            const py::object& settings, const Path& session, const std::string& notes) {
  if (!(seconds > 0.0 && seconds <= 864000.0)) throw py::value_error("seconds: must be above 0, at most 864,000");
  if (devices.empty()) throw py::value_error("devices: at least one is required");
  const LentDevices lent(devices);
  Drive wanted{world, lent.devices(), settingsOf(*world->world, settings, devices.size()), seconds, session, notes};
  const double tick_s = 1.0 / world->world->scene.ticks_per_s;
  for (contact::FingerSettings& finger : wanted.settings) finger.tick_s = tick_s;
  return loopReportFacts(unlocked([&](Interrupts& interrupts) { return driven(wanted, interrupts); }));
}

}  // namespace

void bindLoops(py::module_& module) {
  bindHandLoop(module);
  module.def(
      "drive", drive, py::arg("world"), py::arg("devices"), py::arg("seconds"), py::kw_only(),
      py::arg("settings") = py::none(), py::arg("session") = py::none(), py::arg("notes") = "",
      "The engine's servo thread for so many seconds, at the scene's rate, a finger a device, within the limits of\n"
      "the weakest device. A dict: ticks, overruns, slow_ticks, stalls, wall_s, compute_us and lateness_us (p50,\n"
      "p99, p99_9, max), note. session: a file that records every tick. Releases the GIL; Ctrl-C ends it without\n"
      "force. Raises Error, ValueError, RuntimeError (a device in use).");
}

}  // namespace palpate::python
