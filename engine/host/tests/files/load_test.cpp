#include "palpate/mesh/files/load.h"

#include <gtest/gtest.h>

#include <fstream>

#include "palpate/base/random.h"
#include "palpate/mesh/files/read_foreign.h"
#include "palpate/mesh/files/save.h"
#include "palpate/mesh/validate.h"
#include "palpate/mesh/winding.h"
#include "support/error_message.h"
#include "support/mesh_bytes.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"

namespace palpate::mesh {

using support::thrownMessage;

void writeFile(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string refusal(const std::string& bytes, Format format, const LoadOptions& options = {}) {
  return thrownMessage([&] { loadFromMemory(bytes, format, "x", options); });
}

// --- the same mesh in every format ---

TEST(Load, EveryFormatGivesTheSameMesh) {
  const TriangleMesh torus = zoo::torus(20, 6, 12, 8);
  for (const auto& [name, format, bytes] : support::inEveryFormat(torus)) {
    // glTF is in metres; text with six digits and floats are exact to 1e-5 here.
    const double unit = format == Format::gltf || format == Format::glb ? 1000.0 : 1.0;
    const TriangleMesh mesh = loadFromMemory(bytes, format, name);
    ASSERT_EQ(mesh.triangles.size(), torus.triangles.size()) << name;
    ASSERT_EQ(mesh.positions.size(), torus.positions.size()) << name;
    for (std::size_t t = 0; t < torus.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& p = mesh.positions[mesh.triangles[t][i]];
        ASSERT_LT((p / unit - torus.positions[torus.triangles[t][i]]).norm(), 1e-5) << name;
      }
    }
  }
}

TEST(Load, FindsTheFormatByContentAndByExtension) {
  const support::TemporaryFolder folder;
  for (const auto& [name, format, bytes] : support::inEveryFormat(zoo::cube())) {
    writeFile(folder / name, bytes);
    EXPECT_EQ(load(folder / name).triangles.size(), 12u) << name;
  }
  writeFile(folder / "upper.STL", support::binaryStlBytes(zoo::cube()));
  writeFile(folder / "ply.dat", support::plyBytes(zoo::cube(), support::PlyFormat::text));
  EXPECT_EQ(load(folder / "upper.STL").positions.size(), 8u);
  EXPECT_EQ(load(folder / "ply.dat").triangles.size(), 12u);
  writeFile(folder / "notes.txt", "hello");
  EXPECT_NE(thrownMessage([&] { load(folder / "notes.txt"); }).find("not a supported mesh file"), std::string::npos);
}

TEST(Load, ConvertsUnits) {
  const auto metres = loadFromMemory(support::objBytes(zoo::cube(0.01)), Format::obj, "x", {.unit_mm = 1000.0});
  EXPECT_NEAR(signedVolume(metres), 1000.0, 1e-6);
  const auto as_is = loadFromMemory(support::glbBytes(zoo::cube()), Format::glb, "x", {.unit_mm = 1.0});
  EXPECT_NEAR(signedVolume(as_is), 1000.0, 1e-6);
}

TEST(Load, WeldsWhatTheFormatRepeats) {
  const auto soup = support::objBytes(zoo::soup(zoo::cube()));
  EXPECT_EQ(loadFromMemory(soup, Format::obj, "x").positions.size(), 36u);
  EXPECT_EQ(loadFromMemory(soup, Format::obj, "x", {.weld = true}).positions.size(), 8u);
  const auto stl = support::binaryStlBytes(zoo::cube());
  EXPECT_EQ(loadFromMemory(stl, Format::stl, "x").positions.size(), 8u);
  EXPECT_EQ(loadFromMemory(stl, Format::stl, "x", {.weld = false}).positions.size(), 36u);
}

TEST(Load, ReportsProgressThatGrows) {
  double last = -1.0;
  loadFromMemory(support::binaryStlBytes(zoo::grid(300)), Format::stl, "x", {}, [&](std::string_view, double done) {
    EXPECT_GE(done, last);
    last = done;
  });
  EXPECT_EQ(last, 1.0);
}

TEST(Load, OtherFormatsOnlyWhenAskedFor) {
  const std::string ac3d =  // a simple format of assimp's: one square
      "AC3Db\nMATERIAL \"m\" rgb 1 1 1  amb 1 1 1  emis 0 0 0  spec 0 0 0  shi 0  trans 0\nOBJECT world\nkids 1\n"
      "OBJECT poly\nnumvert 4\n0 0 0\n10 0 0\n10 10 0\n0 10 0\nnumsurf 1\nSURF 0x20\nmat 0\nrefs 4\n0 0 0\n1 1 0\n"
      "2 1 1\n3 0 1\nkids 0\n";
  const support::TemporaryFolder folder;
  writeFile(folder / "square.ac", ac3d);
  EXPECT_NE(thrownMessage([&] { load(folder / "square.ac"); }).find("not a supported mesh file"), std::string::npos);
#ifndef PALPATE_ASSIMP
  EXPECT_EQ(thrownMessage([&] { load(folder / "square.ac", {.allow_foreign = true}); }),
            (folder / "square.ac").string() + ": this format requires assimp, and palpate was built without it");
  GTEST_SKIP() << "built without assimp";
#else
  installForeignReader();
#endif
  EXPECT_NEAR(validate(load(folder / "square.ac", {.allow_foreign = true})).area_mm2, 100.0, 1e-4);
  writeFile(folder / "broken.ac", "AC3D");
  EXPECT_EQ(
      thrownMessage([&] { load(folder / "broken.ac", {.allow_foreign = true}); }).find((folder / "broken.ac").string()),
      0u);
}

// --- polygons ---

TEST(LoadObj, CutsPolygonsAndCountsBackwards) {
  const auto square = loadFromMemory("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\n", Format::obj, "x");
  EXPECT_EQ(square.triangles.size(), 2u);
  EXPECT_NEAR(validate(square).area_mm2, 1.0, 1e-12);
}

TEST(LoadObj, CutsConcavePolygonsWithoutFolding) {
  const std::string arrow = "v 0 0 0\nv 2 -2 0\nv 0 3 0\nv -2 -2 0\nf 2 3 4 1\n";  // concave at vertex 1
  const std::string comb =
      "v 0 0 0\nv 5 0 0\nv 5 3 0\nv 4 3 0\nv 4 1 0\nv 3 1 0\nv 3 3 0\nv 2 3 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n"
      "f 1 2 3 4 5 6 7 8 9 10 11 12\n";
  for (const auto& [text, area] : {std::pair(arrow, 6.0), std::pair(comb, 11.0)}) {
    const auto mesh = loadFromMemory(text, Format::obj, "x");
    EXPECT_NEAR(validate(mesh).area_mm2, area, 1e-12);
    for (const auto& [a, b, c] : mesh.triangles) {
      EXPECT_GT(areaVector2(mesh.positions[a], mesh.positions[b], mesh.positions[c]).z(), 0.0);
    }
  }
}

TEST(LoadObj, TakesOneGroup) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng body skin\nf 1 2 3\ng helper\nf 1 2 4\nf 2 3 4\no body\nf 1 3 4\n";
  const auto body = loadFromMemory(text, Format::obj, "x", {.group = "body"});
  EXPECT_EQ(body.triangles.size(), 2u);
  EXPECT_EQ(loadFromMemory(text, Format::obj, "x", {.group = "skin"}).positions.size(), 3u);
  EXPECT_EQ(refusal(text, Format::obj, {.group = "hat"}), "x: no group or object 'hat'; there are: body, helper, skin");
}

