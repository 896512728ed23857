// Scene files -> the bits of what they give: a line of JSON each. The same lines are wanted from every compiler,
// processor and system (tools/check-platforms); kept.jsonl has them.
//
//   scene file ─ scene::load, scene::build ─► World ─ runTick along the scene's paths ─► forces ─ LivingSkin ─► skin
//
// Stands on the core and on the reader of scene files alone, so that it is built where nothing else of Palpate is.
// `world` and `forces` are the numbers that `palpate simulate` and recordings call hash.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "palpate/base/environment.h"
#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"
#include "palpate/servo/scripted_rig.h"
#include "palpate/servo/tick.h"

namespace {

using namespace palpate;

/// All that the core asks of a host here: the files that scenes name. Cold work is done by this thread.
std::string readFile(const std::filesystem::path& file, std::uint64_t) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error::inFile(file.string(), "cannot be opened for reading");
  return {std::istreambuf_iterator<char>(stream), {}};
}

struct Bits {
  std::uint64_t world, forces, skin;
};

std::uint64_t hashOf(const scene::World& world) {
  Hash hash;
  for (const Vec3& position : world.body->skin.positions) hash.add(position);
  for (const auto& triangle : world.body->skin.triangles) {
    for (const Index vertex : triangle) hash.add(std::uint64_t{vertex});
  }
  for (const double stiffness : world.surface.stiffness_n_per_mm) hash.add(stiffness);
  return hash.value();
}

/// Places, normals and strain of the skin as it is drawn.
std::uint64_t hashOf(const deform::DeformedSurface& skin) {
  Hash hash;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float x : skin.position(axis)) hash.add(double{x});
    for (const float x : skin.normal(axis)) hash.add(double{x});
  }
  for (const float x : skin.strain()) hash.add(double{x});
  return hash.value();
}

double depthOf(const std::vector<trace::Sample>& samples) {
  double depth = 0.0;
  for (const trace::Sample& sample : samples) depth += sample.contact.depth_mm;
  return depth;
}

/// Along the scene's paths to their end, or again and again for so many ticks.
Bits bitsOf(const scene::World& world, std::uint64_t ticks) {
  const device::FingerPaths paths = device::pathsOf(world);
  servo::Rig rig = servo::scriptedRig(world, paths);
  std::vector<trace::Sample> samples(rig.fingers.size());
  std::vector<trace::Sample> deepest = samples;
  Hash forces;
  if (ticks == 0) ticks = paths.ticks;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    servo::runTick(rig, tick % paths.ticks, servo::LoopEvent::none, samples);
    for (const trace::Sample& sample : samples) forces.add(sample.contact.force);
    if (depthOf(samples) > depthOf(deepest)) deepest = samples;
  }
  engine::LivingSkin skin(world);
  skin.follow(deepest);
  return {hashOf(world), forces.value(), hashOf(skin.surface())};
}

void print(const std::string& scene_file, std::uint64_t ticks) {
  const std::filesystem::path file = std::filesystem::u8path(scene_file);
  const auto world = scene::build(scene::load(file));
  const Bits bits = bitsOf(*world, ticks);
  std::printf("{\"scene\": \"%s\", \"world\": \"%016llx\", \"forces\": \"%016llx\", \"skin\": \"%016llx\"}\n",
              file.stem().string().c_str(), static_cast<unsigned long long>(bits.world),
              static_cast<unsigned long long>(bits.forces), static_cast<unsigned long long>(bits.skin));
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) try {
  palpate::Environment host = palpate::environment();
  host.read_file = readFile;
  palpate::useEnvironment(host);
  std::uint64_t ticks = 0;
  int first = 1;
  if (count > 2 && std::string(words[1]) == "--ticks") {
    ticks = std::strtoull(words[2], nullptr, 10);
    first = 3;
  }
  if (first >= count) {
    std::fputs("usage: palpate_bits [--ticks N] SCENE.toml...\n", stderr);
    return 2;
  }
  for (int i = first; i < count; ++i) print(words[i], ticks);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "palpate_bits: %s\n", error.what());
  return 1;
}
