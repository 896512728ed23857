// The functions that the page's worker calls: a body is opened, touched, shown and exported. Plain C names over
// LiveBody.
//
// The functions are those of engine/web/page/engine.js, which has their documentation.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "engine/exports.h"
#include "engine/live_body.h"
#include "palpate/base/colour_map.h"
#include "palpate/base/error.h"
#include "palpate/body/places.h"
#include "palpate/contact/pressure_field.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/ready_body.h"
#include "palpate/scene/world.h"

namespace palpate::web {

namespace {

// Bodies for the page: the trunk that was made ahead (palpate/scene/ready_body.h), or from the bytes of a user's mesh
// file. Settings are the scene file's defaults; its reader and writer stay out of the page, of which they would be a
// third.
//
// A user's file goes through the reader for bytes in memory and through mending, as any scene's does; its length and
// size are bounded here, because a page cannot be made to wait.

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

/// The trunk that was made ahead.
std::shared_ptr<const scene::World> openReady(scene::ReadyBody ready) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::trunk;
  scene.body.triangles = ready.triangles;
  return scene::buildOn(scene, std::move(ready.parts));
}

/// A mesh in the format of the name's extension (stl, obj, ply, off, gltf, glb). `unit_mm`: millimetres of its unit, 0:
/// the format's. Throws Error in one line for any fault of it.
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

/// The scene file for the opened body, so that it can be viewed again elsewhere: body, dysfunctions and lumps. For a
/// mesh, name and unit as given to openMesh.
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

// A body described for the page: its name, its repairs, and the names of its places.
//
// Written by hand: a page of JSON does not warrant a library.

/// Names may come from a user's file. Bytes that are not UTF-8 are left to the reader of the text.
std::string jsonText(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      out += fmt::format("\\u{:04x}", byte);
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string numbers(const Vec3& v) { return fmt::format("[{},{},{}]", v.x(), v.y(), v.z()); }

/// JSON: [{name, at: [x, y, z], normal: [x, y, z]}], in an examiner's terms.
std::string landmarksJson(const std::vector<body::SkinLandmark>& landmarks) {
  std::string words;
  for (const body::SkinLandmark& landmark : landmarks) {
    words +=
        fmt::format("{}{{\"name\":{},\"at\":{},\"normal\":{}}}", words.empty() ? "" : ",",
                    jsonText(body::spokenName(landmark.name)), numbers(landmark.position), numbers(landmark.normal));
  }
  return '[' + words + ']';
}

/// JSON: name, closed, bones (their number), notes, landmarks.
std::string bodyJson(const scene::World& world) {
  std::string notes;
  for (const std::string& note : world.notes) notes += (notes.empty() ? "" : ",") + jsonText(note);
  return fmt::format(R"({{"name":{},"closed":{},"bones":{},"notes":[{}],"landmarks":{}}})", jsonText(world.body->name),
                     world.body->closed, world.body->anatomy.bones.size(), notes,
                     landmarksJson(world.body->anatomy.landmarks));
}

std::unique_ptr<LiveBody> body;
scene::ReadyBody ready;  // read, not yet opened
std::vector<float> ready_rest;
FramePacker frame;
std::vector<float> bone_positions;
std::vector<std::uint32_t> bone_triangles;

/// All bones as one mesh: they are drawn together.
void gatherBones(const std::vector<body::Bone>& bones) {
  bone_positions.clear();
  bone_triangles.clear();
  for (const body::Bone& bone : bones) {
    const auto first = static_cast<std::uint32_t>(bone_positions.size() / 3);
    for (const Vec3& p : bone.mesh.positions) {
      for (const double axis : p) bone_positions.push_back(static_cast<float>(axis));
    }
    for (const Triangle& t : bone.mesh.triangles) {
      for (const Index corner : t) bone_triangles.push_back(first + corner);
    }
  }
}

/// In the layout of a frame (frame_packer.h), so that it can be shown while it is built.
std::vector<float> packRestFrame(const mesh::TriangleMesh& skin) {
  std::vector<float> rest;
  rest.reserve(kFloatsOfVertex * skin.positions.size());
  const std::vector<Vec3> normals = mesh::vertexNormals(skin);
  for (std::size_t v = 0; v < normals.size(); ++v) {
    for (const double axis : skin.positions[v]) rest.push_back(static_cast<float>(axis));
    for (const double axis : normals[v]) rest.push_back(static_cast<float>(axis));
    rest.push_back(0.0f);
  }
  return rest;
}

void adoptWorld(std::shared_ptr<const scene::World> world) {
  body.reset();  // there may not be room for both
  body = std::make_unique<LiveBody>(std::move(world));
  gatherBones(body->world().body->anatomy.bones);
}

}  // namespace

const char* keptText(std::string text) {
  static std::string kept;
  kept = std::move(text);
  return kept.c_str();
}

// ---- memory and bodies

PALPATE_EXPORT void* palpate_take(std::size_t bytes) { return std::malloc(bytes); }
PALPATE_EXPORT void palpate_give(void* memory) { std::free(memory); }

/// Reads the trunk's file; palpate_open_ready makes it the body. Between them it can be looked at.
PALPATE_EXPORT const char* palpate_read_ready(const char* bytes, std::size_t length) {
  return catchError([&] {
    ready = scene::decodeBody({bytes, length}, "trunk");
    ready_rest = packRestFrame(ready.parts.skin);
  });
}
PALPATE_EXPORT std::size_t palpate_ready_vertices() { return ready.parts.skin.positions.size(); }
PALPATE_EXPORT const float* palpate_ready_rest() { return ready_rest.data(); }
PALPATE_EXPORT std::size_t palpate_ready_triangles() { return ready.parts.skin.triangles.size(); }
PALPATE_EXPORT const Index* palpate_ready_corners() { return ready.parts.skin.triangles.data()->data(); }
PALPATE_EXPORT const char* palpate_ready_landmarks() { return keptText(landmarksJson(ready.parts.anatomy.landmarks)); }
PALPATE_EXPORT const char* palpate_open_ready() {
  return catchError([] {
    ready_rest = {};
    adoptWorld(openReady(std::exchange(ready, {})));
  });
}

PALPATE_EXPORT const char* palpate_open_mesh(const char* bytes, std::size_t length, const char* name,
                                             std::size_t name_length, double unit_mm) {
  return catchError([&] { adoptWorld(openMesh({bytes, length}, {name, name_length}, unit_mm)); });
}

/// `numbers`: x, y, radius and change in per cent of each dysfunction.
PALPATE_EXPORT const char* palpate_set_dysfunctions(const double* numbers, std::size_t count) {
  return catchError([&] {
    std::vector<maps::Dysfunction> dysfunctions(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double* n = numbers + 4 * i;
      dysfunctions[i] = {.x_mm = n[0], .y_mm = n[1], .radius_mm = n[2], .change_percent = n[3]};
    }
    body->setDysfunctions(std::move(dysfunctions));
  });
}

/// Not 0: the preset's three, which only the trunk has room for; 0: none.
PALPATE_EXPORT const char* palpate_set_lumps(int on) {
  return catchError([&] { body->setLumps(on != 0 ? presetLumps() : std::vector<scene::LumpSettings>()); });
}

// ---- what the body looks like

PALPATE_EXPORT const char* palpate_about() { return keptText(bodyJson(body->world())); }
PALPATE_EXPORT std::size_t palpate_vertices() { return body->world().deformable->vertices; }
PALPATE_EXPORT std::size_t palpate_triangles() { return body->world().deformable->triangles.size(); }
PALPATE_EXPORT const Index* palpate_triangle_corners() { return body->world().deformable->triangles.data()->data(); }
PALPATE_EXPORT const double* palpate_stiffness() { return body->world().surface.stiffness_n_per_mm->data(); }
PALPATE_EXPORT std::size_t palpate_bone_vertices() { return bone_positions.size() / 3; }
PALPATE_EXPORT const float* palpate_bone_positions() { return bone_positions.data(); }
PALPATE_EXPORT std::size_t palpate_bone_corners() { return bone_triangles.size(); }
PALPATE_EXPORT const std::uint32_t* palpate_bone_triangles() { return bone_triangles.data(); }

/// 256 colours, four bytes each; `map` as ColourMap.
PALPATE_EXPORT const std::uint8_t* palpate_colours(unsigned map) {
  static std::array<std::uint8_t, 1024> bytes;
  for (std::size_t i = 0; i < 256; ++i) {
    const ColourBytes colour = bytesOf(colourOf(static_cast<ColourMap>(map), static_cast<double>(i) / 255.0));
    std::copy(colour.begin(), colour.end(), bytes.begin() + static_cast<std::ptrdiff_t>(4 * i));
    bytes[4 * i + 3] = 255;
  }
  return bytes.data();
}

// ---- touching

/// `numbers`: place, normal, depth in mm. Not pressed: it hovers. `present` 0: it is nowhere.
PALPATE_EXPORT void palpate_aim(std::size_t finger, int present, int pressed, const double* numbers) {
  device::FingerTarget target;
  target.present = present != 0;
  target.pressed = pressed != 0;
  target.place = Vec3(numbers[0], numbers[1], numbers[2]);
  target.normal = Vec3(numbers[3], numbers[4], numbers[5]);
  target.depth_mm = numbers[6];
  body->aim(finger, target);
}

PALPATE_EXPORT void palpate_run(std::size_t ticks) { body->run(ticks); }

/// The finger's last tick: tip, proxy, normal, force (three each), depth, touch (0 free, 1 stick, 2 slip), status.
PALPATE_EXPORT const double* palpate_felt(std::size_t finger) {
  static std::array<double, 15> numbers;
  const contact::FingerOutput& felt = body->felt(finger);
  double* out = numbers.data();
  for (const Vec3* v : {&felt.tip, &felt.proxy, &felt.normal, &felt.force}) out = std::copy(v->begin(), v->end(), out);
  *out++ = felt.depth_mm;
  *out++ = static_cast<double>(felt.touch);
  *out = static_cast<double>(felt.status);
  return numbers.data();
}

/// kPa of the finger's last tick, `taxels` rows of as many, the first nearest to the head; null where the body has no
/// lumps, and so no pads.
PALPATE_EXPORT const double* palpate_pad(std::size_t finger, std::size_t taxels) {
  static std::array<double, contact::kMaxTaxels * contact::kMaxTaxels> kpa;
  if (taxels < contact::kMinTaxels || taxels > contact::kMaxTaxels) return nullptr;
  return body->pad(finger, std::span(kpa).first(taxels * taxels)) ? kpa.data() : nullptr;
}

// ---- pictures and files

/// Packs the changes since the last call (or all); returns the number of ranges.
PALPATE_EXPORT std::size_t palpate_frame(int all) {
  body->packFrame(frame, all != 0);
  return frame.ranges().size() / 2;
}
PALPATE_EXPORT const std::uint32_t* palpate_frame_ranges() { return frame.ranges().data(); }
PALPATE_EXPORT const float* palpate_frame_values() { return frame.values().data(); }
PALPATE_EXPORT std::size_t palpate_frame_floats() { return frame.values().size(); }

PALPATE_EXPORT std::size_t palpate_recorded() { return body->recording().size(); }
PALPATE_EXPORT void palpate_record_anew() { body->restartRecording(); }
PALPATE_EXPORT const char* palpate_forces_csv() { return keptText(body->recording().asForcesCsv()); }
PALPATE_EXPORT const char* palpate_scene_toml() { return keptText(sceneText(body->world().scene)); }

}  // namespace palpate::web
