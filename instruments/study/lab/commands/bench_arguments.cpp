#include "lab/commands/bench_arguments.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "cli/kit/number_option.h"
#include "cli/kit/progress_line.h"
#include "lab/workloads/heldout_meshes.h"
#include "lab/workloads/workload_meshes.h"
#include "lab/workloads/workload_paths.h"
#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/body/torso.h"
#include "palpate/mesh/files/save.h"

namespace palpate::app {

namespace {

constexpr std::string_view kTorso = "torso";
constexpr double kMaxTorsoTriangles = 2e7;

/// Skin and bones in one surface.
mesh::TriangleMesh torsoMesh(std::size_t triangles) {
  const body::Torso torso = body::makeTorso({.triangles = triangles});
  mesh::TriangleMesh all = torso.skin.mesh;
  for (const body::Bone& bone : torso.bones) append(bone.mesh, all);
  return all;
}

/// The count in torso or torso_N; nothing for another name.
std::optional<std::size_t> torsoTriangles(std::string_view name) {
  if (name == kTorso) return body::TorsoSettings{}.triangles;
  if (!name.starts_with("torso_")) return std::nullopt;
  const auto count = parseNumber(name.substr(kTorso.size() + 1));
  if (!count || !(*count >= 1.0 && *count <= kMaxTorsoTriangles) || *count != static_cast<std::size_t>(*count)) {
    throw Error(std::string(name) + ": expected torso_N with a whole number of triangles");
  }
  return static_cast<std::size_t>(*count);
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

int writeInChild(const std::string& name, const std::filesystem::path& file) {
  try {
    mesh::save(file, meshFrom(name));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "palpate: {}\n", error.what());
    return 1;
  }
}

}  // namespace

bool isMeshFile(const std::string& name) {
  return std::filesystem::exists(name) || name.find('.') != std::string::npos;
}

mesh::TriangleMesh meshFrom(const std::string& name, const mesh::LoadOptions& options, const Progress& progress) {
  if (isMeshFile(name)) {
    mesh::MeshWithChannels loaded = mesh::loadWithChannels(name, options, progress);
    for (const std::string& note : loaded.notes) say("palpate: " + note + "\n");
    return std::move(loaded.mesh);
  }
  if (const auto triangles = torsoTriangles(name)) {
    report(progress, "body", 0.0);
    return torsoMesh(*triangles);
  }
  if (contains(lab::heldoutMeshNames(), name)) return lab::heldoutMesh(name);
  return lab::workloadMesh(name);
}

device::Trajectory trajectoryFrom(const std::string& name) {
  if (std::filesystem::exists(name) || name.ends_with(".csv")) return device::readTrajectory(name);
  return lab::workloadPath(name);
}

WrittenMesh::WrittenMesh(const std::string& file_or_name) : file_(file_or_name) {
  if (isMeshFile(file_or_name)) return;
  folder_.emplace("palpate-mesh");
  file_ = folder_->path() / (file_or_name + ".stl");
  const pid_t child = fork();
  if (child == 0) _exit(writeInChild(file_or_name, file_));
  int status = 0;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child;
  if (ended && WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  throw Error(file_or_name + ": could not be built and written to a temporary file");
}

void addPartitionSettings(Command& command, hdb::BuildSettings& settings) {
  addChoice(command, "--tree", settings.tree, "Tree: halves by x, y, z in turn (bsp), or eighths (octree)");
  addChoice(command, "--assign", settings.assignment,
            "Assignment of a triangle that a plane crosses: cut (A), kept on both sides (B) or put on the side with "
            "two of its vertices (C)");
  addSetting(command, "--threshold", settings.threshold, between(1, 4e9), "Largest number of triangles in a leaf");
  addChoice<bool>(command, "--leaf-rule", settings.leaf_below_threshold, {{"at-most", false}, {"below", true}},
                  "A leaf holds at most the threshold, or fewer than it as the dissertation's text has it (E7)");
}

}  // namespace palpate::app
