// Each format in one pass over vertices and triangles, into a file that appears when it is complete
// (base/output_file.h).
//
// Based on: the formats as everyone writes them; Turk, "The PLY polygon file format" (1994).
#include "palpate/mesh/files/save.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"

namespace palpate::mesh {

static_assert(std::endian::native == std::endian::little, "binary files are written in the machine's byte order");

namespace {

/// Collects bytes so that the file is written in large pieces.
class Buffer {
 public:
  explicit Buffer(OutputFile& file) : file_(file) { bytes_.reserve(kFlushBytes + kMargin); }

  void add(std::string_view text) {
    bytes_ += text;
    if (bytes_.size() >= kFlushBytes) flush();
  }
  /// The number's own bytes.
  template <class T>
  void addBinary(const T& value) {
    add({reinterpret_cast<const char*>(&value), sizeof(T)});
  }
  /// The shortest decimal that reads back as the same double.
  void addText(double value) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    add({digits.data(), static_cast<std::size_t>(end - digits.data())});
  }
  void flush() {
    file_.write(bytes_);
    bytes_.clear();
  }

 private:
  static constexpr std::size_t kFlushBytes = std::size_t{1} << 20;
  static constexpr std::size_t kMargin = 4096;
  OutputFile& file_;
  std::string bytes_;
};

void writeObj(const TriangleMesh& mesh, Buffer& out) {
  out.add("# Palpate, millimetres\n");
  for (const Vec3& p : mesh.positions) {
    out.add("v");
    for (double coordinate : p) {
      out.add(" ");
      out.addText(coordinate);
    }
    out.add("\n");
  }
  for (const auto& [a, b, c] : mesh.triangles) out.add(fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1));
}

/// The floats of an STL are 0.06 mm apart a kilometre away; a scan in map coordinates would become blocks.
void requirePlacesForFloats(const TriangleMesh& mesh, const std::filesystem::path& file) {
  constexpr double kFarthestMm = 1e6;
  for (const Vec3& position : mesh.positions) {
    if (!position.allFinite() || position.cwiseAbs().maxCoeff() <= kFarthestMm) continue;
    throw Error::inFile(file.string(),
                        "vertices are too far from the origin for the precision of STL; write .ply or .obj");
  }
}

void writeStl(const TriangleMesh& mesh, Buffer& out) {
  std::string header = "Palpate, millimetres";  // must not start with "solid": that is the text format
  header.resize(80, ' ');
  out.add(header);
  out.addBinary(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 area = areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]);
    for (const Vec3& v : {Vec3(area.stableNormalized()), mesh.positions[a], mesh.positions[b], mesh.positions[c]}) {
      for (double coordinate : v) out.addBinary(static_cast<float>(coordinate));
    }
    out.addBinary(std::uint16_t{0});
  }
}

void writePlyHeader(const TriangleMesh& mesh, const VertexChannels& channels, Buffer& out) {
  out.add("ply\nformat binary_little_endian 1.0\ncomment Palpate, millimetres\n");
  out.add(fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                      mesh.positions.size()));
  for (const VertexScalar& scalar : channels.scalars) out.add(fmt::format("property float {}\n", scalar.name));
  if (!channels.colours.empty()) out.add("property uchar red\nproperty uchar green\nproperty uchar blue\n");
  out.add(fmt::format("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.triangles.size()));
}

void writePly(const TriangleMesh& mesh, const VertexChannels& channels, Buffer& out) {
  writePlyHeader(mesh, channels, out);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (double coordinate : mesh.positions[v]) out.addBinary(coordinate);
    for (const VertexScalar& scalar : channels.scalars) out.addBinary(scalar.values[v]);
    if (!channels.colours.empty()) out.addBinary(channels.colours[v]);
  }
  for (const Triangle& triangle : mesh.triangles) {
    out.addBinary(std::uint8_t{3});
    out.addBinary(triangle);
  }
}

void checkName(const std::string& name, const std::string& file) {
  const bool one_word = !name.empty() && name.find_first_of(" \t\r\n") == std::string::npos;
  if (!one_word)
    throw Error::inFile(file, fmt::format("'{}' is not a valid name for a vertex value; expected one word", name));
}

void checkChannels(const VertexChannels& channels, std::size_t vertices, const std::string& file) {
  const auto check_size = [&](std::string_view what, std::size_t size) {
    if (size == vertices) return;
    throw Error::inFile(file,
                        fmt::format("{} has {} values for {} vertices; expected one per vertex", what, size, vertices));
  };
  for (const VertexScalar& scalar : channels.scalars) {
    checkName(scalar.name, file);
    check_size(scalar.name, scalar.values.size());
  }
  if (!channels.colours.empty()) check_size("colour", channels.colours.size());
}

bool hasChannels(const VertexChannels& channels) { return !channels.scalars.empty() || !channels.colours.empty(); }

}  // namespace

void save(const std::filesystem::path& file, const TriangleMesh& mesh, const VertexChannels& channels) {
  const std::string extension = file.extension().string();
  if (extension != ".obj" && extension != ".stl" && extension != ".ply") {
    throw Error::inFile(file.string(), "not a supported mesh format; expected .obj, .stl or .ply");
  }
  if (extension == ".stl") requirePlacesForFloats(mesh, file);
  if (extension != ".ply" && hasChannels(channels)) {
    throw Error::inFile(file.string(), "vertex values require a .ply file");
  }
  checkChannels(channels, mesh.positions.size(), file.string());
  OutputFile output(file);
  Buffer buffer(output);
  if (extension == ".obj") writeObj(mesh, buffer);
  if (extension == ".stl") writeStl(mesh, buffer);
  if (extension == ".ply") writePly(mesh, channels, buffer);
  buffer.flush();
  output.commit();
}

}  // namespace palpate::mesh
