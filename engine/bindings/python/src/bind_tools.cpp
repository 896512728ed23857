// Tools: a batch of tools of several pads that persist between calls: an ultrasound head, a palm (contact/tool.h).
#include <fmt/format.h>
#include <pybind11/stl.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>

#include "batches.h"
#include "bindings.h"
#include "busy.h"
#include "felt_fields.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/contact/tool_shapes.h"
#include "thread_pool.h"

namespace palpate::python {

namespace {

/// Pads are some ten to a tool, so that a few tools are as much work as sixteen fingers.
constexpr std::size_t kToolsPerPart = 4;
/// How far a given rotation may be from one, as it was computed in single precision.
constexpr double kRotationSlack = 1e-5;

struct NamedTool {
  const char* name;
  contact::ToolShape (*make)();
};
constexpr std::array kTools = {NamedTool{"fingertip", contact::fingertipTool},
                               NamedTool{"knuckle", contact::knuckleTool}, NamedTool{"head", contact::headTool},
                               NamedTool{"palm", contact::palmTool}};

contact::ToolShape toolNamed(const std::string& name) {
  std::vector<std::string> names;
  for (const NamedTool& tool : kTools) {
    if (name == tool.name) return tool.make();
    names.emplace_back(tool.name);
  }
  throw py::value_error("tool: " + unknownName("tool", name, "", names));
}

/// Where what each tool feels is written.
struct ToolRows {
  double* force;
  double* moment;
  double* depth;
  std::int32_t* touching;

  void write(std::size_t row, const contact::Wrench& wrench, const contact::ToolState& state) const {
    for (int axis = 0; axis < 3; ++axis) {
      force[3 * row + static_cast<std::size_t>(axis)] = wrench.force_n[axis];
      moment[3 * row + static_cast<std::size_t>(axis)] = wrench.moment_n_mm[axis];
    }
    depth[row] = 0.0;
    for (const contact::FingerOutput& pad : state.felt) depth[row] = std::max(depth[row], pad.depth_mm);
    touching[row] = static_cast<std::int32_t>(state.touching);
  }
};

class ToolsHandle {
 public:
  ToolsHandle(std::vector<WorldPointer> worlds, std::size_t count, const std::string& tool, const py::object& settings,
              std::size_t threads)
      : worlds_(std::move(worlds)),
        shape_(toolNamed(tool)),
        settings_(settingsOf(*worlds_.front()->world, settings, 1).front()),
        at_(count, 0),
        commanded_(count, nowhere()),
        pool_(threads) {
    for (const WorldPointer& world : worlds_) addPlanes(*world->world);
    for (std::size_t i = 0; i < count; ++i) states_.push_back(stateIn(0));
  }

  std::size_t size() const { return states_.size(); }
  std::size_t pads() const { return shape_.pads.size(); }

  FeltDict step(const ArrayLike& given_positions, const ArrayLike& given_rotations, std::size_t substeps,
                const MaybeOut& out, const MaybeMask& mask) {
    const Busy::Guard guard(busy_, "Tools");
    requireOpen();
    if (substeps == 0) throw py::value_error("substeps: must be at least 1");
    const std::vector<contact::ToolPose> poses = posesOf(given_positions, given_rotations);
    const Masked moves = readMask(mask, out, size());
    py::dict answer;
    const ToolRows rows = rowsIn(answer, out);
    unlocked([&](Interrupts& interrupts) {
      pool_.share((size() + kToolsPerPart - 1) / kToolsPerPart,
                  [&](std::size_t part, const Pause& pause) {
                    const std::size_t end = std::min(size(), (part + 1) * kToolsPerPart);
                    for (std::size_t i = part * kToolsPerPart; i < end; ++i) {
                      if (moves.has(i)) stepOne(i, poses[i], substeps, rows, pause);
                    }
                  },
                  interrupts);
    });
    return FeltDict(answer);
  }

  void reset(const MaybeMask& mask, const MaybeNumbers& worlds) {
    const Busy::Guard guard(busy_, "Tools");
    requireOpen();
    const std::vector<std::size_t> numbers = worldNumbers(worlds, size(), worlds_.size());
    forMasked(mask, size(), [&](std::size_t i) {
      if (!numbers.empty() && numbers[i] != at_[i]) {
        at_[i] = numbers[i];
        states_[i] = stateIn(at_[i]);
      }
      contact::lift(states_[i]);
      commanded_[i] = nowhere();
    });
  }