TEST(LoadObj, ReadsContinuedLinesAndWindowsLineEnds) {
  const auto mesh =
      loadFromMemory("v 0 0 0 \\\r\n 1.0\r\nv +1 0 0\r\nv 0 1e0 0\r\nf 1 2 \\\r\n3\r\n", Format::obj, "x");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

// --- glTF ---

TEST(LoadGltf, MovesMeshesByTheirNodes) {
  const auto moved = loadFromMemory(support::glbBytes(zoo::cube(), R"(,"translation":[1,2,3],"scale":[2,1,1])"),
                                    Format::glb, "x", {.unit_mm = 1.0});
  EXPECT_EQ(validate(moved).box.min(), Vec3(1, 2, 3));
  EXPECT_EQ(validate(moved).box.max(), Vec3(21, 12, 13));
  const auto mirrored = loadFromMemory(
      support::gltfBytes(zoo::cube(), R"(,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1])"), Format::gltf, "x");
  EXPECT_GT(signedVolume(mirrored), 0.0) << "a mirror turns triangles inside out unless their winding is turned back";
  const auto turned = loadFromMemory(support::glbBytes(zoo::cube(), R"(,"rotation":[0,0,0.70710678,0.70710678])"),
                                     Format::glb, "x", {.unit_mm = 1.0});
  EXPECT_LT((validate(turned).box.min() - Vec3(-10, 0, 0)).norm(), 1e-6);
}

/// A glTF whose nodes are given; mesh 0 is a cube.
std::string gltfWithNodes(const std::string& nodes, const std::string& scene) {
  std::string json = support::gltfBytes(zoo::cube());
  json.replace(json.find(R"([{"mesh":0}])"), 12, nodes);
  json.replace(json.find(R"("nodes":[0])"), 11, scene);
  return json;
}

TEST(LoadGltf, MergesAllNodesOfTheScene) {
  const auto two =
      gltfWithNodes(R"([{"children":[1,2]},{"mesh":0},{"mesh":0,"translation":[1,0,0]},{"mesh":0}])", R"("nodes":[0])");
  EXPECT_EQ(loadFromMemory(two, Format::gltf, "x").triangles.size(), 24u);
}

TEST(LoadGltf, RefusesLoopsOfNodes) {
  const auto loop = gltfWithNodes(R"([{"children":[1]},{"children":[0],"mesh":0}])", R"("nodes":[0])");
  EXPECT_EQ(refusal(loop, Format::gltf), "x:1: the node is shown twice: nodes must form a tree");
}

TEST(LoadGltf, ReadsIndicesOfOneByte) {
  const support::TemporaryFolder folder;
  const TriangleMesh triangle = zoo::oneTriangle();
  const std::string places = support::gltfBuffer(triangle).substr(0, 36);
  writeFile(folder / "bytes.bin", places + std::string("\2\0\1\0\0\0", 6));
  std::string json = support::gltfBytes(triangle);
  const auto start = json.find("data:");
  json.replace(start, json.find('"', start) - start, "bytes.bin");
  json.replace(json.find("5123"), 4, "5121");
  writeFile(folder / "bytes.gltf", json);
  const auto loaded = load(folder / "bytes.gltf");
  ASSERT_EQ(loaded.triangles.size(), 1u);
  EXPECT_EQ(loaded.triangles[0], (Triangle{2, 0, 1}));
}

TEST(LoadGltf, ReadsBuffersBesideTheFileAndNowhereElse) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "parts");
  writeFile(folder / "parts/a b.bin", support::gltfBuffer(zoo::cube()));
  std::string json = support::gltfBytes(zoo::cube());
  const auto start = json.find("data:");
  const auto end = json.find('"', start);
  const auto with_uri = [&](const std::string& uri) { return std::string(json).replace(start, end - start, uri); };
  writeFile(folder / "good.gltf", with_uri("parts/a%20b.bin"));
  EXPECT_EQ(load(folder / "good.gltf").triangles.size(), 12u);
  for (const char* uri : {"../parts/a b.bin", "/etc/passwd", "file:///etc/passwd", "parts/../../x"}) {
    writeFile(folder / "bad.gltf", with_uri(uri));
    EXPECT_NE(thrownMessage([&] { load(folder / "bad.gltf"); }).find("same folder or below"), std::string::npos) << uri;
  }
  writeFile(folder / "bad.gltf", with_uri("parts/a b.bin%00.png"));
  EXPECT_NE(thrownMessage([&] { load(folder / "bad.gltf"); }).find("must not contain a zero byte"), std::string::npos);
  EXPECT_NE(refusal(with_uri("parts/a b.bin"), Format::gltf).find("has no folder to search"), std::string::npos);
  writeFile(folder / "missing.gltf", with_uri("gone.bin"));
  EXPECT_NE(thrownMessage([&] { load(folder / "missing.gltf"); }).find("gone.bin: no such file"), std::string::npos);
}

