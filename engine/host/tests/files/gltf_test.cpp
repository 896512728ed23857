// glTF as its specification allows it: how strings and buffers are written, what moves a mesh, what is left out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "palpate/base/json.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/detail/json.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/validate.h"
#include "palpate/mesh/winding.h"
#include "support/error_message.h"
#include "support/mesh_bytes.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace palpate::mesh {

namespace {

const std::filesystem::path kCases = support::testData() / "mesh/gltf";

/// `bytes` with the first `old_text` replaced.
std::string changed(std::string bytes, std::string_view old_text, std::string_view new_text) {
  const auto at = bytes.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  return bytes.replace(at, old_text.size(), new_text);
}

std::string gltfRefusal(const std::string& json) {
  return support::thrownMessage([&] { loadFromMemory(json, Format::gltf, "x"); });
}

MeshWithChannels gltfFrom(const std::string& json) { return loadWithChannelsFromMemory(json, Format::gltf, "x"); }

/// In the file's unit.
Eigen::AlignedBox3d loadBox(const std::string& json) {
  return boundingBox(loadFromMemory(json, Format::gltf, "x", {.unit_mm = 1.0}));
}

void expectBox(const Eigen::AlignedBox3d& box, const Vec3& low, const Vec3& high) {
  EXPECT_LT((box.min() - low).norm() + (box.max() - high).norm(), 1e-5)
      << box.min().transpose() << " to " << box.max().transpose();
}

template <class Number>
std::string rawBytes(std::initializer_list<Number> numbers) {
  std::string bytes;
  for (const Number number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  return bytes;
}

/// One triangle (0 0 0, 1 0 0, 0 1 0) whose file can be added to: accessor 0 its positions; `buffer` lies behind them
/// in views of its own, which start at view 1.
struct OneTriangle {
  std::string primitive = R"("attributes":{"POSITION":0})";
  std::string mesh{};       ///< what a mesh has beside its primitive
  std::string node{};       ///< the same of the node
  std::string nodes{};      ///< more nodes
  std::string accessors{};  ///< more accessors
  std::string views{};      ///< more views
  std::string buffer{};
  std::string root{};

  std::string json() const {
    const std::string bytes = rawBytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}) + buffer;
    return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" + node + "}" + nodes +
           R"(],"meshes":[{"primitives":[{)" + primitive + "}]" + mesh +
           R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"})" + accessors +
           R"(],"bufferViews":[{"buffer":0,"byteLength":36})" + views + R"(],"buffers":[{"byteLength":)" +
           std::to_string(bytes.size()) + R"(,"uri":"data:application/gltf-buffer;base64,)" + support::base64(bytes) +
           R"("}])" + root + "}";
  }
};

}  // namespace

// --- how strings are written ---

TEST(GltfStrings, EscapesAreReadAsEveryJsonWriterMayWriteThem) {
  for (const char* name : {"gltf_u003d.gltf", "gltf_u002b.gltf"}) {
    EXPECT_EQ(load(kCases / name).triangles.size(), 12u) << name;
  }
  const support::TemporaryFolder folder;
  std::filesystem::copy_file(kCases / "gltf_umlaut_escaped.gltf", folder / "a.gltf");
  std::filesystem::copy_file(kCases / "umlaut.bin", folder.path() / pathOf("haut_\xc3\xa4.bin"));
  EXPECT_EQ(load(folder / "a.gltf").triangles.size(), 12u);
}

TEST(GltfStrings, NamesOfMembersMayBeEscapedToo) {
  const std::string json = changed(support::gltfBytes(zoo::cube()), R"("POSITION")", R"("\u0050OSITION")");
  EXPECT_EQ(gltfFrom(json).mesh.triangles.size(), 12u);
}

TEST(GltfStrings, AreReadAsTheJsonLibraryReadsThem) {
  std::string every = R"(["\"\\\/\b\f\n\r\t","\u0041\u00e4\u20ac\uFFFD\ud83d\ude00 \u00C4","plain","")";
  for (int letter = 0; letter < 0x300; ++letter) every += fmt::format(R"(,"a\u{:04x}b")", letter);
  every += "]";
  const Json expected = Json::parse(every);
  const JsonDocument document(every, {.file = "x"});
  const auto found = document.root().items();
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].text(), expected.at(i).text());
}

