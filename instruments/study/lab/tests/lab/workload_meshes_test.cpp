#include "lab/workloads/workload_meshes.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lab/tests/lab/sha256.h"
#include "palpate/base/error.h"

namespace palpate::lab {
namespace {

using test::Published;

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

/// The normal that the reference files hold: all arithmetic in float, in the order of numpy.cross and
/// numpy.linalg.norm.
Vec3f storedNormal(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f u = b - a, v = c - a;
  const Vec3f n(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x());
  const float length = std::sqrt(n.x() * n.x() + n.y() * n.y() + n.z() * n.z());
  return length > 0.0f ? Vec3f(n / length) : n;
}

/// A binary STL file exactly as the reference script writes it.
std::string referenceStl(const mesh::TriangleMesh& mesh) {
  std::string bytes = "palpation bench mesh (mm)";
  bytes.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(bytes, &count, sizeof count);
  bytes.reserve(bytes.size() + 50 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    std::array<Vec3f, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = mesh.positions[t[i]].cast<float>();
    const Vec3f n = storedNormal(p[0], p[1], p[2]);
    append(bytes, n.data(), 12);
    for (const Vec3f& q : p) append(bytes, q.data(), 12);
    bytes.append(2, '\0');
  }
  return bytes;
}

/// Check sums of the binary STL files that an independent generator in NumPy writes.
const Published kPublished[] = {{"back_2962", "c5b8b67924fd11e57307e868b95d7c9f874be81e3cf2f5caaf8cb5217504fd0f"},
                                {"back_6261", "dd9f86775062e0c99fe04a9d8cd86886352a47d83e2dc8b6d312c7635fc9845c"},
                                {"back_8163", "cecd80c626c11b875629b041fa5d9b187f270a534caa289f1b70fa36700bac41"},
                                {"back_20389", "8d8ba8a8216ef7503a14f43bba6e3f558d5eeb75f0fb1de2d199cb5bf8e746db"},
                                {"back_41582", "105b3c5fa56bfb639d3507ab5aeb9ff50d23f0313de275c6012252cf7eda7246"},
                                {"eggcrate", "370edfff5b652a66c88f6b2cf409f2af7118a79b206ab0a6a6a1b1826b79c81d"},
                                {"flat100", "5d25071f9468c3bd5786a47eb6cf396df5bce2722f5febb671f74ef331499db0"},
                                {"groove60", "ab9bc21d6d4b72ac1a551efea11f51defb22c58cdac3b96c818cdd0865345851"},
                                {"groove90", "016b1775142f898aa75e680d53a084000ab7dac54e3e453550354d532f05075b"},
                                {"groove120", "71599bf11715e8aebba1d9ce4726d75fb9222c708b0d08863b0c553380e75d90"},
                                {"pit", "5e16189fe15406ce1aba7eec1ec4ef7a843bc5b0f1735a92d96da7172e00cd1b"}};

const Published kLargePublished[] = {
    {"back_200000", "f3a3246db9e30a7bcbcbe83623866d94530ea07ce82acd1dfcdc1d6198919a5a"},
    {"back_1000000", "dcbbbb4f91dcfd1f00a52bb21ba6b5c48180eec1b4b1f093dc8f68a1f5ae8acb"},
    {"back_4000000", "59ef62c3a0b6e8de1623c0e2782ffc1739159434dcb1246559193d287dc8be7d"}};

class PublishedMesh : public testing::TestWithParam<Published> {};

TEST_P(PublishedMesh, IsGeneratedByteForByte) {
  EXPECT_EQ(test::sha256(referenceStl(lab::workloadMesh(GetParam().name))), GetParam().sha256);
}

INSTANTIATE_TEST_SUITE_P(All, PublishedMesh, testing::ValuesIn(kPublished),
                         [](const auto& published) { return published.param.name; });
INSTANTIATE_TEST_SUITE_P(Large, PublishedMesh, testing::ValuesIn(kLargePublished),
                         [](const auto& published) { return published.param.name; });

TEST(Sha256, GivesThePublishedDigests) {  // FIPS 180-4 examples
  EXPECT_EQ(test::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(test::sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Sheet, HasExactlyTheAskedCountForAnyCount) {
  for (std::size_t triangles = 8; triangles < 400; ++triangles) {
    EXPECT_EQ(lab::backMesh(triangles).triangles.size(), triangles);
  }
}

TEST(WorkloadMesh, RefusesUnknownNames) {
  for (const char* name : {"", "back_", "back_x", "back_7", "back_1.5", "groove45", "bunny"}) {
    EXPECT_THROW(lab::workloadMesh(name), Error) << name;
  }
}

}  // namespace
}  // namespace palpate::lab
