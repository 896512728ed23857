#include "support/mesh_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace palpate::support {

using mesh::TriangleMesh;

namespace {

template <class T>
std::string raw(T value, bool big_endian = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string rawFloats(const Vec3& v, bool big_endian = false) {
  std::string bytes;
  for (double c : v) bytes += raw(static_cast<float>(c), big_endian);
  return bytes;
}

std::string words(const Vec3& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string gltfJson(const TriangleMesh& mesh, const std::string& node, const std::string& uri) {
  const std::size_t position_bytes = 12 * mesh.positions.size();
  const std::size_t index_bytes = 6 * mesh.triangles.size();
  return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0{}}}],)"
                     R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],)"
                     R"("accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":"VEC3"}},)"
                     R"({{"bufferView":1,"componentType":5123,"count":{},"type":"SCALAR"}}],)"
                     R"("bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],)"
                     R"("buffers":[{{"byteLength":{}{}}}]}})",
                     node, mesh.positions.size(), 3 * mesh.triangles.size(), position_bytes, position_bytes,
                     index_bytes, position_bytes + index_bytes, uri);
}

}  // namespace

std::string objBytes(const TriangleMesh& mesh) {
  std::string text = "# a comment\nmtllib none.mtl\no thing\n";
  for (const Vec3& p : mesh.positions) text += "v " + words(p) + "\n";
  text += "vt 0 0\nvn 0 0 1\ns off\n";
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("f {}/1/1 {}//1 {}\n", a + 1, b + 1, c + 1);
  return text;
}

std::string offBytes(const TriangleMesh& mesh) {
  std::string text = fmt::format("OFF\n# a comment\n{} {} 0\n", mesh.positions.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.positions) text += words(p) + "\n";
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {} 255 0 0\n", a, b, c);
  return text;
}

std::string textStlBytes(const TriangleMesh& mesh) {
  std::string text = "solid a name of several words\n";
  for (const Triangle& t : mesh.triangles) {
    text += "  facet normal 0 0 1\n    outer loop\n";
    for (Index v : t) text += "      vertex " + words(mesh.positions[v]) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a name of several words\n";
}

std::string binaryStlBytes(const TriangleMesh& mesh) {
  std::string bytes = "solid, as many binary files start too";
  bytes.resize(80, '\0');
  bytes += raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    bytes += rawFloats(Vec3::Zero());
    for (Index v : t) bytes += rawFloats(mesh.positions[v]);
    bytes += raw(std::uint16_t{0});
  }
  return bytes;
}

std::string plyBytes(const TriangleMesh& mesh, PlyFormat format) {
  const bool is_text = format == PlyFormat::text;
  const bool big = format == PlyFormat::big_endian;
  std::string bytes = fmt::format(
      "ply\nformat {} 1.0\ncomment made by a test\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nelement face {}\nproperty list uchar int vertex_indices\nelement edge 1\n"
      "property int vertex1\nproperty int vertex2\nend_header\n",
      is_text ? "ascii"
      : big   ? "binary_big_endian"
              : "binary_little_endian",
      mesh.positions.size(), mesh.triangles.size());
  for (const Vec3& p : mesh.positions) {
    bytes += is_text ? words(p) + " 200\n" : rawFloats(p, big) + raw(std::uint8_t{200});
  }
  for (const Triangle& t : mesh.triangles) {
    if (is_text) {
      bytes += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    } else {
      bytes += raw(std::uint8_t{3}) + raw(t[0], big) + raw(t[1], big) + raw(t[2], big);
    }
  }
  return bytes + (is_text ? "0 1\n" : raw(std::int32_t{0}) + raw(std::int32_t{1}, big));
}

std::string gltfBuffer(const TriangleMesh& mesh) {
  std::string bytes;
  for (const Vec3& p : mesh.positions) bytes += rawFloats(p);
  for (const Triangle& t : mesh.triangles) {
    for (Index v : t) bytes += raw(static_cast<std::uint16_t>(v));
  }
  return bytes;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      bits = bits << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    }
    for (std::size_t j = 0; j < 4; ++j) text += i + j > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * j) & 63u];
  }
  return text;
}

std::string gltfBytes(const TriangleMesh& mesh, const std::string& node) {
  return gltfJson(mesh, node, ",\"uri\":\"data:application/octet-stream;base64," + base64(gltfBuffer(mesh)) + "\"");
}

std::string glbBytes(const TriangleMesh& mesh, const std::string& node) {
  return glbAround(gltfJson(mesh, node, ""), gltfBuffer(mesh));
}

std::string glbAround(std::string json, std::string binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto length = [](std::size_t bytes) { return raw(static_cast<std::uint32_t>(bytes)); };
  return "glTF" + raw(std::uint32_t{2}) + length(28 + json.size() + binary.size()) + length(json.size()) + "JSON" +
         json + length(binary.size()) + std::string("BIN\0", 4) + binary;
}

std::vector<MeshBytes> inEveryFormat(const TriangleMesh& mesh) {
  using mesh::Format;
  return {{"thing.obj", Format::obj, objBytes(mesh)},
          {"thing.off", Format::off, offBytes(mesh)},
          {"text.stl", Format::stl, textStlBytes(mesh)},
          {"binary.stl", Format::stl, binaryStlBytes(mesh)},
          {"text.ply", Format::ply, plyBytes(mesh, PlyFormat::text)},
          {"little.ply", Format::ply, plyBytes(mesh, PlyFormat::little_endian)},
          {"big.ply", Format::ply, plyBytes(mesh, PlyFormat::big_endian)},
          {"thing.gltf", Format::gltf, gltfBytes(mesh)},
          {"thing.glb", Format::glb, glbBytes(mesh)}};
}

}  // namespace palpate::support