TEST(GltfStrings, WhatIsNoJsonIsRefusedAsTheLibraryRefusesIt) {
  for (const char* text :
       {R"("\x")", R"("\u12")", R"("\u12g4")", "01", "-", "1.", ".5", "+1", "1e", "1e+", "--1", "0x1"}) {
    EXPECT_TRUE(Json::tryParse(text).is_discarded()) << text;
    EXPECT_NE(support::thrownMessage([&] { JsonDocument(text, {.file = "x"}); }), "no error") << text;
  }
  for (const char* text : {"0", "-0", "1.5", "1e5", "-1.5E-05", "10", "\xef\xbb\xbf{}"}) {
    EXPECT_NO_THROW(JsonDocument(text, {.file = "x"})) << text;
  }
}

// --- where a buffer is ---

TEST(GltfBuffers, EveryFormOfDataUriIsRead) {
  const TriangleMesh cube = zoo::cube();
  const std::string json = support::gltfBytes(cube);
  const std::string bytes = support::gltfBuffer(cube);
  const std::string base64 = support::base64(bytes);
  std::string escaped;
  for (const char c : bytes) escaped += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  std::string escaped_base64;
  for (const char c : base64)
    escaped_base64 += c == '+' || c == '/' || c == '=' ? fmt::format("%{:02x}", c) : std::string(1, c);
  std::string broken_lines = base64;
  broken_lines.insert(10, "\\n").insert(40, "%0D%0A");
  for (const std::string& uri :
       {"data:application/gltf-buffer;base64," + base64, "data:;base64," + base64,
        "DATA:text/plain;charset=x;Base64," + base64, "data:application/octet-stream;base64," + escaped_base64,
        "data:application/octet-stream;base64," + broken_lines, "data:application/octet-stream," + escaped,
        "data:," + escaped}) {
    EXPECT_EQ(gltfFrom(changed(json, "data:application/octet-stream;base64," + base64, uri)).mesh.triangles.size(), 12u)
        << uri.substr(0, 60);
  }
  EXPECT_EQ(gltfRefusal(changed(json, "data:application/octet-stream;base64," + base64, "data:x")),
            "x:1: a data URI without a comma");
}

TEST(GltfBuffers, RelativeReferencesAreReadAsTheyAreWritten) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "parts");
  const std::string buffer = support::gltfBuffer(zoo::cube());
  for (const char* name : {"parts/a b+c.bin", "100%.bin", "a#b.bin"})
    std::ofstream(folder / name, std::ios::binary) << buffer;
#ifndef _WIN32
  std::ofstream(folder / "a:b.bin", std::ios::binary) << buffer;
  const auto uris = {
      "./parts/a%20b%2Bc.bin", "parts/../parts/a b+c.bin", "100%.bin", "a%23b.bin", "./a:b.bin", "a%3Ab.bin"};
#else
  const auto uris = {"./parts/a%20b%2Bc.bin", "parts/../parts/a b+c.bin", "100%.bin", "a%23b.bin"};
#endif
  const std::string json = support::gltfBytes(zoo::cube());
  const auto start = json.find("data:");
  for (const char* uri : uris) {
    std::ofstream(folder / "a.gltf", std::ios::binary)
        << std::string(json).replace(start, json.find('"', start) - start, uri);
    EXPECT_EQ(load(folder / "a.gltf").triangles.size(), 12u) << uri;
  }
}

TEST(GltfBuffers, ThatNothingOfTheMeshNeedsDecideNothing) {
  const std::string json = changed(support::gltfBytes(zoo::cube()), R"("buffers":[)", R"("unused":[)");
  const std::string buffers = R"(,"buffers":[)" + json.substr(json.find(R"("unused":[)") + 10);
  const std::string more = changed(buffers, "}]}", R"(},{"byteLength":99,"uri":"animation.bin"},{"byteLength":4}]})");
  EXPECT_EQ(gltfFrom(json.substr(0, json.find(R"(,"unused")")) + more).mesh.triangles.size(), 12u);
}

