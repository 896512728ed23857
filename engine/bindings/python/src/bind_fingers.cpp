// Fingers: a batch of fingers that persist between calls, on one world or several, for vectorised environments.
#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "batches.h"
#include "bindings.h"
#include "busy.h"
#include "felt_fields.h"
#include "palpate/engine/fingers.h"
#include "thread_pool.h"

namespace palpate::python {

namespace {

/// Fingers per part: small enough to look for Ctrl-C between two, large enough to be worth a counter.
constexpr std::size_t kFingersPerPart = 16;

class FingersHandle {
 public:
  FingersHandle(std::vector<WorldPointer> worlds, std::size_t count, const py::object& settings, std::size_t threads)
      : worlds_(std::move(worlds)),
        settings_(settingsOf(*worlds_.front()->world, settings, count)),
        fingers_(engine::fingersOn(*worlds_.front()->world, settings_)),
        at_(count, 0),
        commanded_(count, nowhere()),
        felt_(count),
        pool_(threads) {
    for (const WorldPointer& world : worlds_) engine::checkFingers(*world->world, settings_);
  }

  const WorldPointer& world() const { return worlds_.front(); }
  const std::vector<WorldPointer>& worlds() const { return worlds_; }
  std::size_t size() const { return fingers_.size(); }
  std::size_t threads() const { return pool_.threads(); }

  FeltDict step(const ArrayLike& given, std::size_t substeps, const MaybeFields& fields, const MaybeOut& out,
                const MaybeMask& mask) {
    const Busy::Guard guard(busy_, "Fingers");
    requireOpen();
    const auto tips = asFloats(given, "tips", 3);
    if (tips.ndim() != 2 || static_cast<std::size_t>(tips.shape(0)) != size()) {
      throw py::value_error(fmt::format("tips: must be ({}, 3)", size()));
    }
    if (substeps == 0) throw py::value_error("substeps: must be at least 1");
    const Masked moves = readMask(mask, out, size());
    const FeltArrays arrays(richestWorld(), {tips.shape(0)}, fields, out);
    const double* to = tips.data();
    unlocked([&](Interrupts& interrupts) { stepAll({to, moves, substeps}, arrays.rows(), interrupts); });
    return FeltDict(arrays.dict());
  }

  TouchList touches() {
    const Busy::Guard guard(busy_, "Fingers");
    requireOpen();
    py::list all;
    for (const contact::FingerOutput& felt : felt_) all.append(py::cast(felt));
    return TouchList(all);
  }