TEST(LoadGltf, ChecksEverySizeAgainstTheBytes) {
  const std::string json = support::gltfBytes(zoo::cube());
  const auto with = [&](const std::string& old_text, const std::string& new_text) {
    std::string changed = json;
    changed.replace(changed.find(old_text), old_text.size(), new_text);
    return refusal(changed, Format::gltf);
  };
  EXPECT_NE(with(R"("count":8)", R"("count":9)").find("the accessor declares 9 elements, but the bufferView has 8"),
            std::string::npos);
  EXPECT_NE(with(R"("count":36)", R"("count":4000000000)").find("the accessor declares 4000000000 elements"),
            std::string::npos);
  EXPECT_NE(with(R"("byteLength":96)", R"("byteLength":1e300)").find("byteLength"), std::string::npos);
  EXPECT_NE(with(R"("byteOffset":96)", R"("byteOffset":-1)").find("byteOffset"), std::string::npos);
  EXPECT_NE(with(R"("POSITION":0)", R"("POSITION":7)").find("accessor 7"), std::string::npos);
  EXPECT_NE(with(R"("bufferView":0,)", R"("sparse":{},)").find("sparse"), std::string::npos);
  EXPECT_NE(with(R"("mesh":0)", R"("mesh":0.5)").find("mesh 0.5"), std::string::npos);
}

