// The bytes of a file, distinguished by their first ones or the file's name, go to the reader of their format; then
// vertices are welded where the format repeats them, and units become millimetres.
#include "palpate/mesh/files/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/readers.h"
#include "palpate/mesh/weld.h"

namespace palpate::mesh {

namespace {

constexpr double kMillimetresPerMetre = 1000.0;

/// With its dot, in lower case; "." when there is none.
std::string lowerCaseExtension(const std::filesystem::path& file) {
  const std::string ending = inSmallLetters(file.extension().string());
  return ending.empty() ? "." : ending;
}

std::optional<Format> formatByContent(std::string_view bytes) {
  if (bytes.starts_with("glTF")) return Format::glb;
  if (beginsAsPly(bytes)) return Format::ply;
  if (beginsAsOff(bytes)) return Format::off;
  return std::nullopt;
}

std::optional<Format> formatByExtension(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 6> kExtensions = {".obj", ".stl", ".ply", ".off", ".gltf", ".glb"};
  const auto* const found = std::ranges::find(kExtensions, lowerCaseExtension(file));
  if (found == kExtensions.end()) return std::nullopt;
  return static_cast<Format>(found - kExtensions.begin());  // in the order of Format
}

TriangleMesh read(const MeshFile& file, Format format, VertexChannels* channels) {
  switch (format) {
    case Format::obj:
      return readObj(file);
    case Format::stl:
      return readStl(file);
    case Format::ply:
      return readPly(file, channels);
    case Format::off:
      return readOff(file);
    case Format::gltf:
    case Format::glb:
      return readGltf(file);
    case Format::foreign:
      return readForeign(file, lowerCaseExtension(pathOf(file.name)).substr(1));
  }
  return {};
}

/// The default until a host installs a reader (read_foreign.cpp).
TriangleMesh refuseForeign(const MeshFile& file, const std::string&) {
  throw Error::inFile(file.name, "this format requires assimp, and palpate was built without it");
}

ForeignReader& foreignReader() {
  static ForeignReader reader = refuseForeign;
  return reader;
}

bool isGltf(Format format) { return format == Format::gltf || format == Format::glb; }

void follow(VertexChannels* channels, const std::vector<Index>& source_vertex) {
  if (channels != nullptr) *channels = followed(*channels, source_vertex);
}

TriangleMesh loadChecked(const MeshFile& file, Format format, VertexChannels* channels) {
  if (file.bytes.empty()) throw Error::inFile(file.name, "the file is empty");
  TriangleMesh mesh = read(file, format, channels);
  if (mesh.triangles.empty()) {
    const std::string left_out = file.passed_over.leftOut();
    throw Error::inFile(file.name, "the file has no triangles" + (left_out.empty() ? "" : "; " + left_out));
  }
  // STL welds while it reads.
  const bool repeats_vertices = isGltf(format) || format == Format::foreign;
  if (format != Format::stl && file.options.weld.value_or(repeats_vertices)) {
    follow(channels, mergeVertices(mesh, equalVertices(mesh.positions)));
  }
  if (!file.options.group.empty()) follow(channels, removeUnusedVertices(mesh));
  toMillimetres(mesh, format, file.options.unit_mm);
  report(file.progress, "reading", 1.0);
  return mesh;
}

MeshWithChannels loadWithNotes(const MeshFile& file, Format format) {
  MeshWithChannels loaded;
  loaded.mesh = loadChecked(file, format, &loaded.channels);
  loaded.notes = file.passed_over.sentences(file.name);
  return loaded;
}

}  // namespace

TriangleMesh readForeign(const MeshFile& file, const std::string& extension) {
  return foreignReader()(file, extension);
}

void useForeignReader(ForeignReader reader) { foreignReader() = reader; }

bool isMeshFile(const std::filesystem::path& file) { return formatByExtension(file).has_value(); }

Format detectFormat(const std::filesystem::path& file, std::string_view bytes, bool allow_foreign) {
  if (const auto format = formatByContent(bytes)) return *format;
  if (const auto format = formatByExtension(file)) return *format;
  if (allow_foreign) return Format::foreign;
  throw Error::inFile(file.string(), "not a supported mesh file; supported are obj, stl, ply, off, gltf and glb");
}

void toMillimetres(TriangleMesh& mesh, Format format, double unit_mm) {
  if (unit_mm == 0.0) unit_mm = isGltf(format) ? kMillimetresPerMetre : 1.0;
  if (unit_mm == 1.0) return;
  for (Vec3& position : mesh.positions) position *= unit_mm;
}

void checkTriangleCount(std::size_t triangles, std::string_view name) {
  constexpr std::size_t kMax = std::numeric_limits<Index>::max() / 3;
  if (triangles >= kMax) throw Error::inFile(name, fmt::format("too many triangles; expected at most {}", kMax));
}

TriangleMesh load(const std::filesystem::path& file, const LoadOptions& options, const Progress& progress) {
  report(progress, "reading", 0.0);
  return withMeshFile(file, options, progress,
                      [](const MeshFile& mesh_file, Format format) { return loadChecked(mesh_file, format, nullptr); });
}

TriangleMesh loadFromMemory(std::string_view bytes, Format format, std::string_view name, const LoadOptions& options,
                            const Progress& progress) {
  PassedOver passed_over;
  return loadChecked({bytes, name, options, progress, {}, passed_over}, format, nullptr);
}

MeshWithChannels loadWithChannels(const std::filesystem::path& file, const LoadOptions& options,
                                  const Progress& progress) {
  report(progress, "reading", 0.0);
  return withMeshFile(file, options, progress, loadWithNotes);
}

MeshWithChannels loadWithChannelsFromMemory(std::string_view bytes, Format format, std::string_view name,
                                            const LoadOptions& options, const Progress& progress) {
  PassedOver passed_over;
  return loadWithNotes({bytes, name, options, progress, {}, passed_over}, format);
}

}  // namespace palpate::mesh
