// Mesh files as bytes, made without the library's writers: so that readers are tested against the formats, not against
// our own idea of them.
#pragma once

#include <string>
#include <vector>

#include "palpate/mesh/files/load.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::support {

std::string objBytes(const mesh::TriangleMesh& mesh);
std::string offBytes(const mesh::TriangleMesh& mesh);
std::string textStlBytes(const mesh::TriangleMesh& mesh);
std::string binaryStlBytes(const mesh::TriangleMesh& mesh);
enum class PlyFormat { text, little_endian, big_endian };
/// With a colour per vertex and an element of edges behind the faces, as scanners write them.
std::string plyBytes(const mesh::TriangleMesh& mesh, PlyFormat format);
/// Positions as float, indices as unsigned short; `node` is JSON put into the only node, e.g. `,"scale":[1,1,-1]`.
std::string gltfBytes(const mesh::TriangleMesh& mesh, const std::string& node = "");
std::string glbBytes(const mesh::TriangleMesh& mesh, const std::string& node = "");
/// Two chunks with their headers around any JSON and any binary part.
std::string glbAround(std::string json, std::string binary);
/// Positions as float, then indices as unsigned short: the buffer of the two above.
std::string gltfBuffer(const mesh::TriangleMesh& mesh);
std::string base64(const std::string& bytes);

struct MeshBytes {
  std::string name;
  mesh::Format format;
  std::string bytes;
};
/// One mesh in every format above.
std::vector<MeshBytes> inEveryFormat(const mesh::TriangleMesh& mesh);

}  // namespace palpate::support
