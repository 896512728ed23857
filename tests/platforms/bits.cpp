// Scene files -> the bits of what they give: a line of JSON each. The same lines are wanted from every compiler,
// processor and system (tools/check-platforms); kept.jsonl has them.
//
//   scene file ─ scene::load, scene::build ─► World ─ bench::bitsOf along the scene's paths ─► three numbers
//
// Stands on the core and on the reader of scene files alone, so that it is built where nothing else of Palpate is.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "lab/runs/scene_bits.h"
#include "palpate/base/environment.h"
#include "palpate/base/error.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/world.h"

namespace {

using namespace palpate;

/// All that the core asks of a host here: the files that scenes name. Cold work is done by this thread, and bodies,
/// which are what is compared, are made here and now.
std::string readFile(const std::filesystem::path& file, std::uint64_t) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error::inFile(file.string(), "cannot be opened for reading");
  return {std::istreambuf_iterator<char>(stream), {}};
}

void print(const std::string& scene_file, std::uint64_t ticks) {
  const std::filesystem::path file = std::filesystem::u8path(scene_file);
  const auto world = scene::build(scene::load(file));
  const bench::SceneBits bits = bench::bitsOf(*world, ticks);
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
