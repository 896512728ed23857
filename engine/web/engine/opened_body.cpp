#include "engine/opened_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/body_parts.h"

namespace palpate::web {

namespace {

/// More triangles than a page can hold with its maps and trees in 2 GB.
constexpr std::size_t kMaxTriangles = 2'000'000;

mesh::Format detectFormat(std::string_view name) {
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
  throw Error::inFile(name, "is not a mesh that this page reads; expected STL, OBJ, PLY, OFF, glTF or GLB");
}

/// A TOML string of one line, without the characters that it may not have.
std::string quoteToml(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) out += c;
  }
  return out + '"';
}

}  // namespace

std::shared_ptr<const scene::World> openReady(scene::ReadyBody ready) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::trunk;
  scene.body.triangles = ready.triangles;
  return scene::buildOn(scene, std::move(ready.parts));
}

std::shared_ptr<const scene::World> openMesh(std::string_view bytes, std::string_view name, double unit_mm) {
  mesh::LoadOptions options;
  options.unit_mm = unit_mm;
  options.keep_wrong_indices = true;  // mending leaves such triangles out
  auto [mesh, channels, notes] = mesh::loadWithChannelsFromMemory(bytes, detectFormat(name), name, options);
  if (mesh.triangles.size() > kMaxTriangles) {
    throw Error::inFile(name, fmt::format("has {} triangles; a page can hold at most {}",
                                          mesh.triangles.size(), kMaxTriangles));
  }
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::mesh;
  scene.body.file = std::string(name);  // for sceneText; never opened
  scene.body.scale = unit_mm;
  try {
    std::vector<Index> source_vertex;
    scene::BodyParts parts = scene::mendedBody(std::move(mesh), std::string(name), {}, source_vertex);
    parts.notes.insert(parts.notes.begin(), notes.begin(), notes.end());
    return scene::buildOn(scene, std::move(parts));
  } catch (const Error& error) {
    throw Error::inFile(name, error.what());
  }
}

std::string sceneText(const scene::Scene& scene) {
  const scene::BodySettings& body = scene.body;
  std::string text = "title = \"felt in a browser\"\n\n[body]\n";
  if (body.kind == scene::BodyKind::trunk) {
    text += fmt::format("kind = \"trunk\"\ntriangles = {}\n", body.triangles);
  } else {
    text += fmt::format("kind = \"mesh\"\nfile = {}\n", quoteToml(body.file.string()));
    // A file's own unit is the command's default too; any other is a scale of millimetres.
    if (body.scale > 0.0) text += fmt::format("unit = \"mm\"\nscale = {}\n", body.scale);
  }
  for (const maps::Dysfunction& d : scene.dysfunctions) {
    text += fmt::format("\n[[dysfunction]]\nx_mm = {}\ny_mm = {}\nradius_mm = {}\nchange_percent = {}\n", d.x_mm,
                        d.y_mm, d.radius_mm, d.change_percent);
  }
  for (const scene::LumpSettings& lump : scene.lumps) {
    text += fmt::format(
        "\n[[lump]]\nname = {}\nat = {}\ndepth_mm = {}\ndiameter_mm = {}\nstiffness_ratio = {}\n"
        "mobility_mm_per_n = {}\n",
        quoteToml(lump.name), quoteToml(lump.at), lump.depth_mm, lump.diameter_mm, lump.stiffness_ratio,
        lump.mobility_mm_per_n);
  }
  return text;
}

}  // namespace palpate::web
