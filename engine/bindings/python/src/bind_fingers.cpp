// Fingers: a batch of fingers that persist between calls, for vectorised environments.
#include <fmt/format.h>

#include <algorithm>

#include "bindings.h"
#include "busy.h"
#include "felt_fields.h"
#include "palpate/engine/fingers.h"
#include "thread_pool.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

/// Fingers per part: small enough to look for Ctrl-C between two, large enough to be worth a counter.
constexpr std::size_t kFingersPerPart = 16;

struct MaybeMaskName {
  static constexpr auto name = py::detail::const_name("Optional[numpy.typing.ArrayLike]");
};
using MaybeMask = Named<MaybeMaskName>;
struct TouchListName {
  static constexpr auto name = py::detail::const_name("list[palpate._core.Touch]");
};
using TouchList = Named<TouchListName>;

class FingersHandle {
 public:
  FingersHandle(WorldPointer world, std::size_t count, const py::object& settings, std::size_t threads)
      : world_(std::move(world)),
        fingers_(engine::fingersOn(*world_->world, settingsOf(*world_->world, settings, count))),
        commanded_(count, nowhere()),
        felt_(count),
        pool_(threads) {}

  const WorldPointer& world() const { return world_; }
  std::size_t size() const { return fingers_.size(); }
  std::size_t threads() const { return pool_.threads(); }

  FeltDict step(const ArrayLike& given, std::size_t substeps, const MaybeFields& fields, const MaybeOut& out) {
    const Busy::Guard guard(busy_, "Fingers");
    requireOpen();
    const auto tips = asFloats(given, "tips", 3);
    if (tips.ndim() != 2 || static_cast<std::size_t>(tips.shape(0)) != size()) {
      throw py::value_error(fmt::format("tips: must be ({}, 3)", size()));
    }
    if (substeps == 0) throw py::value_error("substeps: must be at least 1");
    const FeltArrays arrays(*world_->world, {tips.shape(0)}, fields, out);
    const double* to = tips.data();
    unlocked([&](Interrupts& interrupts) { stepAll(to, substeps, arrays.rows(), interrupts); });
    return FeltDict(arrays.dict());
  }

  TouchList touches() {
    const Busy::Guard guard(busy_, "Fingers");
    requireOpen();
    py::list all;
    for (const contact::FingerOutput& felt : felt_) all.append(py::cast(felt));
    return TouchList(all);
  }

  /// Those whose flag is set; all for None.
  template <class Change>
  void forMasked(const py::object& mask, const Change& change) {
    const Busy::Guard guard(busy_, "Fingers");
    requireOpen();
    if (mask.is_none()) {
      for (std::size_t i = 0; i < size(); ++i) change(i);
      return;
    }
    const auto flags = py::array::ensure(mask);
    if (!flags || flags.dtype().kind() != 'b' || flags.ndim() != 1 ||
        static_cast<std::size_t>(flags.size()) != size()) {
      PyErr_Clear();
      throw py::value_error(fmt::format("mask: must be ({},) of bool", size()));
    }
    for (std::size_t i = 0; i < size(); ++i) {
      if (*static_cast<const bool*>(flags.data(static_cast<py::ssize_t>(i)))) change(i);
    }
  }
  void reset(const MaybeMask& mask) {
    forMasked(mask, [this](std::size_t i) {
      fingers_[i].reset();
      forget(i);
    });
  }
  void lift(const MaybeMask& mask) {
    forMasked(mask, [this](std::size_t i) {
      fingers_[i].lift();
      forget(i);
    });
  }

  void close() {
    const Busy::Guard guard(busy_, "Fingers");
    closed_ = true;
    const Unlocked free;
    pool_.close();
  }

 private:
  void requireOpen() const {
    if (closed_) throw py::value_error("the Fingers are closed");
  }
  static Vec3 nowhere() { return Vec3::Constant(std::numeric_limits<double>::quiet_NaN()); }
  void forget(std::size_t i) {
    commanded_[i] = nowhere();
    felt_[i] = {};
  }