  TouchList touches() {
    const Busy::Guard guard(busy_, "Tools");
    requireOpen();
    py::list all;
    for (const contact::ToolState& state : states_) {
      for (const contact::FingerOutput& pad : state.felt) all.append(py::cast(pad));
    }
    return TouchList(all);
  }

  void close() {
    const Busy::Guard guard(busy_, "Tools");
    closed_ = true;
    const Unlocked free;
    pool_.close();
  }

 private:
  void requireOpen() const {
    if (closed_) throw py::value_error("the Tools are closed");
  }
  static contact::ToolPose nowhere() {
    return {Vec3::Constant(std::numeric_limits<double>::quiet_NaN()), Mat3::Identity()};
  }

  /// Worlds of one body share them.
  void addPlanes(const scene::World& world) {
    if (world.breath || world.hdb) {
      throw Error("tools of several pads need skin that does not breathe, and no detecting box");
    }
    if (world.surface.planes) {
      planes_.push_back(world.surface.planes);
    } else if (!planes_.empty() && planes_.back()->geometry == world.surface.geometry) {
      planes_.push_back(planes_.back());
    } else {
      planes_.push_back(contact::planesOf(world.surface.geometry));
    }
  }
  contact::ToolState stateIn(std::size_t world) const {
    return contact::makeToolState(shape_, worlds_[world]->world->surface, planes_[world]);
  }

  std::vector<contact::ToolPose> posesOf(const ArrayLike& given_positions, const ArrayLike& given_rotations) const {
    const auto positions = asFloats(given_positions, "positions", 3);
    const auto rotations = asFloats(given_rotations, "rotations", 3);
    const auto count = static_cast<py::ssize_t>(size());
    if (positions.ndim() != 2 || positions.shape(0) != count) {
      throw py::value_error(fmt::format("positions: must be ({}, 3)", count));
    }
    if (rotations.ndim() != 3 || rotations.shape(0) != count || rotations.shape(1) != 3) {
      throw py::value_error(fmt::format("rotations: must be ({}, 3, 3)", count));
    }
    std::vector<contact::ToolPose> poses(size());
    for (std::size_t i = 0; i < size(); ++i) {
      poses[i].position = Eigen::Map<const Vec3>(positions.data() + 3 * i);
      poses[i].rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotations.data() + 9 * i);
      const Mat3 product = poses[i].rotation * poses[i].rotation.transpose();
      if (!poses[i].position.allFinite() || !((product - Mat3::Identity()).norm() < kRotationSlack) ||
          poses[i].rotation.determinant() < 0.0) {
        throw py::value_error(fmt::format("tool {}: its position must be finite, its rotation a rotation", i));
      }
    }
    return poses;
  }

  ToolRows rowsIn(py::dict& answer, const MaybeOut& out) const {
    if (!out.is_none() && !py::isinstance<py::dict>(out)) throw py::type_error("out: expected a dict of arrays");
    const auto column = [&]<class Number>(const char* name, std::vector<py::ssize_t> shape) {
      if (!out.is_none() && !out.contains(name)) throw py::value_error(fmt::format("out: array '{}' is missing", name));
      const py::object given = out.is_none() ? py::object(py::none()) : py::object(out[name]);
      py::array_t<Number> array = wholeArray<Number>(given, name, shape);
      answer[name] = array;
      return array.mutable_data();
    };
    const auto count = static_cast<py::ssize_t>(size());
    return {column.template operator()<double>("force", {count, 3}),
            column.template operator()<double>("moment", {count, 3}),
            column.template operator()<double>("depth", {count}),
            column.template operator()<std::int32_t>("touching", {count})};
  }

