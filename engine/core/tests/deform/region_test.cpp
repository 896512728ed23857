#include "palpate/deform/fast_displacement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/tests/deform/scalar_reference.h"
#include "core/tests/deform/shapes.h"

namespace palpate::deform {

using test::anyContact;
using test::press;

std::vector<bool> regionByBlocks(const Skin& skin, RegionByBlocks& search, const Contact& contact) {
  const ContactLanes lanes = lanesOf(frameOf(contact, {}), 0.0, Vec3::Zero());
  std::vector<bool> inside(skin.vertices, false);
  for (const BlockPart& part : search.find(skin, lanes, skin.triangles[contact.anchor_triangle])) {
    forEachBit(part.vertices, [&](Index bit) { inside[part.block * kBlockVertices + bit] = true; });
  }
  return inside;
}

/// Vertices that float rounding may put on either side of the rim or of the silhouette.
bool isBorderline(const Skin& skin, const test::ScalarContact& contact, Index v) {
  const Vec3 p = test::restPoint(skin, v);
  const double facing = skin.restNormal(v).cast<double>().dot(contact.contact.normal.normalized());
  return std::abs(contact.normalRatio(p) - 1.0) < 1e-4 || std::abs(contact.tangentialRatio(p) - 1.0) < 1e-4 ||
         (facing != 0.0 && std::abs(facing) < 1e-5);
}

void expectSameRegions(const mesh::TriangleMesh& mesh, int contacts, std::uint64_t seed, const std::string& name) {
  const Skin skin = buildSkin(mesh);
  RegionByBlocks search(skin);
  Random random(seed);
  int compared = 0;
  for (int i = 0; i < contacts; ++i) {
    Contact contact = anyContact(mesh, random);
    // A little off the facet's normal: a cube's sides would lie exactly on the silhouette.
    contact.normal += 0.1 * random.uniform3(-1, 1);
    const auto scalar = test::scalarContact(contact);
    bool borderline = false;
    for (Index v = 0; v < skin.vertices; ++v) borderline = borderline || isBorderline(skin, scalar, v);
    if (borderline || !isUsable(contact)) continue;
    EXPECT_EQ(regionByBlocks(skin, search, contact), test::regionByRings(skin, scalar)) << name << ", contact " << i;
    ++compared;
  }
  EXPECT_GT(compared, contacts / 5) << name;
}

mesh::TriangleMesh shuffled(mesh::TriangleMesh mesh, std::uint64_t seed) {
  Random random(seed);
  std::vector<Index> place(mesh.positions.size());
  std::iota(place.begin(), place.end(), Index{0});
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random.below(i)]);
  const auto old = mesh.positions;
  for (std::size_t v = 0; v < old.size(); ++v) mesh.positions[place[v]] = old[v];
  for (Triangle& t : mesh.triangles) t = {place[t[0]], place[t[1]], place[t[2]]};
  return mesh;
}

TEST(Region, EqualsTheSearchByRingsOnASheet) { expectSameRegions(lab::backMesh(8163), 60, 1, "back"); }
TEST(Region, EqualsTheSearchByRingsOnAClosedBody) { expectSameRegions(test::torso(), 60, 2, "torso"); }
TEST(Region, EqualsTheSearchByRingsInAnyVertexOrder) {
  expectSameRegions(shuffled(test::torso(), 9), 40, 3, "shuffled torso");
}
TEST(Region, EqualsTheSearchByRingsOnWhateverMesh) {
  for (const auto& specimen : zoo::specimens()) {
    bool sound = true;
    for (const Triangle& t : specimen.mesh.triangles) {
      for (const Index v : t) sound = sound && v < specimen.mesh.positions.size();
    }
    if (sound) expectSameRegions(specimen.mesh, 30, 4, specimen.name);
  }
}

// Two sheets 5 mm apart, both facing up: only the one that is touched belongs.
TEST(Region, StopsAtGaps) {
  const auto lower = zoo::grid(20, 100.0);
  auto upper = lower;
  for (Vec3& p : upper.positions) p.z() += 5.0;
  const auto both = zoo::joined(lower, upper);
  const Skin skin = buildSkin(both);
  RegionByBlocks search(skin);
  const auto region = regionByBlocks(skin, search, press(both, 500, 8.0));
  const auto end_of_lower = region.begin() + static_cast<std::ptrdiff_t>(lower.positions.size());
  EXPECT_GT(std::count(region.begin(), end_of_lower, true), 0);
  EXPECT_EQ(std::count(end_of_lower, region.end(), true), 0);
}

// A strip of long triangles: the corners next to the anchor lie outside the ellipse, the vertices beyond them inside.
TEST(Region, LooksPastTheCornersOfTheAnchorsTriangle) {
  const mesh::TriangleMesh mesh{{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {55, 55, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  const Skin skin = buildSkin(mesh);
  RegionByBlocks search(skin);
  Contact contact = press(mesh, 0, 5.0, Vec3(0.1, 0.45, 0.45));
  contact.normal_region.half_major = Vec3(20, 0, 0);
  EXPECT_EQ(regionByBlocks(skin, search, contact), (std::vector<bool>{false, false, false, true}));
}

TEST(Region, CostsWhatItCovers) {
  const auto mesh = lab::backMesh(200000);
  const Skin skin = buildSkin(mesh);
  RegionByBlocks search(skin);
  const auto region = regionByBlocks(skin, search, press(mesh, 90000, 5.0));
  EXPECT_GT(std::count(region.begin(), region.end(), true), 500);
  EXPECT_LT(search.visitedBlocks(), skin.blocks / 10);
}

}  // namespace palpate::deform