TEST(GltfBuffers, OfAGlbMayBePaddedWithZerosAndFollowedByBytes) {
  std::string json = support::gltfBytes(zoo::cube());
  json.resize(json.size() + 4 - json.size() % 4, '\0');
  const std::string glb = support::glbAround(json, "");
  EXPECT_EQ(loadFromMemory(glb, Format::glb, "x").triangles.size(), 12u);
  const auto followed = loadWithChannelsFromMemory(glb + "abc", Format::glb, "x");
  EXPECT_EQ(followed.notes, std::vector<std::string>{"x: left out: bytes after the end of the GLB (3)"});
}

// --- accessors ---

TEST(GltfAccessors, SparseOnesAreFilledIn) {
  OneTriangle triangle;
  triangle.buffer = rawBytes<std::uint16_t>({2, 0}) + rawBytes<float>({0, 5, 0});
  triangle.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":4},{"buffer":0,"byteOffset":40,"byteLength":12})";
  const std::string sparse =
      R"(,"sparse":{"count":1,"indices":{"bufferView":1,"componentType":5123},"values":{"bufferView":2}})";
  const std::string json = triangle.json();
  expectBox(loadBox(changed(json, R"("type":"VEC3")", R"("type":"VEC3")" + sparse)), Vec3::Zero(), Vec3(1, 5, 0));
  const std::string of_zeros =
      changed(changed(json, R"("bufferView":0,)", ""), R"("type":"VEC3")", R"("type":"VEC3")" + sparse);
  expectBox(loadBox(of_zeros), Vec3::Zero(), Vec3(0, 5, 0));
  EXPECT_EQ(gltfRefusal(changed(changed(json, R"("type":"VEC3")", R"("type":"VEC3")" + sparse), R"("count":3)",
                                R"("count":2)")),
            "x:1: a sparse accessor changes element 2 of 2");
}

TEST(GltfAccessors, ZerosThatTakeNoBytesAreBounded) {
  const std::string json = OneTriangle().json();
  const std::string of_zeros =
      changed(json, R"("bufferView":0,"componentType":5126,"count":3)", R"("componentType":5126,"count":3000000000)");
  EXPECT_NE(gltfRefusal(of_zeros).find("3000000000 zeros"), std::string::npos);
}

TEST(GltfAccessors, WholeNumbersAreNormalisedAndStridesKept) {
  OneTriangle triangle;
  triangle.root = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
  triangle.buffer = rawBytes<std::int16_t>({0, 0, 0, 9, 32767, 0, 0, 9, 0, -32767, 0, 9});
  triangle.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":24,"byteStride":8})";
  triangle.accessors = R"(,{"bufferView":1,"componentType":5122,"normalized":true,"count":3,"type":"VEC3"})";
  triangle.primitive = R"("attributes":{"POSITION":1})";
  expectBox(loadBox(triangle.json()), Vec3(0, -1, 0), Vec3(1, 0, 0));
}

// --- what moves a mesh ---

TEST(GltfPose, TheNodeOfASkinnedMeshMovesNothing) {
  const auto box = boundingBox(load(kCases / "gltf_skinned_scaled_node.gltf"));
  EXPECT_LT((box.sizes() - Vec3::Constant(100)).norm(), 1e-3);
}

/// Skinned by two joints at nodes 1 and 2, whose weights are given for the three vertices.
OneTriangle skinnedTriangle(std::initializer_list<float> weights) {
  OneTriangle triangle;
  triangle.node = R"(,"skin":0,"translation":[50,0,0])";
  triangle.nodes = R"(,{"translation":[10,0,0]},{"translation":[0,10,0]})";
  triangle.buffer = rawBytes<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}) + rawBytes(weights);
  triangle.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteOffset":48,"byteLength":48})";
  triangle.accessors = R"(,{"bufferView":1,"componentType":5121,"count":3,"type":"VEC4"})"
                       R"(,{"bufferView":2,"componentType":5126,"count":3,"type":"VEC4"})";
  triangle.primitive = R"("attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2})";
  triangle.root = R"(,"skins":[{"joints":[1,2]}])";
  return triangle;
}

