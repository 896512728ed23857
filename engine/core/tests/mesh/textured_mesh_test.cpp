#include "palpate/mesh/textured_mesh.h"

#include <gtest/gtest.h>

#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/mesh/reorder.h"
#include "palpate/mesh/repair.h"
#include "support/error_message.h"
#include "support/mesh_bytes.h"
#include "support/mesh_zoo.h"
#include "support/temporary_folder.h"
#include "support/textured_bytes.h"

namespace palpate::mesh {
namespace {

using support::thrownMessage;

/// Files of textured meshes, each under its own name.
class TexturedFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    writeFile(folder_ / name, bytes);
    return folder_ / name;
  }
  TexturedMesh read(const std::string& obj, const LoadOptions& options = {}) const {
    return loadTextured(write("x.obj", obj), options);
  }
  support::TemporaryFolder folder_;
};

/// The surface as a scene makes it of the file: welded, mended, renumbered.
TriangleMesh asSkin(const TriangleMesh& mesh) {
  TriangleMesh skin = repair(zoo::soup(mesh)).mesh;
  reorderSpatially(skin);
  return skin;
}

void expectPlaces(const std::vector<TextureCorners>& found, const std::vector<TextureCorners>& expected,
                  float tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t t = 0; t < found.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT((found[t][i] - expected[t][i]).norm(), tolerance)
          << "triangle " << t << ": " << found[t][i].transpose() << " instead of " << expected[t][i].transpose();
    }
  }
}

TEST_F(TexturedFile, LiesOnTheSameSurfaceAfterWeldingMendingAndReordering) {
  struct Case {
    const char* name;
    TriangleMesh mesh;
    support::TextureLaw law;
  };
  for (const auto& [name, mesh, law] :
       {Case{"sheet", zoo::grid(12, 100.0), support::onSheet}, Case{"cube, six seams", zoo::cube(), support::onCube},
        Case{"sphere, one seam", zoo::sphere(20.0, 3), support::onSphere}}) {
    SCOPED_TRACE(name);
    const TriangleMesh skin = asSkin(mesh);
    ASSERT_EQ(skin.triangles.size(), mesh.triangles.size());
    const TexturedMesh textured = read(support::texturedObjBytes(mesh, law));
    expectPlaces(textureOn(skin, textured), support::cornersBy(law, skin), 1e-4f);
  }
}

TEST_F(TexturedFile, LiesOnASurfaceCutIntoOtherTriangles) {
  const TexturedMesh textured = read(support::texturedObjBytes(zoo::grid(7, 100.0), support::onSheet));
  const TriangleMesh finer = zoo::grid(40, 100.0);
  expectPlaces(textureOn(finer, textured), support::cornersBy(support::onSheet, finer), 1e-3f);
}

TEST_F(TexturedFile, LiesOnASurfaceThatIsALittleOff) {
  const TexturedMesh textured = read(support::texturedObjBytes(zoo::grid(12, 100.0), support::onSheet));
  TriangleMesh lifted = zoo::grid(12, 100.0);
  for (Vec3& p : lifted.positions) p.z() += 3.0;
  expectPlaces(textureOn(lifted, textured), support::cornersBy(support::onSheet, lifted), 1e-3f);
}

TEST_F(TexturedFile, IsReadInItsUnit) {
  const TexturedMesh textured =
      read(support::texturedObjBytes(zoo::grid(4, 100.0), support::onSheet), {.unit_mm = 10.0});
  EXPECT_NEAR(boundingBox(textured.mesh).sizes().x(), 1000.0, 1e-9);
}

TEST_F(TexturedFile, MayHavePolygonsAndFacesBeforeTheirCorners) {
  const TexturedMesh square = read(
      "f 1/1 2/2 3/3 4/4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
      "vt 0 0\nvt 1\nvt 1 1 0\nvt 0 1 # lower left is the first\n");
  ASSERT_EQ(square.mesh.triangles.size(), 2u);
  for (const Triangle& t : square.mesh.triangles) {
    for (const Index v : t) {
      const Vec3& place = square.mesh.positions[v];
      const TexturePlace expected(place.x(), place.x() == 1.0 && place.y() == 0.0 ? 0.0f : place.y());
      EXPECT_EQ(square.places[v], expected);
    }
  }
}

TEST_F(TexturedFile, KeepsOnlyTheTrianglesWithTexture) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n";
  const std::string faces =
      "f 1 2 3\nf 1//1 2//1 3//1\nf 1/1 2/2 3/9\nf 1/1 2/2 3\nf 1/1 2/2 9/3\nf 1/1/1 2/2/1 3/3/1\n";
  EXPECT_EQ(read(corners + faces).mesh.triangles.size(), 1u);
  EXPECT_TRUE(read("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").mesh.triangles.empty());
}

