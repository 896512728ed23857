// FingerSettings, Touch and Finger. `Finger.step` is Python's own fast call, without pybind11: a tick takes 130 ns, and
// its wrapping should not take more.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <bit>

#include "bindings.h"
#include "palpate/base/fields.h"
#include "palpate/contact/finger_fields.h"
#include "palpate/engine/fingers.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

using contact::FingerOutput;
using contact::FingerSettings;

struct FingerHandle {
  WorldPointer world;
  engine::Finger finger;
};

// ---- settings

py::object valueOf(const Field<FingerSettings>& field, const FingerSettings& settings) {
  if (field.is_flag) return py::bool_(field.get(settings) != 0.0);
  return py::float_(field.get(settings));
}

std::string formatRepr(const FingerSettings& settings) {
  const FingerSettings usual;
  std::string text;
  for (const Field<FingerSettings>& field : contact::kFingerFields) {
    if (field.get(settings) == field.get(usual)) continue;
    const std::string value = py::repr(valueOf(field, settings));
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", field.name, value);
  }
  return "FingerSettings(" + text + ")";
}

bool equal(const FingerSettings& one, const FingerSettings& other) {
  return std::all_of(contact::kFingerFields.begin(), contact::kFingerFields.end(),
                     [&](const auto& field) { return field.get(one) == field.get(other); });
}

FingerSettings replaced(FingerSettings settings, const py::kwargs& changes) {
  for (const auto& [key, value] : changes) {
    const auto name = key.cast<std::string>();
    const auto field = std::find_if(contact::kFingerFields.begin(), contact::kFingerFields.end(),
                                    [&](const auto& one) { return one.name == name; });
    if (field == contact::kFingerFields.end()) {
      throw py::type_error("replace() got an unexpected keyword argument '" + name + "'");
    }
    field->set(settings, field->is_flag ? static_cast<double>(value.cast<bool>()) : value.cast<double>());
  }
  engine::checkFinger(settings);
  return settings;
}

/// In the order of contact::kFingerFields, the flag at its end left out.
constexpr std::array kNumberDocs = {"Radius of the finger, mm; 0 is a point.",
                                    "Tangential divided by normal stiffness.",
                                    "Coefficient of static friction.",
                                    "Coefficient of friction while slipping.",
                                    "Maximum depth that is felt, mm.",
                                    "Length of a tick, s.",
                                    "Maximum speed of the point on the skin relative to the tip, mm/s.",
                                    "Fraction of the force that relaxes during a hold.",
                                    "Time constant of the relaxation, s.",
                                    "Fraction of a second relaxation term.",
                                    "Time constant of the second term, s."};
static_assert(kNumberDocs.size() + 1 == contact::kFingerFields.size() && contact::kFingerFields.back().is_flag);

