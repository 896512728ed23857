// A stranger's file goes through the reader for bytes in memory and through mending, as any scene's does; how long and
// how large it may be is bounded here, because a page cannot be asked to wait.
#include "engine/opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/scene_file.h"

namespace palpate::web {

namespace {

mesh::Format formatOf(std::string_view name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::pair<std::string_view, mesh::Format>, 6> kFormats = {{{".stl", mesh::Format::stl},
                                                                                  {".obj", mesh::Format::obj},
                                                                                  {".ply", mesh::Format::ply},
                                                                                  {".off", mesh::Format::off},
                                                                                  {".gltf", mesh::Format::gltf},
                                                                                  {".glb", mesh::Format::glb}}};
  for (const auto& [known, format] : kFormats) {
    if (extension == known) return format;
  }
  throw Error::inFile(name, "is no mesh that this page reads: STL, OBJ, PLY, OFF, glTF or GLB");
}

}  // namespace

std::shared_ptr<const scene::World> openScene(std::string_view toml) {
  return scene::build(scene::parse(toml, "scene.toml"));
}

std::shared_ptr<const scene::World> openMesh(std::string_view bytes, std::string_view name, double unit_mm,
                                             std::string_view toml) {
  scene::Scene scene = scene::parse(toml, "scene.toml");
  mesh::LoadOptions options;
  options.unit_mm = unit_mm;
  options.keep_wrong_indices = true;  // mending leaves such triangles out
  mesh::TriangleMesh mesh = mesh::loadFromMemory(bytes, formatOf(name), name, options);
  if (mesh.triangles.size() > kMostTriangles) {
    throw Error::inFile(name, fmt::format("{} triangles are more than the {} that a page can hold", mesh.triangles.size(),
                                          kMostTriangles));
  }
  scene.body = {};
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = std::string(name);  // for the scene that is exported; never opened
  try {
    std::vector<Index> source_vertex;
    return scene::buildOn(scene, scene::mendedBody(std::move(mesh), std::string(name), {}, source_vertex));
  } catch (const Error& error) {
    throw Error::inFile(name, error.what());
  }
}

}  // namespace palpate::web
