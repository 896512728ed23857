// The servo thread goes on whatever the display does: resizing, loading, rebuilding, writing pictures.
//
// Here each disturbance lasts about a second and what is asked for is what no load of the machine can spoil: that ticks
// go on while a frame is stuck, that no sample is lost. PALPATE_HEAVY=1 runs each for five seconds, prints the servo's
// statistics (docs/reference/viewer.md has them) and compares them with an idle run.
#include <cstdlib>
#include <functional>
#include <iostream>
#include <new>

#include "palpate/base/stopwatch.h"
#include "stage.h"

namespace {

std::atomic<bool> armed{false};
std::atomic<std::size_t> allocations{0};
const std::thread::id kMainThread = std::this_thread::get_id();

void* counted(std::size_t bytes) noexcept {
  if (armed.load(std::memory_order_relaxed) && std::this_thread::get_id() != kMainThread) ++allocations;
  return std::malloc(bytes);
}

}  // namespace

void* operator new(std::size_t bytes) {
  if (void* memory = counted(bytes)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept { return counted(bytes); }
// Not in line: the compiler would see free() beside a `new` that it did not look into, and warn.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }

namespace palpate::viewer {
namespace {

bool heavy() { return std::getenv("PALPATE_HEAVY") != nullptr; }
double phaseS() { return heavy() ? 5.0 : 0.4; }

double nowS() { return static_cast<double>(monotonicNs()) * 1e-9; }

/// Presses, so that ticks have work to do, and disturbs for a while.
servo::LoopReport disturbed(const std::function<void(Stage&, int)>& disturb) {
  Stage stage;
  stage.draws = true;  // drawing is what disturbs
  stage.move(stage.middle());
  stage.key(window::Key::enter);
  EXPECT_TRUE(stage.until([&] { return stage.finger().depth_mm > 5.0; }));
  const double end_s = nowS() + phaseS();
  for (int i = 0; nowS() < end_s; ++i) disturb(stage, i);
  EXPECT_EQ(stage.state().performance.dropped_samples, 0u);
  EXPECT_GT(stage.finger().depth_mm, 0.0) << "still pressed";
  return stage.viewer->finish();
}

struct Phase {
  const char* name;
  std::function<void(Stage&, int)> disturb;
};

std::vector<Phase> phases(const std::filesystem::path& big) {
  return {
      {"idle", [](Stage& stage, int) { stage.frame(); }},
      {"resize storm",
       [](Stage& stage, int i) {
         stage.viewer->frame(640 + 64 * (i % 13), 400 + 32 * (i % 11), 1.0, stage.now_s += 1.0 / 60.0, {});
       }},
      {"rebuild loop",
       [](Stage& stage, int i) {
         stage.state().scene.stiffness.constant_n_per_mm = 0.4 + 0.01 * (i % 50);
         if (i % 30 == 0) stage.state().output.changed |= kMapChange;
         stage.frame();
       }},
      {"PNG sequence",
       [](Stage& stage, int i) {
         if (i == 0) stage.state().request(ToggleSequence{});
         stage.frame();
       }},
      {"load of 1 M triangles",
       [big](Stage& stage, int i) {
         if (i == 0) stage.drop(big);
         stage.frame();
       }},
  };
}

TEST(ServoProof, GoesOnWhateverTheDisplayDoes) {
  const support::TemporaryFolder folder;
  const auto big = folder / "big.ply";
  mesh::save(big, zoo::hugeGrid(heavy() ? 1'000'000 : 100'000));
  double idle_late_us = 0.0;
  for (const Phase& phase : phases(big)) {
    const servo::LoopReport report = disturbed(phase.disturb);
    EXPECT_EQ(report.dropped_samples, 0u) << phase.name;
    EXPECT_GT(report.ticks, static_cast<std::uint64_t>(300.0 * phaseS())) << phase.name;
    if (!heavy()) continue;
    std::cout << phase.name << ": " << report.ticks << " ticks, " << report.overruns << " overruns, tick p50 "
              << report.compute.p50_us << " p99 " << report.compute.p99_us << " us, late p50 " << report.lateness.p50_us
              << " p99 " << report.lateness.p99_us << " p99.9 " << report.lateness.p99_9_us << " max "
              << report.lateness.max_us << " us\n";
    if (idle_late_us == 0.0) idle_late_us = report.lateness.p99_9_us;
    EXPECT_LT(report.lateness.p99_9_us, 4.0 * idle_late_us + 1000.0) << phase.name;
  }
}

TEST(ServoProof, TicksGoOnWhileAFrameIsStuck) {
  Stage stage;
  ASSERT_TRUE(stage.until([&] { return stage.state().performance.servo.ticks >= 1000; }));
  const std::size_t before = stage.state().plots.fingers[0].size();
  const double end_s = nowS() + 0.5;
  while (nowS() < end_s) {
  }  // a display that does nothing at all
  stage.frame();
  EXPECT_GT(stage.state().plots.fingers[0].size(), before + 200);
}

TEST(ServoProof, TheServoThreadAllocatesNothing) {
  const support::TemporaryFolder folder;
  const auto world = scene::build(sheetScene(folder));
  LiveServo servo(planFor(world, world->scene, true));
  device::FingerTarget target;
  target.present = true;
  target.pressed = true;
  target.radius_mm = 8.0;
  const auto place = view::skinNear(world->surface, mesh::boundingBox(world->body->skin).center(), 100.0);
  ASSERT_TRUE(place);
  target.place = place->point;
  target.normal = place->normal;
  servo.point(0, target);
  while (servo.thread().vitals().ticks < 1000) std::this_thread::yield();
  armed = true;
  int turns = 0;
  while (servo.thread().vitals().ticks < 3000) {
    target.place.x() = place->point.x() + (++turns % 2 == 0 ? 0.01 : -0.01);
    servo.point(0, target);
    servo.thread().change(planFor(world, world->scene, false));
    servo.thread().exchange();
    std::this_thread::yield();
  }
  armed = false;
  EXPECT_EQ(allocations.load(), 0u);
  EXPECT_GT(servo.thread().contacts()[0].contact.depth_mm, 1.0);
}

}  // namespace
}  // namespace palpate::viewer
