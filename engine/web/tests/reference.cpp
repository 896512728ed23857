// What the browser's engine is held against: writes a body as STL and the path back_slide as a table, and prints as
// JSON what native code felt along it. The hash is that of instruments/study/lab/runs/contact_run.h, of the mesh
// *file*, as node reads it too.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "lab/runs/contact_run.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/base/error.h"
#include "palpate/body/places.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/host.h"
#include "palpate/scene/ready_body.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"
#include "web/engine/frame_packer.h"
#include "web/engine/live_body.h"
#include "web/engine/tick_blocks.h"

namespace {

std::string figuresJson(palpate::bench::ContactWorld& world, double radius_mm) {
  palpate::contact::FingerSettings finger;
  finger.radius_mm = radius_mm;
  const palpate::device::Trajectory path = palpate::lab::workloadPath("back_slide");
  const palpate::bench::ContactFigures figures = palpate::bench::measureContact(world, path, finger);
  const auto tips = palpate::device::resampled(path, finger.tick_s).tip_mm;
  std::vector<palpate::contact::FingerOutput> outputs(tips.size());
  const auto tick_us = palpate::lab::computePercentiles(palpate::web::timeBlocks(world.surface, finger, tips, outputs));
  return fmt::format(R"({{"radius_mm":{},"hash":"{:016x}","ticks":{},"p50_us":{:.4f},"p99_us":{:.4f}}})", radius_mm,
                     figures.hash, figures.ticks, tick_us.p50, tick_us.p99);
}

void run(const std::filesystem::path& folder) {
  const std::filesystem::path stl = folder / "back.stl";
  palpate::mesh::save(stl, palpate::lab::workloadMesh("back_20389"));
  palpate::device::writeTrajectory(folder / "back_slide.csv", palpate::lab::workloadPath("back_slide"));
  palpate::bench::ContactWorld world = palpate::bench::buildContactWorld(palpate::mesh::load(stl));
  fmt::print("[{},{}]\n", figuresJson(world, 0.0), figuresJson(world, 8.0));
}

// ---- the trunk

constexpr std::size_t kAims = 60;  // of each finger
constexpr std::size_t kTicksOfAim = 40;

/// A number that is read back to the last bit.
void put(std::ostream& out, double value, char after) { out << fmt::format("{}", value) << after; }

palpate::device::FingerTarget aimBeside(const palpate::body::SkinLandmark& landmark, std::size_t i, double aside_mm) {
  palpate::device::FingerTarget target;
  target.present = true;
  target.pressed = i % 10 != 9;
  target.place = landmark.position + palpate::Vec3(aside_mm, -1.5 * static_cast<double>(i), 0.0);
  target.normal = landmark.normal;
  target.depth_mm = 2.0 + 0.2 * static_cast<double>(i % 30);
  return target;
}

void writeFelt(std::ostream& out, const palpate::contact::FingerOutput& felt) {
  for (const palpate::Vec3* v : {&felt.tip, &felt.proxy, &felt.normal, &felt.force}) {
    for (const double axis : *v) put(out, axis, ',');
  }
  put(out, felt.depth_mm, ',');
  out << static_cast<int>(felt.touch) << ',' << felt.status << '\n';
}

palpate::scene::Scene sceneOfTrunk(std::size_t triangles) {
  palpate::scene::Scene scene;
  scene.body.kind = palpate::scene::BodyKind::trunk;
  scene.body.triangles = triangles;
  return scene;
}

palpate::web::LiveBody trunk(std::size_t triangles) {
  return palpate::web::LiveBody(palpate::scene::build(sceneOfTrunk(triangles)));
}

/// The file that the page's build makes, before gzip.
void writeReadyTrunk(const std::filesystem::path& file, std::size_t triangles) {
  const palpate::scene::BodySettings settings = sceneOfTrunk(triangles).body;
  const std::string bytes = palpate::scene::encodedBody({triangles, palpate::scene::makeBody(settings, {})});
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// What packaging/npm/examples/press.mjs does; prints its last line.
void pressAsTheExample(std::size_t triangles) {
  palpate::web::LiveBody body = trunk(triangles);
  const auto& landmarks = body.world().body->anatomy.landmarks;
  const auto t6 = std::ranges::find_if(
      landmarks, [](const auto& landmark) { return palpate::body::spokenName(landmark.name) == "T6"; });
  if (t6 == landmarks.end()) throw palpate::Error("the trunk has no T6");
  palpate::device::FingerTarget target;
  target.present = target.pressed = true;
  target.place = t6->position;
  target.normal = t6->normal;
  target.depth_mm = 12.0;
  body.aim(0, target);
  body.run(600);
  target.place.y() += 10.0;
  body.aim(0, target);
  body.run(200);
  const palpate::Vec3 force = body.felt(0).force;
  fmt::print("force {} {} {} N\n", force.x(), force.y(), force.z());
}

void runOnTrunk(const std::filesystem::path& folder, std::size_t triangles) {
  writeReadyTrunk(folder / "trunk.bin", triangles);
  palpate::web::LiveBody body = trunk(triangles);
  const auto& landmarks = body.world().body->anatomy.landmarks;
  std::ofstream aims(folder / "aims.csv");
  std::ofstream felt(folder / "felt.csv");
  for (std::size_t i = 0; i < kAims; ++i) {
    for (std::size_t finger = 0; finger < palpate::web::kFingers; ++finger) {
      const auto target = aimBeside(landmarks[7 * finger], i, finger == 0 ? -25.0 : 35.0);
      body.aim(finger, target);
      aims << finger << ',' << (target.pressed ? 1 : 0) << ',';
      for (const double axis : target.place) put(aims, axis, ',');
      for (const double axis : target.normal) put(aims, axis, ',');
      put(aims, target.depth_mm, '\n');
    }
    for (std::size_t tick = 0; tick < kTicksOfAim; ++tick) {
      body.run(1);
      for (std::size_t finger = 0; finger < palpate::web::kFingers; ++finger) writeFelt(felt, body.felt(finger));
    }
  }
  palpate::web::FramePacker frame;
  body.packFrame(frame, true);
  std::ofstream skin(folder / "skin.f32", std::ios::binary);
  const std::vector<float>& values = frame.values();
  skin.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(float)));
  fmt::print("{{\"ticks_of_aim\":{},\"triangles\":{}}}\n", kTicksOfAim, body.world().body->skin.triangles.size());
}