void bindSettings(py::module_& module) {
  const FingerSettings usual;
  py::class_<FingerSettings> settings(
      module, "FingerSettings",
      "Settings of a finger: radius, stiffness, friction, relaxation. Checked on creation; immutable, `replace` makes "
      "a changed copy.\n\nradius_mm: 0 is a point, 8 a fingertip (0 to 1,000)\nstiffness_ratio: tangential over normal "
      "stiffness (0 to 100)\nmu_static, mu_dynamic: friction, mu_dynamic at most mu_static (0 to 5)\nmax_depth_mm: "
      "deeper than this the force no longer grows (above 0, to 100,000)\ntick_s: time between two ticks, s (1e-6 to "
      "1)\ncatch_up_mm_per_s: how fast the point on the skin may run beside the tip (0 to "
      "1,000,000)\nrelaxation_share, relaxation_time_s, relaxation_share_2, relaxation_time_2_s: of the force, what "
      "goes while the\n    skin is held, and over which times, s; the shares together at most 0.9\nforce_shading: "
      "rounds off facets of coarse meshes; a point only\n\nRaises palpate.Error for a number that makes no sense or is "
      "out of range.");
  settings.def(
      py::init([](double radius_mm, double stiffness_ratio, double mu_static, double mu_dynamic, double max_depth_mm,
                  double tick_s, double catch_up_mm_per_s, double share, double time_s, double share_2, double time_2_s,
                  bool force_shading) {
        const FingerSettings made{.radius_mm = radius_mm,
                                  .stiffness_ratio = stiffness_ratio,
                                  .mu_static = mu_static,
                                  .mu_dynamic = mu_dynamic,
                                  .max_depth_mm = max_depth_mm,
                                  .tick_s = tick_s,
                                  .catch_up_mm_per_s = catch_up_mm_per_s,
                                  .force_shading = force_shading,
                                  .relaxation = {share, time_s, share_2, time_2_s}};
        engine::checkFinger(made);
        return made;
      }),
      "Keyword arguments only; omitted ones have their default. Raises palpate.Error.", py::kw_only(),
      py::arg("radius_mm") = usual.radius_mm, py::arg("stiffness_ratio") = usual.stiffness_ratio,
      py::arg("mu_static") = usual.mu_static, py::arg("mu_dynamic") = usual.mu_dynamic,
      py::arg("max_depth_mm") = usual.max_depth_mm, py::arg("tick_s") = usual.tick_s,
      py::arg("catch_up_mm_per_s") = usual.catch_up_mm_per_s, py::arg("relaxation_share") = usual.relaxation.share,
      py::arg("relaxation_time_s") = usual.relaxation.time_s, py::arg("relaxation_share_2") = usual.relaxation.share_2,
      py::arg("relaxation_time_2_s") = usual.relaxation.time_2_s, py::arg("force_shading") = usual.force_shading);
  for (std::size_t i = 0; i < kNumberDocs.size(); ++i) {
    const Field<FingerSettings>& field = contact::kFingerFields[i];
    settings.def_property_readonly(
        field.name.data(), [get = field.get](const FingerSettings& self) { return get(self); }, kNumberDocs[i]);
  }
  settings.def_property_readonly(
      "force_shading", [](const FingerSettings& self) { return self.force_shading; },
      "Whether the force is smoothed over coarse triangles.");
  settings.def("replace", &replaced,
               "A copy with some values changed, named as in the constructor. Raises TypeError for an unknown name, "
               "palpate.Error for a value out of range.");
  settings.def("__repr__", &formatRepr, "The call of the constructor.");
  settings.def(
      "__eq__", [](const FingerSettings& self, const FingerSettings& other) { return equal(self, other); },
      py::is_operator(), "Whether all values are equal.");
  settings.def(
      "__hash__", [](const FingerSettings& self) { return py::hash(py::str(formatRepr(self))); },
      "Hash of all values.");
}

// ---- what was felt

const char* touchName(contact::Touch touch) {
  if (touch == contact::Touch::free) return "free";
  return touch == contact::Touch::stick ? "stick" : "slip";
}

/// A view of a point inside the Touch.
template <auto Member>
FloatArray pointIn(const py::object& self) {
  const auto& point = self.cast<const FingerOutput&>().*Member;
  return arrayView(point.data(), {static_cast<py::ssize_t>(point.size())}, self);
}

int signedIndex(Index index) { return std::bit_cast<std::int32_t>(index); }