TEST(LoadGltf, RefusesAShortFileThatShowsAMeshTooOften) {
  std::string nodes = R"([{"mesh":0})";
  std::string scene = R"("nodes":[0)";
  for (int i = 1; i < 20000; ++i) {
    nodes += R"(,{"mesh":0})";
    scene.append(",").append(std::to_string(i));
  }
  nodes += "]";
  scene += "]";
  std::string json = support::gltfBytes(zoo::grid(60, 1.0));
  json.replace(json.find(R"([{"mesh":0}])"), 12, nodes);
  json.replace(json.find(R"("nodes":[0])"), 11, scene);
  EXPECT_NE(refusal(json, Format::gltf).find("more often than"), std::string::npos);
}

// --- malformed files: one line that names the file and the place ---

TEST(LoadErrors, NameTheLineOfATextFile) {
  EXPECT_EQ(refusal("v 0 0 0\nv 0 zero 0\n", Format::obj), "x:2: a coordinate is not a number: 'zero'");
  EXPECT_EQ(refusal("v 0 0\n", Format::obj), "x:1: a coordinate is missing");
  EXPECT_EQ(refusal("v 0 0 0\n\nf 1 2 3\n", Format::obj), "x:3: the face uses vertex 2, but there are 1 vertices");
  EXPECT_EQ(refusal("v 0 0 0\nf 1 -5 1\n", Format::obj),
            "x:2: the face uses a vertex below the first, but there are 1 vertices");
  EXPECT_EQ(refusal("once upon a time\n", Format::obj),
            "x:1: 'once' is not an OBJ keyword, and the file has no faces after it");
  EXPECT_EQ(refusal("v 0 0 0\n", Format::obj), "x: the file has no triangles");
  EXPECT_EQ(refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n", Format::off),
            "x:4: the file ends before all its 3 vertices are there");
  EXPECT_EQ(refusal("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n", Format::stl),
            "x:6: the file ends where 'endfacet' is expected");
  EXPECT_EQ(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", Format::ply),
            "x:5: the vertices have no 'y'");
  EXPECT_EQ(refusal("{\n\"scene\": nope\n}", Format::gltf), "x:2: not a JSON value");
}

TEST(LoadErrors, NameTheByteOfABinaryFile) {
  const std::string stl = support::binaryStlBytes(zoo::cube());
  EXPECT_EQ(refusal(std::string(stl).replace(0, 5, "other").substr(0, 60), Format::stl),
            "x: byte 60: the file ends within the 84 bytes of an STL header");
  EXPECT_EQ(refusal(std::string(stl).replace(0, 5, "other").substr(0, 600), Format::stl),
            "x: byte 80: not an STL file, or damaged: 12 triangles need 684 bytes, the file has 600");
  const std::string ply = support::plyBytes(zoo::cube(), support::PlyFormat::little_endian);
  EXPECT_NE(refusal(ply.substr(0, ply.size() - 10), Format::ply).find("x: byte "), std::string::npos);
  EXPECT_NE(refusal(support::glbBytes(zoo::cube()).substr(0, 300), Format::glb).find("x: byte 8: the header declares"),
            std::string::npos);
}