TEST(GltfPose, JointsCarryVerticesByTheirWeights) {
  expectBox(loadBox(skinnedTriangle({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}).json()), Vec3(10, 0, 0), Vec3(11, 1, 0));
  expectBox(loadBox(skinnedTriangle({0.5, 0.5, 0, 0, 2, 2, 0, 0, 0, 0, 0, 0}).json()), Vec3(5, 1, 0), Vec3(10, 5, 0));
}

TEST(GltfPose, WrongJointsAreRefused) {
  const OneTriangle triangle = skinnedTriangle({1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0});
  EXPECT_EQ(gltfRefusal(changed(triangle.json(), R"("joints":[1,2])", R"("joints":[1])")),
            "x:1: joint 1 is out of range; the skin has 1");
  EXPECT_EQ(gltfRefusal(changed(triangle.json(), R"("WEIGHTS_0")", R"("WEIGHTS_1")")),
            "x:1: a skinned primitive without JOINTS_0 and WEIGHTS_0");
  EXPECT_EQ(gltfRefusal(changed(triangle.json(), R"({"translation":[0,10,0]})", R"({"children":[2]})")),
            "x:1: a joint within a loop of nodes");
}

TEST(GltfPose, WeightsOfAFileMorphItsMesh) {
  OneTriangle triangle;
  triangle.buffer = rawBytes<float>({0, 0, 2, 0, 0, 2, 0, 0, 2});
  triangle.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":36})";
  triangle.accessors = R"(,{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"})";
  triangle.primitive += R"(,"targets":[{"POSITION":1}])";
  EXPECT_EQ(loadBox(triangle.json()).max().z(), 0.0);
  triangle.mesh = R"(,"weights":[0.5])";
  EXPECT_EQ(loadBox(triangle.json()).min().z(), 1.0);
  triangle.node = R"(,"weights":[2])";
  EXPECT_EQ(loadBox(triangle.json()).min().z(), 4.0) << "the node's weights come before the mesh's";
}

TEST(GltfPose, InstancesOfANodeAreAllThere) {
  OneTriangle triangle;
  triangle.node = R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":0}}})";
  triangle.root = R"(,"extensionsRequired":["EXT_mesh_gpu_instancing"])";
  EXPECT_EQ(gltfFrom(triangle.json()).mesh.triangles.size(), 3u);
  expectBox(loadBox(triangle.json()), Vec3::Zero(), Vec3(2, 2, 0));
}

// --- what is refused or left out, by its name ---

TEST(GltfNeeds, AnUnknownRequiredExtensionIsNamedBeforeBuffersAreRead) {
  const std::string packed = support::thrownMessage([] { load(kCases / "glb_meshopt.glb"); });
  EXPECT_NE(packed.find("geometry compressed with EXT_meshopt_compression cannot be read"), std::string::npos);
  const std::string missing = changed(OneTriangle{.root = R"(,"extensionsRequired":["ACME_shape"])"}.json(),
                                      "data:application/gltf-buffer;base64,", "gone.bin?");
  EXPECT_EQ(gltfRefusal(missing), "x:1: the file requires the extension ACME_shape, which is not supported");
  EXPECT_EQ(gltfRefusal(OneTriangle{.root = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])"}.json()),
            "x:1: geometry compressed with KHR_draco_mesh_compression cannot be read");
  EXPECT_EQ(
      gltfFrom(OneTriangle{.root = R"(,"extensionsRequired":["KHR_materials_unlit"])"}.json()).mesh.triangles.size(),
      1u);
  EXPECT_EQ(gltfRefusal(changed(OneTriangle().json(), R"("version":"2.0")", R"("version":"1.0")")),
            "x:1: glTF 1.0 cannot be read, glTF 2 can");
}