void bindTouch(py::module_& module) {
  py::class_<FingerOutput> touch(
      module, "Touch", "Contact of a finger in one tick: an immutable snapshot. Arrays are read-only views of it.");
  touch.def_property_readonly("force", pointIn<&FingerOutput::force>, "(3,) force on the finger, N.");
  touch.def_property_readonly("tip", pointIn<&FingerOutput::tip>, "(3,) position of the finger, mm.");
  touch.def_property_readonly("proxy", pointIn<&FingerOutput::proxy>,
                              "(3,) point on the skin that it presses, mm; the tip when free.");
  touch.def_property_readonly("anchor", pointIn<&FingerOutput::anchor>,
                              "(3,) point on the skin held by friction, mm; the tip when free.");
  touch.def_property_readonly("hold", pointIn<&FingerOutput::hold>,
                              "(3,) point in space where friction holds the tip, mm; the tip when free.");
  touch.def_property_readonly("normal", pointIn<&FingerOutput::normal>,
                              "(3,) unit normal, out of the skin; zeros when free.");
  touch.def_property_readonly(
      "depth_mm", [](const FingerOutput& self) { return self.depth_mm; }, "Depth along the normal, mm; 0 when free.");
  touch.def_property_readonly(
      "tissue_mm", [](const FingerOutput& self) { return self.tissue_mm; },
      "Effective tissue thickness over the bone under the finger, larger over a narrow one, mm; 0 when free or "
      "unknown.");
  touch.def_property_readonly(
      "rest_mm", [](const FingerOutput& self) { return self.rest_mm; },
      "Effective depth at which the skin under the finger would stay without force, mm.");
  touch.def_property_readonly(
      "state", [](const FingerOutput& self) { return touchName(self.touch); }, "'free', 'stick' or 'slip'.");
  touch.def_property_readonly(
      "triangle", [](const FingerOutput& self) { return signedIndex(self.triangle); },
      "Triangle under the proxy, a row of World.triangles; -1 when free.");
  touch.def_property_readonly(
      "anchor_triangle", [](const FingerOutput& self) { return signedIndex(self.anchor_triangle); },
      "Triangle under the anchor; -1 when free.");
  touch.def_property_readonly(
      "status", [](const FingerOutput& self) { return self.status; },
      "Bits: 1 tip lost (not finite or absurdly far: no force), 2 catching up, 4 too deep, 8 letting go, 16 at the "
      "border, 32 started inside, 64 unsettled, 128 shading failed (docs/explanation/contact.md).");
  touch.def_property_readonly(
      "radius_mm", [](const FingerOutput& self) { return self.finger_mm; }, "Radius of the finger, mm; 0 is a point.");
  touch.def_property_readonly("lump_force", pointIn<&FingerOutput::lump_force>,
                              "(3,) part of `force` added by the lumps under the skin, N.");
  touch.def_property_readonly(
      "lump_share", [](const FingerOutput& self) { return self.lump_share; },
      "Normal force of the lumps divided by that of the press without them; 0 where that is 0.");
  touch.def_property_readonly(
      "lump", [](const FingerOutput& self) { return signedIndex(self.lump); },
      "Index in World.lumps of the nearest movable lump that is felt; -1 for none.");
  touch.def_property_readonly("lump_moved", pointIn<&FingerOutput::lump_moved_mm>,
                              "(2,) displacement of that lump from its place, mm across and up.");
  touch.def(
      "__repr__",
      [](const FingerOutput& self) {
        return fmt::format("<Touch: {}, {:.4g} N, {:.4g} mm deep{}>", touchName(self.touch), self.force.norm(),
                           self.depth_mm, self.status == 0 ? "" : fmt::format(", status {}", self.status));
      },
      "Short description.");
}

// ---- the finger

/// The FingerHandle in a Python object that pybind11 made. Null with TypeError set for another.
FingerHandle* fingerIn(PyObject* self) {
  // pybind11's own caster would find the same; it is called where the object is not as simple as ours (a subclass).
  const auto* instance = reinterpret_cast<const py::detail::instance*>(self);
  if (instance->simple_layout && instance->simple_value_holder[0] != nullptr) {
    return static_cast<FingerHandle*>(instance->simple_value_holder[0]);
  }
  PyErr_SetString(PyExc_TypeError, "Finger.__init__() was not called");
  return nullptr;
}

/// The usual tips without numpy's help: three floats of a list or a tuple, an array of three float64.
bool readTipFast(PyObject* const* given, Py_ssize_t count, Vec3& tip) {
  if (count == 1) {
    PyObject* one = given[0];
    if (PyTuple_CheckExact(one) || PyList_CheckExact(one)) {
      count = PySequence_Fast_GET_SIZE(one);
      given = PySequence_Fast_ITEMS(one);
    } else {
      const auto& numpy = py::detail::npy_api::get();
      if (Py_TYPE(one) != numpy.PyArray_Type_) return false;
      const auto* array = py::detail::array_proxy(one);
      if (array->nd != 1 || array->dimensions[0] != 3) return false;
      const auto* kind = py::detail::array_descriptor_proxy(array->descr);
      if (kind->type_num != py::detail::npy_api::NPY_DOUBLE_ || kind->byteorder == '>') return false;
      for (int axis = 0; axis < 3; ++axis)
        std::memcpy(&tip[axis], array->data + axis * array->strides[0], sizeof(double));
      return true;
    }
  }
  if (count != 3) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (!PyFloat_CheckExact(given[axis])) return false;
    tip[axis] = PyFloat_AS_DOUBLE(given[axis]);
  }
  return true;
}