  /// Moves in a straight line, and turns about one axis, from the last pose.
  void stepOne(std::size_t i, const contact::ToolPose& to, std::size_t substeps, const ToolRows& rows,
               const Pause& pause) {
    const contact::ToolPose from = commanded_[i].position.allFinite() ? commanded_[i] : to;
    const Eigen::AngleAxisd turn(Mat3(from.rotation.transpose() * to.rotation));
    const contact::Surface& surface = worlds_[at_[i]]->world->surface;
    contact::Wrench wrench;
    for (std::size_t k = 1; k <= substeps; ++k) {
      if (k % 8 == 0) pause.check();
      const double share = static_cast<double>(k) / static_cast<double>(substeps);
      contact::ToolPose pose = to;
      if (k < substeps) {
        pose.position = from.position + (to.position - from.position) * share;
        pose.rotation = from.rotation * Eigen::AngleAxisd(turn.angle() * share, turn.axis()).toRotationMatrix();
      }
      wrench = contact::stepTool(surface, shape_, settings_, states_[i], std::span(&pose, 1));
    }
    commanded_[i] = to;
    rows.write(i, wrench, states_[i]);
  }

  std::vector<WorldPointer> worlds_;
  contact::ToolShape shape_;
  contact::FingerSettings settings_;
  std::vector<std::shared_ptr<const contact::SkinPlanes>> planes_;  ///< of each world
  std::vector<contact::ToolState> states_;
  std::vector<std::size_t> at_;               ///< world that each touches, a number in worlds_
  std::vector<contact::ToolPose> commanded_;  ///< where each was sent last; not finite: nowhere
  ThreadPool pool_;
  Busy busy_;
  bool closed_ = false;
};

}  // namespace

void bindTools(py::module_& module) {
  py::class_<ToolsHandle> tools(
      module, "Tools",
      "A batch of tools of several pads, rigid bodies with a pose each, on one world or shared among several; they "
      "keep their state between calls.\n\ntool: \"head\", a linear ultrasound head of 60 x 12 mm, x along it; "
      "\"palm\", "
      "\"fingertip\", \"knuckle\" (docs/explanation/tools.md). In its frame the skin is below, z points away from it. "
      "Lumps that move stay at their places.\n\nOne call at a time, as Fingers. `with` closes it.");
  tools.def(py::init([](const Worlds& world, std::size_t count, const std::string& tool, const MaybeSettings& settings,
                        std::size_t threads) {
              if (count == 0) throw py::value_error("n: must be at least 1");
              if (threads == 0) throw py::value_error("threads: must be at least 1");
              return std::make_unique<ToolsHandle>(worldsOf(world), count, tool, settings, threads);
            }),
            "n tools, all in the first world; settings: of every pad, whose radius is the tool's; None: the scene's. "
            "Raises palpate.Error for a world that breathes or has a detecting box, ValueError for an unknown tool.",
            py::arg("world"), py::arg("n"), py::kw_only(), py::arg("tool") = "head", py::arg("settings") = py::none(),
            py::arg("threads") = 1);
  tools.def("step", &ToolsHandle::step,
            "Moves every tool to its pose and returns its contact in the last tick: force (n, 3), N; moment (n, 3), N "
            "mm, about its position; depth (n,), mm, of its deepest pad; touching (n,) int32, pads on the "
            "skin.\n\npositions: (n, 3), mm, of its frame; rotations: (n, 3, 3), from its frame to the body's, columns "
            "its x, y and "
            "z\nsubsteps: ticks that the way takes, in a straight line and about one axis\nout, mask: as for "
            "Fingers.step\n\nThe interpreter's lock is released, Ctrl-C interrupts. Raises RuntimeError during another "
            "call, ValueError for shapes and what is no rotation.",
            py::arg("positions"), py::arg("rotations"), py::kw_only(), py::arg("substeps") = 1,
            py::arg("out") = py::none(), py::arg("mask") = py::none());
  tools.def("reset", &ToolsHandle::reset,
            "Lifts the tools with True in mask (n,), or all for None; their next poses may be anywhere. worlds: as for "
            "Fingers.reset. Raises RuntimeError, ValueError.",
            py::arg("mask") = py::none(), py::arg("worlds") = py::none());
  tools.def("touches", &ToolsHandle::touches,
            "List of a Touch for each pad of each tool in the last ticks. Raises RuntimeError during another call.");
  bindClosing(tools, "Number of tools.");
  tools.def_property_readonly("pads", &ToolsHandle::pads, "Number of pads of a tool.");
}

}  // namespace palpate::python