/// Throws Error where the page's lumps are not those of this scene.
void compareLumps(const char* scene) {
  const auto preset = palpate::scene::load(scene).lumps;
  const auto page = palpate::web::presetLumps();
  bool same = page.size() == preset.size();
  for (std::size_t i = 0; same && i < page.size(); ++i) {
    const palpate::scene::LumpSettings &one = page[i], &other = preset[i];
    same = one.name == other.name && one.at == other.at && one.depth_mm == other.depth_mm &&
           one.halfAxes() == other.halfAxes() && one.stiffness_ratio == other.stiffness_ratio &&
           one.young_kpa == other.young_kpa && one.edge == other.edge && one.raise_mm == other.raise_mm &&
           one.mobility_mm_per_n == other.mobility_mm_per_n && one.mobility_limit_mm == other.mobility_limit_mm;
  }
  if (!same) throw palpate::Error("the page's lumps (engine/web/engine/live_body.cpp) are not those of the scene");
}

}  // namespace

int main(int count, char** words) {
  if (count != 2 && count != 3) {
    std::fputs("usage: web_reference FOLDER [TRIANGLES] | --lumps SCENE | --press TRIANGLES\n", stderr);
    return 2;
  }
  palpate::installHost();
  try {
    if (count == 3 && std::string_view(words[1]) == "--lumps") {
      compareLumps(words[2]);
      return 0;
    }
    if (count == 3 && std::string_view(words[1]) == "--press") {
      pressAsTheExample(std::stoul(words[2]));
      return 0;
    }
    count == 2 ? run(words[1]) : runOnTrunk(words[1], std::stoul(words[2]));
  } catch (const palpate::Error& error) {
    fmt::print(stderr, "web_reference: {}\n", error.what());
    return 1;
  }
  return 0;
}