Vec3 readAnyTip(PyObject* const* given, Py_ssize_t count) {
  if (count == 1) return asPoint(given[0], "tip");
  if (count != 3) throw py::type_error("step() takes a tip (3,) or x, y and z");
  Vec3 tip;
  for (int axis = 0; axis < 3; ++axis) tip[axis] = py::float_(py::reinterpret_borrow<py::object>(given[axis]));
  return tip;
}

PyObject* step(PyObject* self, PyObject* const* given, Py_ssize_t count) {
  FingerHandle* handle = fingerIn(self);
  if (handle == nullptr) return nullptr;
  try {
    Vec3 tip;
    if (!readTipFast(given, count, tip)) tip = readAnyTip(given, count);
    return py::cast(handle->finger.feel(tip)).release().ptr();
  } catch (py::error_already_set& error) {
    error.restore();
  } catch (const py::builtin_exception& error) {
    error.set_error();
  }
  return nullptr;
}

// In pybind11's form of signatures: the stubs are made from them.
constexpr const char* kStepDoc =
    "step(*args, **kwargs)\nOverloaded function.\n\n1. step(self: palpate._core.Finger, tip: numpy.typing.ArrayLike) "
    "-> palpate._core.Touch\n\nOne tick with the tip at (3,), mm, FingerSettings.tick_s after the last. A ball's tip "
    "is its centre.\n\nAn array of float64 is fastest. A tip that is not finite is lost: status 1, no force, and the "
    "finger stays as it was.\nRaises TypeError for what is not a number, ValueError for another shape. The "
    "interpreter's lock is kept.\n\n2. step(self: palpate._core.Finger, x: float, y: float, z: float) -> "
    "palpate._core.Touch\n\nThe same with three coordinates.";
PyMethodDef step_method = {"step", reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(&step)), METH_FASTCALL,
                           kStepDoc};

void bindFingerClass(py::module_& module) {
  py::class_<FingerHandle> finger(module, "Finger",
                                  "One finger on a world, one tick per call. Keeps its world alive. Not thread-safe.");
  finger.def(py::init([](const WorldPointer& world, const MaybeSettings& settings) {
               const auto checked = settingsOf(*world->world, settings, 1);
               return FingerHandle{world, std::move(engine::fingersOn(*world->world, checked).front())};
             }),
             "settings: a FingerSettings, or None for the scene's first finger. Raises palpate.Error if they do not "
             "suit the world.",
             py::arg("world"), py::arg("settings") = py::none());
  finger.def_property_readonly(
      "world", [](const FingerHandle& self) { return self.world; }, "The world that it touches.");
  finger.def_property_readonly(
      "settings", [](const FingerHandle& self) { return self.finger.settings; }, "Its settings.");
  finger.def(
      "lift", [](FingerHandle& self) { self.finger.lift(); },
      "Lifts the finger. The next tip may be anywhere; the motion in between makes no contact.");
  finger.def(
      "reset", [](FingerHandle& self) { self.finger.reset(); },
      "Resets to the initial state: lifts the finger, restarts its clock (for a breathing body) and puts moved lumps "
      "back.");
  const auto descriptor =
      py::reinterpret_steal<py::object>(PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(finger.ptr()), &step_method));
  if (!descriptor) throw py::error_already_set();
  finger.attr("step") = descriptor;
}

}  // namespace

py::dict numbersOf(const FingerSettings& settings) {
  py::dict named;
  for (const Field<FingerSettings>& field : contact::kFingerFields) {
    named[field.name.data()] = valueOf(field, settings);
  }
  return named;
}

void bindFinger(py::module_& module) {
  bindSettings(module);
  auto world = py::reinterpret_borrow<py::class_<WorldHandle, WorldPointer>>(module.attr("World"));
  world.def(
      "finger_settings",
      [](const WorldHandle& self, std::size_t n) { return engine::fingerSettings(self.world->scene, n); },
      "List of n FingerSettings: the scene's fingers in order, then point fingers with its friction.",
      py::arg("n") = 1);
  bindTouch(module);
  bindFingerClass(module);
}

}  // namespace palpate::python
