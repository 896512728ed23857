// Numbers are written with all their digits: a fault on a sliver is gone when a tip is rounded to a nanometre.
// Data flow: hunt.h, minimise.cpp -> here -> a folder -> instruments/study/lab/tests/contact_bars,
// `palpate study hunt --replay`.
#include "lab/hunt/kept_case.h"

#include <fmt/format.h>

#include <cctype>

#include "lab/hunt/hunt_world.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/number_range.h"
#include "palpate/base/text.h"
#include "palpate/device/trajectory.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/files/save.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/scene_file.h"

namespace palpate::lab {
namespace {

constexpr std::uint64_t kMaxNoteBytes = 1 << 20;
constexpr double kTickS = 0.001;

std::string pathText(const KeptCase& kept) {
  std::string text(device::kTrajectoryHeader);
  for (std::size_t k = 0; k < kept.tips.size(); ++k) {
    const Vec3& p = kept.tips[k];
    text += fmt::format("\n{:.3f},{},{},{}", static_cast<double>(k) * kTickS, p.x(), p.y(), p.z());
  }
  return text + "\n";
}

std::string sceneText(const KeptCase& kept) {
  const contact::FingerSettings finger = huntedFinger(kept.radius_mm, kept.scale);
  return fmt::format(
      "title = \"{}\"\n[body]\nkind = \"mesh\"\nfile = \"body.ply\"\nunit = \"mm\"\n[stiffness]\nsource = "
      "\"constant\"\nconstant_n_per_mm = {}\n[contact]\nmax_depth_mm = {}\ncatch_up_mm_per_s = {}\n[[finger]]\nname = "
      "\"hunted\"\nradius_mm = {}\ntrajectory = \"path.csv\"\n",
      nameOf(kept.fault), kHuntedStiffness, finger.max_depth_mm, finger.catch_up_mm_per_s, finger.radius_mm);
}

std::string noteText(const KeptCase& kept) {
  const Finding& f = kept.finding;
  const std::string lumps = kept.lumps > 0 ? fmt::format("lumps: {}\n", kept.lumps) : "";
  return lumps +
         fmt::format(
             "body: {}\nseed: {}\nradius_mm: {}\nscale: {}\nfault: {}\ntick: {}\nmeasured: {}\nbound: {}\nseen: {}\n",
             kept.body, kept.seed, kept.radius_mm, kept.scale, nameOf(kept.fault), f.first_tick, f.measured, f.bound,
             f.what);
}

/// "key: value" lines of a note.
class Note {
 public:
  explicit Note(const std::filesystem::path& file) : file_(file.string()), text_(readFile(file, kMaxNoteBytes)) {}

  std::string word(std::string_view key) const { return findLine(key).word; }
  /// In a range; without one it may also be infinite or nan, as measurements may be.
  double number(std::string_view key, const NumberRange& range = {}) const {
    const Line line = findLine(key);
    const std::optional<double> value = parseNumber(line.word);
    if (!value) throw Error::atLine(file_, line.number, fmt::format("'{}' is not a number", key));
    if (range.words().empty() || range.holds(*value)) return *value;
    throw Error::atLine(file_, line.number, fmt::format("{} = {}", key, outOfRange(oneLine(line.word), range)));
  }
  bool has(std::string_view key) const {
    return text_.starts_with(key) || text_.find(fmt::format("\n{}:", key)) != std::string::npos;
  }
  Fault fault() const {
    const std::optional<Fault> fault = faultNamed(word("fault"));
    if (!fault) throw Error::inFile(file_, fmt::format("'{}' is not a known fault", word("fault")));
    return *fault;
  }

 private:
  struct Line {
    std::size_t number = 0;
    std::string word;
  };
  Line findLine(std::string_view key) const {
    std::size_t number = 0;
    for (const std::string_view line : split(text_, '\n')) {
      ++number;
      if (line.starts_with(key) && line.substr(key.size()).starts_with(":"))
        return {number, std::string(trimmed(line.substr(key.size() + 1)))};
    }
    throw Error::inFile(file_, fmt::format("has no line '{}: ...'", key));
  }

  std::string file_, text_;
};

constexpr NumberRange kSeeds{0.0, 1e19};
constexpr NumberRange kTicks{0.0, 1e12};
constexpr NumberRange kRadiiMm{0.0, 1e9};
constexpr NumberRange kScales{1e-9, 1e9};
constexpr NumberRange kLumpCounts{0.0, 64.0};

void readMesh(KeptCase& kept, const std::filesystem::path& file, const mesh::LoadOptions& options) {
  mesh::MeshWithChannels read = mesh::loadWithChannels(file, options);
  kept.mesh = std::move(read.mesh);
  kept.notes = std::move(read.notes);
}

KeptCase caseOfScene(const std::filesystem::path& file) {
  const scene::Scene scene = scene::load(file);
  if (scene.body.kind != scene::BodyKind::mesh || scene.fingers.empty() || scene.fingers[0].trajectory.empty())
    throw Error::inFile(file.string(), "expected a scene of a mesh and a finger with a trajectory");
  KeptCase kept;
  kept.body = scene.body.file.filename().string();
  kept.radius_mm = scene.fingers[0].radius_mm;
  kept.tips = device::readTrajectory(scene.fingers[0].trajectory).tip_mm;
  readMesh(kept, scene.body.file, scene::loadOptionsOf(scene.body));
  for (Vec3& p : kept.mesh.positions) p *= scene.body.scale;
  return kept;
}

}  // namespace

std::string caseFolderName(const KeptCase& kept) {
  std::string name = fmt::format("{}_{}_r{}_s{}", nameOf(kept.fault), kept.body, kept.radius_mm, kept.seed);
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '_';
  }
  return name;
}

void writeCase(const std::filesystem::path& folder, const KeptCase& kept) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error::inFile(folder.string(), "the folder cannot be created: " + error.message());
  mesh::save(folder / "body.ply", kept.mesh);
  writeFile(folder / "path.csv", pathText(kept));
  writeFile(folder / "scene.toml", sceneText(kept));
  writeFile(folder / "note.txt", noteText(kept));
}

KeptCase readCase(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder / "note.txt") && std::filesystem::exists(folder / "scene.toml"))
    return caseOfScene(folder / "scene.toml");
  const Note note(folder / "note.txt");
  KeptCase kept;
  kept.body = note.word("body");
  kept.seed = static_cast<std::uint64_t>(note.number("seed", kSeeds));
  kept.radius_mm = note.number("radius_mm", kRadiiMm);
  kept.scale = note.number("scale", kScales);
  if (note.has("lumps")) kept.lumps = static_cast<std::size_t>(note.number("lumps", kLumpCounts));
  kept.fault = note.fault();
  kept.finding.first_tick = static_cast<std::size_t>(note.number("tick", kTicks));
  kept.finding.measured = note.number("measured");
  kept.finding.bound = note.number("bound");
  kept.tips = device::readTrajectory(folder / "path.csv").tip_mm;
  mesh::LoadOptions options;
  options.keep_wrong_indices = true;
  readMesh(kept, folder / "body.ply", options);
  return kept;
}

HuntReport replay(const KeptCase& kept) {
  HuntWorld world = buildHuntWorld(kept.mesh);
  if (kept.lumps > 0) putLumps(world, kept.body, kept.lumps);
  return huntAlong(world, huntedFinger(kept.radius_mm, kept.scale), kept.tips);
}

}  // namespace palpate::lab
