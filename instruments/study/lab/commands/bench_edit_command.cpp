// `palpate study bench edit`: a dysfunction is changed under a finger that presses, as by a slider, while the servo
// loop runs. How long until it is felt, whether a tick was missed for it, and how far the force jumps.
//
// scene -> scene::rebuilt (shares the body, copies the stiffness) -> ServoThread::change -> the first sample that names
// the new world
#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cli/kit/number_option.h"
#include "lab/commands/bench_arguments.h"
#include "lab/commands/bench_report.h"
#include "lab/commands/commands.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/servo_thread.h"
#include "palpate/scene/world.h"

namespace palpate::app {
namespace {

constexpr double kPressMm = 4.0;
constexpr double kRadiusMm = 25.0;
/// Change of a slider from one picture to the next.
constexpr double kChangePercent = 2.0;
/// No user calls a longer wait immediate.
constexpr double kPatienceS = 5.0;

struct EditArguments {
  std::string mesh = "back_1000000";
  double edits = 50.0;
};

/// A finger that stays pressed along z.
struct PressedPlace {
  Vec3 skin = Vec3::Zero();
  device::Device device() const {
    device::Device device;
    device.name = "pressed";
    device.read_tip = [skin = skin](std::uint64_t tick) {
      constexpr double kMmPerTick = 0.02;
      return Vec3(skin - Vec3(0, 0, std::min(kPressMm, kMmPerTick * static_cast<double>(tick)) - 1.0));
    };
    return device;
  }
};

/// Middle of the triangle that is nearest to the middle of the body and looks up.
PressedPlace pressedPlace(const scene::World& world) {
  const Vec3 middle = world.body->box.center();
  PressedPlace place;
  double nearest = 1e300;
  for (const tree::TriangleRecord& record : world.surface.geometry->tree.records) {
    const auto& [a, b, c] = record.corners;
    const Vec3 at = (a + b + c) / 3.0;
    const double aside = (at - middle).head<2>().squaredNorm();
    if (mesh::areaVector2(a, b, c).z() <= 0.0 || aside >= nearest) continue;
    nearest = aside;
    place.skin = at;
  }
  return place;
}

scene::Scene edited(const scene::Scene& scene, const Vec3& at, int edit) {
  scene::Scene next = scene;
  next.dysfunctions = {
      {.x_mm = at.x(), .y_mm = at.y(), .radius_mm = kRadiusMm, .change_percent = kChangePercent * (edit % 20)}};
  return next;
}

/// The servo loop under edits, seen from the thread that edits.
class EditedServo {
 public:
  EditedServo(std::shared_ptr<const scene::World> world, const PressedPlace& place)
      : world_(std::move(world)), servo_(makePlan(world_, true), {place.device()}) {
    waitUntil([&] { return ticks_ > 1000; });  // it has come to rest
    force_n_ = last_n_;
    largest_step_n_ = 0.0;
  }

  void edit(const scene::Scene& scene, std::vector<double>& rebuild_ms, std::vector<double>& felt_ms) {
    const Clock::time_point start = Clock::now();
    world_ = scene::rebuilt(*world_, scene);
    rebuild_ms.push_back(1e3 * secondsSince(start));
    servo_.change(makePlan(world_, false));
    const std::uint32_t before = world_number_;
    waitUntil([&] { return world_number_ != before; });
    felt_ms.push_back(1e3 * secondsSince(start));
  }

  double forceN() const { return force_n_; }
  double largestStepN() const { return largest_step_n_; }
  servo::LoopReport stop() { return servo_.stop(); }

 private:
  static engine::ServoPlan makePlan(const std::shared_ptr<const scene::World>& world, bool other_body) {
    engine::ServoPlan plan = engine::servoPlan(world, engine::fingerSettings(world->scene, 1));
    plan.other_body = other_body;
    return plan;
  }

  template <class Ready>
  void waitUntil(const Ready& ready) {
    const Clock::time_point start = Clock::now();
    while (!ready()) {
      if (secondsSince(start) > kPatienceS) throw Error("the servo loop did not apply the edit in time");
      servo_.exchange();
      readSamples();
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }

  void readSamples() {
    trace::Sample sample;
    while (servo_.pop(sample)) {
      const double force_n = sample.contact.force.norm();
      largest_step_n_ = std::max(largest_step_n_, std::abs(force_n - last_n_));
      last_n_ = force_n;
      world_number_ = sample.world;
      ++ticks_;
    }
  }

  std::shared_ptr<const scene::World> world_;
  engine::ServoThread servo_;
  std::uint64_t ticks_ = 0;
  std::uint32_t world_number_ = 0;
  double last_n_ = 0.0, force_n_ = 0.0, largest_step_n_ = 0.0;
};

Json measureEdits(const EditArguments& arguments, ProgressLine& progress) {
  const WrittenMesh mesh(arguments.mesh);
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = mesh.file();
  const Progress shown = progress.callback();
  const auto world = scene::build(scene, shown);
  const PressedPlace place = pressedPlace(*world);
  EditedServo servo(world, place);
  std::vector<double> rebuild_ms, felt_ms;
  const auto edits = static_cast<int>(arguments.edits);
  for (int edit = 1; edit <= edits; ++edit) {
    report(shown, "editing", static_cast<double>(edit) / edits);
    servo.edit(edited(scene, place.skin, edit), rebuild_ms, felt_ms);
    std::this_thread::sleep_for(std::chrono::milliseconds(16));  // a picture
  }
  const servo::LoopReport loop = servo.stop();
  Json json;
  json["mesh"] = arguments.mesh;
  json["triangles"] = world->body->skin.triangles.size();
  json["edits"] = edits;
  json["rebuild_ms"] = percentilesJson(lab::computePercentiles(rebuild_ms));  // until there is another world
  json["felt_ms"] = percentilesJson(lab::computePercentiles(felt_ms));        // until a tick has felt it
  json["ticks"] = loop.ticks;
  json["missed_ticks"] = loop.overruns;
  json["force_n"] = servo.forceN();               // before the first edit
  json["largest_step_n"] = servo.largestStepN();  // between two ticks, from the first edit on
  return json;
}

void addEditOptions(Command& command, EditArguments& a) {
  command.add_option("FILE", a.mesh, kMeshNamesHelp)->capture_default_str();
  addSetting(command, "--edits", a.edits, between(1.0, 10000.0), "Number of edits, 2 % each");
}

}  // namespace

void addBenchEditCommand(Command& parent) {
  addBench(parent, "edit", "Time how soon a changed dysfunction is felt under a pressing finger", addEditOptions,
           measureEdits);
}

}  // namespace palpate::app
