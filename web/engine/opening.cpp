// The torso is made as scene::build makes it, without the bodies that the page has no use for. A stranger's file goes
// through the reader for bytes in memory and through mending, as any scene's does; how long and how large it may be is
// bounded here, because a page cannot be asked to wait.
#include "engine/opening.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/body/torso.h"
#include "palpate/mesh/reorder.h"
#include "palpate/scene/body_parts.h"

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

template <class T>
std::vector<T> inOrder(const std::vector<T>& values, const std::vector<Index>& source) {
  std::vector<T> ordered(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) ordered[i] = values[source[i]];
  return ordered;
}

/// A TOML string of one line. What a name may not hold there is left out.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) out += c;
  }
  return out + '"';
}

}  // namespace

std::shared_ptr<const scene::World> openTorso(std::size_t triangles) {
  body::TorsoSettings settings;
  settings.triangles = triangles;
  body::Torso torso = body::makeTorso(settings);
  scene::BodyParts parts;
  parts.name = fmt::format("built-in torso, {} triangles with bones", triangles);
  parts.skin = std::move(torso.skin.mesh);
  const std::vector<Index> order = mesh::reorderSpatially(parts.skin).source_vertex;
  parts.anatomy = {.bones = std::move(torso.bones),
                   .depth_mm = inOrder(torso.depth_mm, order),
                   .nearest_bone = inOrder(torso.nearest_bone, order),
                   .landmarks = std::move(torso.landmarks),
                   .support = {}};
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::torso;
  scene.body.triangles = triangles;
  return scene::buildOn(scene, std::move(parts));
}

std::shared_ptr<const scene::World> openMesh(std::string_view bytes, std::string_view name, double unit_mm) {
  mesh::LoadOptions options;
  options.unit_mm = unit_mm;
  options.keep_wrong_indices = true;  // mending leaves such triangles out
  mesh::TriangleMesh mesh = mesh::loadFromMemory(bytes, formatOf(name), name, options);
  if (mesh.triangles.size() > kMostTriangles) {
    throw Error::inFile(name, fmt::format("{} triangles are more than the {} that a page can hold",
                                          mesh.triangles.size(), kMostTriangles));
  }
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = std::string(name);  // for sceneText; never opened
  scene.body.scale = unit_mm;
  try {
    std::vector<Index> source_vertex;
    return scene::buildOn(scene, scene::mendedBody(std::move(mesh), std::string(name), {}, source_vertex));
  } catch (const Error& error) {
    throw Error::inFile(name, error.what());
  }
}

std::string sceneText(const scene::Scene& scene) {
  const scene::BodySettings& body = scene.body;
  std::string text = "title = \"felt in a browser\"\n\n[body]\n";
  if (body.kind == scene::BodyKind::torso) {
    text += fmt::format("kind = \"torso\"\ntriangles = {}\n", body.triangles);
  } else {
    text += fmt::format("kind = \"mesh\"\nfile = {}\n", quoted(body.file.string()));
    // A file's own unit is what the command takes too; any other is a scale of millimetres.
    if (body.scale > 0.0) text += fmt::format("unit = \"mm\"\nscale = {}\n", body.scale);
  }
  for (const maps::Dysfunction& d : scene.dysfunctions) {
    text += fmt::format("\n[[dysfunction]]\nx_mm = {}\ny_mm = {}\nradius_mm = {}\nchange_percent = {}\n", d.x_mm,
                        d.y_mm, d.radius_mm, d.change_percent);
  }
  return text;
}

}  // namespace palpate::web