TEST(LoadErrors, EmptyMissingAndForeignFiles) {
  const support::TemporaryFolder folder;
  std::string garbage(5000, '\0');
  Random random(7);
  for (char& c : garbage) c = static_cast<char>(random.bits());
  for (const char* extension : {"obj", "stl", "ply", "off", "gltf", "glb"}) {
    const auto file = folder / (std::string("mesh.") + extension);
    EXPECT_EQ(thrownMessage([&] { load(file); }), file.string() + ": no such file");
    writeFile(file, "");
    EXPECT_EQ(thrownMessage([&] { load(file); }), file.string() + ": the file is empty");
    for (const std::string& content :
         {garbage, std::string("<html><body>Not found</body></html>\n"), std::string(10, '\n'),
          std::string("\x89PNG\r\n\x1a\n"), std::string(100, '\0')}) {
      writeFile(file, content);
      const std::string message = thrownMessage([&] { load(file); });
      EXPECT_EQ(message.rfind(file.string(), 0), 0u) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
  EXPECT_NE(thrownMessage([&] { load(folder.path()); }).find("not a file"), std::string::npos);
}

TEST(LoadErrors, AHeaderThatLiesTakesNoMemory) {
  // Each promises billions; reserving for them would throw bad_alloc or be killed.
  EXPECT_NE(refusal("OFF\n4000000000 4000000000 0\n", Format::off), "no error");
  EXPECT_NE(refusal("ply\nformat binary_little_endian 1.0\nelement vertex 4611686018427387904\nproperty float x\n"
                    "property float y\nproperty float z\nend_header\nabc",
                    Format::ply),
            "no error");
  EXPECT_NE(refusal("ply\nformat ascii 1.0\nelement junk 4611686018427387904\nelement face 1\n"
                    "property list uint uint vertex_indices\nend_header\n4000000000 1\n",
                    Format::ply),
            "no error");
  std::string stl(84, '\0');
  stl.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_NE(refusal(stl, Format::stl), "no error");
  EXPECT_NE(refusal(std::string(100'000, '['), Format::gltf).find("nested too deep"), std::string::npos);
}

TEST(LoadErrors, WrongIndicesAreKeptForTheReportWhenAsked) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n";
  const auto mesh = loadFromMemory(obj, Format::obj, "x", {.keep_wrong_indices = true});
  EXPECT_EQ(validate(mesh).wrong_indices.first, (std::vector<Index>{1}));
}

/// Loads and demands that the outcome is a mesh within its own indices or one Error.
void expectMeshOrOneError(const std::string& bytes, Format format, const std::string& name) {
  try {
    const auto mesh = loadFromMemory(bytes, format, name);
    EXPECT_FALSE(mesh.triangles.empty());
    for (const Triangle& t : mesh.triangles) {
      for (Index v : t) ASSERT_LT(v, mesh.positions.size()) << name;
    }
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).rfind(name, 0), 0u) << error.what();
  }
}

TEST(LoadErrors, FilesCutAnywhere) {
  for (const auto& [name, format, bytes] : support::inEveryFormat(zoo::cube())) {
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      expectMeshOrOneError(bytes.substr(0, length), format, name);
    }
  }
}

TEST(LoadErrors, FilesDamagedAnywhere) {
  Random random(42);
  for (const auto& [name, format, bytes] : support::inEveryFormat(zoo::cube())) {
    for (int round = 0; round < 3000; ++round) {
      std::string damaged = bytes;
      for (std::uint64_t i = 0; i <= random.below(4); ++i) {
        damaged[random.below(damaged.size())] = static_cast<char>(random.bits());
      }
      expectMeshOrOneError(damaged, format, name);
    }
  }
}

}  // namespace palpate::mesh