TEST(GltfNeeds, CompressionThatIsNotRequiredNeedsAPlainCopy) {
  const std::string packed = R"("byteLength":36,"extensions":{"EXT_meshopt_compression":{"buffer":1}})";
  const std::string json = changed(OneTriangle().json(), R"("byteLength":36)", packed);
  EXPECT_EQ(gltfFrom(json).mesh.triangles.size(), 1u);
  const std::string without = changed(json, R"("uri")", R"("no_uri")");
  EXPECT_EQ(gltfRefusal(without), "x:1: geometry compressed with EXT_meshopt_compression cannot be read");
  OneTriangle draco;
  draco.primitive += R"(,"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}})";
  EXPECT_EQ(gltfFrom(draco.json()).mesh.triangles.size(), 1u);
  EXPECT_EQ(gltfRefusal(changed(draco.json(), R"("bufferView":0,"componentType")", R"("componentType")")),
            "x:1: geometry compressed with KHR_draco_mesh_compression cannot be read");
}

TEST(GltfNeeds, PointsLinesAndWhatTheSceneDoesNotShowAreTold) {
  OneTriangle triangle;
  triangle.primitive +=
      R"(},{"attributes":{"POSITION":0},"mode":0},{"attributes":{"POSITION":0},"mode":3},{"attributes":{})";
  triangle.mesh = R"(},{"primitives":[])";
  triangle.nodes = R"(,{"mesh":0})";
  EXPECT_EQ(
      gltfFrom(triangle.json()).notes,
      std::vector<std::string>{
          "x: left out: primitives of points (1), primitives of lines (1), primitives without POSITION (1), nodes with "
          "a mesh that the scene does not show (1), meshes that no node shows (1)"});
  triangle = {};
  triangle.primitive += R"(,"mode":1)";
  EXPECT_EQ(gltfRefusal(triangle.json()), "x: the file has no triangles; left out: primitives of lines (1)");
}

TEST(GltfNeeds, StripsAndFansAreReadAndHalfATriangleIsRefused) {
  OneTriangle square;
  square.buffer = rawBytes<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  square.views = R"(,{"buffer":0,"byteOffset":36,"byteLength":48})";
  square.accessors = R"(,{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"})";
  square.primitive = R"("attributes":{"POSITION":1},"mode":5)";
  const TriangleMesh strip = gltfFrom(square.json()).mesh;
  ASSERT_EQ(strip.triangles.size(), 2u);
  for (const auto& [a, b, c] : strip.triangles) {
    EXPECT_GT(areaVector2(strip.positions[a], strip.positions[b], strip.positions[c]).z(), 0.0);
  }
  EXPECT_EQ(gltfRefusal(changed(square.json(), R"("mode":5)", R"("mode":4)")),
            "x:1: 4 corners are no whole number of triangles");
}

TEST(LeftOut, ShapesThatAreNoTrianglesAreToldInEveryFormat) {
  const auto obj = loadWithChannelsFromMemory("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\np 1\nsurf 0 1 0 1 1 2 3\n",
                                              Format::obj, "x");
  EXPECT_EQ(obj.notes,
            (std::vector<std::string>{"x:7: 'surf' defines a surface, which is not supported; only faces are read",
                                      "x: left out: lines (1), points (1)"}));
  const auto ply =
      loadWithChannelsFromMemory(support::plyBytes(zoo::cube(), support::PlyFormat::text), Format::ply, "x");
  EXPECT_EQ(ply.notes, std::vector<std::string>{"x: left out: elements 'edge' (1)"});
  EXPECT_TRUE(gltfFrom(support::gltfBytes(zoo::cube())).notes.empty());
}

TEST(LeftOut, StripsOfAPlyAreTriangles) {
  const auto strips = loadFromMemory(
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
      "8 0 1 2 3 -1 1 3 2\n",
      Format::ply, "x");
  ASSERT_EQ(strips.triangles.size(), 3u);
  for (const auto& [a, b, c] : strips.triangles) {
    EXPECT_GT(areaVector2(strips.positions[a], strips.positions[b], strips.positions[c]).z(), 0.0);
  }
}

}  // namespace palpate::mesh