  void stepAll(const double* tips, std::size_t substeps, const FeltRows& rows, Interrupts& interrupts) {
    const auto part_of_them = [&](std::size_t part, const Pause& pause) {
      const std::size_t end = std::min(size(), (part + 1) * kFingersPerPart);
      for (std::size_t i = part * kFingersPerPart; i < end; ++i) {
        stepOne(i, {tips[3 * i], tips[3 * i + 1], tips[3 * i + 2]}, substeps, pause);
        rows.write(i, felt_[i]);
      }
    };
    const std::size_t parts = (size() + kFingersPerPart - 1) / kFingersPerPart;
    if (size() * substeps < 2 * kMinTicksPerThread) {  // not worth waking a thread
      ThreadPool(1).share(parts, part_of_them, interrupts);
    } else {
      pool_.share(parts, part_of_them, interrupts);
    }
  }

  /// Moves in a straight line from the last tip.
  void stepOne(std::size_t i, const Vec3& to, std::size_t substeps, const Pause& pause) {
    const Vec3 from = commanded_[i].allFinite() ? commanded_[i] : to;
    for (std::size_t k = 1; k <= substeps; ++k) {
      if (k % 64 == 0) pause.check();
      const double share = static_cast<double>(k) / static_cast<double>(substeps);
      felt_[i] = fingers_[i].feel(k == substeps ? to : from + (to - from) * share);
    }
    commanded_[i] = to;
  }

  WorldPointer world_;
  std::vector<engine::Finger> fingers_;
  std::vector<Vec3> commanded_;              ///< where each was sent last; not finite: nowhere
  std::vector<contact::FingerOutput> felt_;  ///< one per finger, last tick
  ThreadPool pool_;
  Busy busy_;
  bool closed_ = false;
};

}  // namespace

void bindFingers(py::module_& module) {
  py::class_<FingersHandle> fingers(
      module, "Fingers",
      "A batch of fingers on one world; they keep their state between calls.\n\nOne call at a time: a second, from "
      "another thread, raises RuntimeError. After a fork the child may use it, threads and all. `with` closes it.");
  fingers.def(
      py::init([](const WorldPointer& world, std::size_t count, const MaybeSettings& settings, std::size_t threads) {
        if (count == 0) throw py::value_error("n: must be at least 1");
        if (threads == 0) throw py::value_error("threads: must be at least 1");
        return std::make_unique<FingersHandle>(world, count, settings, threads);
      }),
      "n fingers; settings: None for the scene's, a FingerSettings for all, or a sequence of n; threads: share the "
      "work of a call above 5,000 ticks. Raises palpate.Error if the settings do not suit the world.",
      py::arg("world"), py::arg("n"), py::kw_only(), py::arg("settings") = py::none(), py::arg("threads") = 1);
  fingers.def("step", &FingersHandle::step,
              "Moves every finger to its tip (n, 3), mm, and returns its contact in the last tick.\n\nsubsteps: ticks "
              "that the way takes, in a straight line from where the finger was sent last: tick k is at from + (to - "
              "from) * (k / substeps)\nfields, out: as for World.rollout, arrays (n, ...)\n\nArrays are fresh unless "
              "`out` is given. The interpreter's lock is released, Ctrl-C interrupts: some fingers have moved then. "
              "Raises RuntimeError while another call is at work, ValueError for shapes.",
              py::arg("tips"), py::kw_only(), py::arg("substeps") = 1, py::arg("fields") = py::none(),
              py::arg("out") = py::none());
  fingers.def("reset", &FingersHandle::reset,
              "Resets the fingers with True in mask (n,), or all for None. Raises RuntimeError, ValueError.",
              py::arg("mask") = py::none());
  fingers.def("lift", &FingersHandle::lift,
              "Lifts the fingers with True in mask (n,), or all for None; their next tips may be anywhere. Raises "
              "RuntimeError, ValueError.",
              py::arg("mask") = py::none());
  fingers.def("touches", &FingersHandle::touches,
              "List of the n Touch of the last ticks, for Skin.apply. Raises RuntimeError during another call.");
  fingers.def("close", &FingersHandle::close,
              "Ends its threads. Later calls raise ValueError; closing again has no effect.");
  fingers.def(
      "__enter__", [](const py::object& self) { return self; }, "Returns itself.");
  fingers.def(
      "__exit__", [](FingersHandle& self, const py::args&) { self.close(); }, "Calls close().");
  fingers.def("__len__", &FingersHandle::size, "Number of fingers.");
  fingers.def_property_readonly("world", &FingersHandle::world, "The world that they touch.");
  fingers.def_property_readonly("threads", &FingersHandle::threads, "Number of threads that share the work of a call.");
}

}  // namespace palpate::python
