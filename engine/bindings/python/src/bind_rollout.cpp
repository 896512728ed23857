// World.rollout: whole paths of many fingers in one call, without the interpreter's lock.
#include <fmt/format.h>

#include "bindings.h"
#include "felt_fields.h"
#include "palpate/engine/fingers.h"
#include "thread_pool.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

/// Ticks between two looks at the clock: at most a tenth of a millisecond of a point, ten of a ball.
constexpr std::size_t kTicksBetweenLooks = 64;

void rollOne(engine::Finger& finger, const double* tips, std::size_t ticks, const FeltRows& rows, std::size_t first_row,
             const Pause& pause) {
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    if (tick % kTicksBetweenLooks == 0) pause.check();
    const double* tip = tips + 3 * tick;
    rows.write(first_row + tick, finger.feel({tip[0], tip[1], tip[2]}));
  }
}

FeltDict rollout(const WorldPointer& world, const ArrayLike& given, const MaybeSettings& settings,
                 const MaybeFields& fields, std::size_t threads, const MaybeOut& out) {
  const auto tips = asFloats(given, "tips", 3);
  if (tips.ndim() != 3) {
    throw py::value_error("tips: must be (fingers, ticks, 3); the path of one finger (ticks, 3) is tips[None]");
  }
  const auto count = static_cast<std::size_t>(tips.shape(0));
  const auto ticks = static_cast<std::size_t>(tips.shape(1));
  if (threads == 0) throw py::value_error("threads: must be at least 1");
  std::vector<engine::Finger> fingers = engine::fingersOn(*world->world, settingsOf(*world->world, settings, count));
  const FeltArrays felt(*world->world, {tips.shape(0), tips.shape(1)}, fields, out);
  const double* from = tips.data();
  const std::size_t worth = std::max<std::size_t>(1, count * ticks / kMinTicksPerThread);
  unlocked([&](Interrupts& interrupts) {
    ThreadPool pool(std::min({threads, worth, std::max<std::size_t>(1, count)}));
    pool.share(
        count,
        [&](std::size_t i, const Pause& pause) {
          rollOne(fingers[i], from + 3 * ticks * i, ticks, felt.rows(), ticks * i, pause);
        },
        interrupts);
  });
  return FeltDict(felt.dict());
}

/// The loop that a C++ program would write around contact::step, for tools/bench-python: it stores the same numbers.
double nativeSeconds(const WorldPointer& world, const ArrayLike& given) {
  const auto tips = asFloats(given, "tips", 3);
  const auto settings = settingsOf(*world->world, py::none(), 1).front();
  const auto ticks = static_cast<std::size_t>(tips.size() / 3);
  const double* from = tips.data();
  return unlocked([&](Interrupts&) {
    struct Kept {
      Vec3 force, proxy, anchor, normal;
      double depth_mm;
      Index triangle;
      contact::Touch touch;
      std::uint32_t status;
    };
    std::vector<Kept> kept(ticks);
    contact::FingerState state;
    const auto began = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < ticks; ++i) {
      const contact::FingerOutput felt =
          contact::step(world->world->surface, settings, state, {from[3 * i], from[3 * i + 1], from[3 * i + 2]});
      kept[i] = {felt.force,    felt.proxy,    felt.anchor, felt.normal,
                 felt.depth_mm, felt.triangle, felt.touch,  felt.status};
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  });
}

}  // namespace

void bindRollout(py::module_& module) {
  auto world = py::reinterpret_borrow<py::class_<WorldHandle, WorldPointer>>(module.attr("World"));
  world.def(
      "rollout", &rollout,
      "Whole paths: one finger a row of tips (F, T, 3), mm, each tick FingerSettings.tick_s after the last.\n\n"
      "settings: None for the scene's fingers, a FingerSettings for all, or a sequence of F\n"
      "fields: names of what is answered; None for force (F, T, 3) N, depth (F, T) mm, proxy, anchor and normal\n"
      "    (F, T, 3), triangle (F, T) int32, -1 when free, state (F, T) uint8, 0 free, 1 stick, 2 slip, and status\n"
      "    (F, T) uint32. Also tip, hold (F, T, 3), tissue, rest, anchor_triangle, radius (F, T), and of lumps\n"
      "    lump_force (F, T, 3) N, part of force, lump_share, their normal force over that of the press without them,\n"
      "    lump (F, T) int32, the mobile one that is nearest or -1, lump_moved (F, T, 2), how far it is from its "
      "place,\n"
      "    mm across and up. In a world with lumps or pads None answers all that `pressure` needs, too\n"
      "threads: fingers are shared among so many, where there is work enough for them\n"
      "out: a dict of C-ordered arrays that are written instead of fresh ones; says the fields where `fields` does "
      "not\n\n"
      "Every finger starts again: nothing is kept between two calls. The interpreter's lock is released, Ctrl-C "
      "interrupts. Raises ValueError for shapes, TypeError for what is not a number, palpate.Error for settings.",
      py::arg("tips"), py::kw_only(), py::arg("settings") = py::none(), py::arg("fields") = py::none(),
      py::arg("threads") = 1, py::arg("out") = py::none());
  module.def("_native_rollout_seconds", &nativeSeconds,
             "Time in s of a C++ loop over the path (T, 3) of one finger, storing its outputs; for tools/bench-python.",
             py::arg("world"), py::arg("tips"));
}

}  // namespace palpate::python