TEST_F(TexturedFile, MayBeAGroupOfIt) {
  const std::string two =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\ng skin\nf 1/1 2/2 3/3\ng hair\nf 1/2 2/3 3/1\n";
  const TexturedMesh skin = read(two, {.group = "skin"});
  ASSERT_EQ(skin.mesh.triangles.size(), 1u);
  EXPECT_EQ(skin.places[skin.mesh.triangles[0][0]], TexturePlace(0, 0));
}

/// The skin is worth more than its picture.
TEST_F(TexturedFile, LosesATriangleWhosePlaceInThePictureIsNone) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt a 0\n";
  EXPECT_TRUE(read(corners + "f 1/0 2/1 3/1\n").mesh.triangles.empty());
  EXPECT_TRUE(read(corners + "f 1/2 2/1 3/1\n").mesh.triangles.empty());
  EXPECT_EQ(read(corners + "f 1/1 2/1 3/1\n").mesh.triangles.size(), 1u);
}

TEST_F(TexturedFile, OfAnotherFormatHasNone) {
  EXPECT_TRUE(loadTextured(write("x.stl", support::binaryStlBytes(zoo::cube()))).mesh.triangles.empty());
  EXPECT_TRUE(loadTextured(write("x.glb", support::glbBytes(zoo::cube()))).mesh.triangles.empty());
  EXPECT_TRUE(basePictureOf(write("x.glb", support::glbBytes(zoo::cube()))).empty());
}

// --- glTF ---

std::string floats(const std::vector<float>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)};
}

/// One triangle in metres with two sets of texture coordinates, `more` at the end of its JSON and `picture` behind its
/// floats.
std::string gltfTriangle(const std::string& primitive, const std::string& more, const std::string& picture = "") {
  const std::string numbers =
      floats({0, 0, 0, 1, 0, 0, 0, 1, 0}) + floats({0, 0, 1, 0, 0, 1}) + floats({.5f, .5f, .75f, .5f, .5f, .75f});
  const std::string json = R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2})" +
                           primitive +
                           R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                           R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},)"
                           R"({"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}],"bufferViews":[)"
                           R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},)"
                           R"({"buffer":0,"byteOffset":60,"byteLength":24},{"buffer":0,"byteOffset":84,"byteLength":)" +
                           std::to_string(picture.size()) + R"(}],"buffers":[{"byteLength":)" +
                           std::to_string(numbers.size() + picture.size()) + "}]" + more + "}";
  return support::glbAround(json, numbers + picture);
}

const std::string kMaterial = R"(,"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}}])"
                              R"(,"textures":[{"source":0}])";

TEST_F(TexturedFile, OfGltfCountsUpwards) {
  const TexturedMesh textured = loadTextured(write("x.glb", gltfTriangle("", "")));
  ASSERT_EQ(textured.mesh.triangles.size(), 1u);
  EXPECT_EQ(textured.mesh.positions[1], Vec3(1000, 0, 0));
  EXPECT_EQ(textured.places[0], TexturePlace(0, 1));
  EXPECT_EQ(textured.places[2], TexturePlace(0, 0));
}

TEST_F(TexturedFile, OfGltfFollowsItsBaseColour) {
  const auto file =
      write("x.glb", gltfTriangle(R"(,"material":0)", kMaterial + R"(,"images":[{"bufferView":3}])", "bytes"));
  EXPECT_EQ(loadTextured(file).places[1], TexturePlace(0.75f, 0.5f));
  EXPECT_EQ(basePictureOf(file), "bytes");
}

TEST_F(TexturedFile, OfGltfMayHaveItsPictureInTheTextOrBeside) {
  const auto with = [&](const std::string& uri) {
    return write("x.glb", gltfTriangle(R"(,"material":0)", kMaterial + R"(,"images":[{"uri":")" + uri + R"("}])"));
  };
  EXPECT_EQ(basePictureOf(with("data:image/png;base64," + support::base64("bytes"))), "bytes");
  write("skin.png", "beside");
  EXPECT_EQ(basePictureOf(with("skin.png")), "beside");
  EXPECT_NE(thrownMessage([&] { basePictureOf(with("../skin.png")); }).find("same folder"), std::string::npos);
}

TEST_F(TexturedFile, OfGltfSaysWhatIsWrong) {
  const auto refusal = [&](const std::string& more) {
    return thrownMessage([&] { basePictureOf(write("x.glb", gltfTriangle(R"(,"material":0)", more))); });
  };
  EXPECT_NE(refusal("").find("material"), std::string::npos);
  EXPECT_NE(refusal(kMaterial).find("image"), std::string::npos);
  EXPECT_NE(refusal(kMaterial + R"(,"images":[{}])").find("uri or bufferView"), std::string::npos);
}

}  // namespace
}  // namespace palpate::mesh