  void reset(const MaybeMask& mask, const MaybeNumbers& worlds) {
    const Busy::Guard guard(busy_, "Fingers");
    requireOpen();
    const std::vector<std::size_t> numbers = worldNumbers(worlds, size(), worlds_.size());
    forMasked(mask, size(), [&](std::size_t i) {
      if (numbers.empty() || numbers[i] == at_[i]) {
        fingers_[i].reset();
      } else {
        at_[i] = numbers[i];
        fingers_[i] = std::move(engine::fingersOn(*worlds_[at_[i]]->world, {&settings_[i], 1}).front());
      }
      forget(i);
    });
  }
  void lift(const MaybeMask& mask) {
    const Busy::Guard guard(busy_, "Fingers");
    requireOpen();
    forMasked(mask, size(), [this](std::size_t i) {
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
  /// One with lumps or pads, which says what is answered by default; the first where none has.
  const scene::World& richestWorld() const {
    for (const WorldPointer& one : worlds_) {
      if (one->world->surface.lumps || one->world->pressure) return *one->world;
    }
    return *worlds_.front()->world;
  }
  static Vec3 nowhere() { return Vec3::Constant(std::numeric_limits<double>::quiet_NaN()); }
  void forget(std::size_t i) {
    commanded_[i] = nowhere();
    felt_[i] = {};
  }

  /// Where the fingers go in one call.
  struct Way {
    const double* tips;
    const Masked& moves;
    std::size_t substeps;
  };
  void stepAll(const Way& way, const FeltRows& rows, Interrupts& interrupts) {
    const auto part_of_them = [&](std::size_t part, const Pause& pause) {
      const std::size_t end = std::min(size(), (part + 1) * kFingersPerPart);
      for (std::size_t i = part * kFingersPerPart; i < end; ++i) {
        if (!way.moves.has(i)) continue;
        const double* tip = way.tips + 3 * i;
        stepOne(i, {tip[0], tip[1], tip[2]}, way.substeps, pause);
        rows.write(i, felt_[i]);
      }
    };
    const std::size_t parts = (size() + kFingersPerPart - 1) / kFingersPerPart;
    if (size() * way.substeps < 2 * kMinTicksPerThread) {  // not worth waking a thread
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

  std::vector<WorldPointer> worlds_;
  std::vector<contact::FingerSettings> settings_;
  std::vector<engine::Finger> fingers_;
  std::vector<std::size_t> at_;              ///< world that each touches, a number in worlds_
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
      "A batch of fingers on one world, or shared among several; they keep their state between calls.\n\nOne call at a "
      "time: a second, from another thread, raises RuntimeError. After a fork the child may use it, threads and all. "
      "`with` closes it.");
  fingers.def(
      py::init([](const Worlds& world, std::size_t count, const MaybeSettings& settings, std::size_t threads) {
        if (count == 0) throw py::value_error("n: must be at least 1");
        if (threads == 0) throw py::value_error("threads: must be at least 1");
        return std::make_unique<FingersHandle>(worldsOf(world), count, settings, threads);
      }),
      "n fingers; world: one, or several, and all begin in the first; settings: None for the (first) scene's, a "
      "FingerSettings for all, or a sequence of n; threads: share the work of a call above 5,000 ticks. Raises "
      "palpate.Error if the settings do not suit a world.",
      py::arg("world"), py::arg("n"), py::kw_only(), py::arg("settings") = py::none(), py::arg("threads") = 1);
  fingers.def(
      "step", &FingersHandle::step,
      "Moves every finger to its tip (n, 3), mm, and returns its contact in the last tick.\n\nsubsteps: ticks "
      "that the way takes, in a straight line from where the finger was sent last: tick k is at from + (to - "
      "from) * (k / substeps)\nfields, out: as for World.rollout, arrays (n, ...)\nmask: (n,) bool, those that "
      "move; the others' clocks stand still, and their rows of `out` stay as they are; None: all\n\nArrays are "
      "fresh unless `out` is given. The interpreter's lock is released, Ctrl-C interrupts: some fingers have moved "
      "then. Raises RuntimeError while another call is at work, ValueError for shapes.",
      py::arg("tips"), py::kw_only(), py::arg("substeps") = 1, py::arg("fields") = py::none(),
      py::arg("out") = py::none(), py::arg("mask") = py::none());
  fingers.def("reset", &FingersHandle::reset,
              "Resets the fingers with True in mask (n,), or all for None.\n\nworlds: (n,) whole numbers of the worlds "
              "that they go to, as they were given, read for all but used where the mask is True; None: each stays in "
              "its world. Raises RuntimeError, ValueError.",
              py::arg("mask") = py::none(), py::arg("worlds") = py::none());
  fingers.def("lift", &FingersHandle::lift,
              "Lifts the fingers with True in mask (n,), or all for None; their next tips may be anywhere. Raises "
              "RuntimeError, ValueError.",
              py::arg("mask") = py::none());
  fingers.def("touches", &FingersHandle::touches,
              "List of the n Touch of the last ticks, for Skin.apply. Raises RuntimeError during another call.");
  bindClosing(fingers, "Number of fingers.");
  fingers.def_property_readonly("world", &FingersHandle::world, "The world that they touch; the first of several.");
  fingers.def_property_readonly("worlds", &FingersHandle::worlds, "List of the worlds that they touch.");
  fingers.def_property_readonly("threads", &FingersHandle::threads, "Number of threads that share the work of a call.");
}

}  // namespace palpate::python
