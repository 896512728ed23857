// What a Deformer promises whatever the forms and whichever way it displaces: the fast one, and the general one in
// every form.
#include <gtest/gtest.h>

#include <cmath>

#include "core/tests/deform/stage.h"
#include "support/counted.h"

namespace palpate::deform {

using test::anyFormedContact;
using test::bits;
using test::drag;
using test::press;
using test::Stage;

struct Specimen {
  FormSettings forms;
  Way way = Way::general;
  int rounds = 10;
};

/// The general way is slow: it gets fewer rounds in each form.
std::vector<Specimen> everyWay() {
  std::vector<Specimen> all;
  for (const Normals normals : {Normals::analytic, Normals::recomputed}) {
    FormSettings fast;
    fast.common.normals = normals;
    fast.common.strain = true;
    all.push_back({fast, Way::chosen, 30});
  }
  for (const FormSettings& forms : test::manyForms()) all.push_back({forms});
  return all;
}

TEST(EveryWay, RestComesBackBitByBit) {
  for (const auto& [forms, way, rounds] : everyWay()) {
    Stage stage(test::torso(), forms, way);
    const auto rest = bits(stage.surface);
    Random random(7);
    for (int i = 0; i < rounds; ++i) {
      stage.apply({anyFormedContact(stage.mesh, random), anyFormedContact(stage.mesh, random)});
      EXPECT_NE(bits(stage.surface), rest);
      stage.apply({});
      ASSERT_EQ(bits(stage.surface), rest);
    }
  }
}

TEST(EveryWay, ResultDoesNotDependOnWhatWasBefore) {
  for (const auto& [forms, way, rounds] : everyWay()) {
    Stage used(test::torso(), forms, way);
    Stage fresh(test::torso(), forms, way);
    Random random(13);
    const auto any = [&] { return anyFormedContact(used.mesh, random); };
    for (int i = 0; i < rounds; ++i) {
      used.apply({any(), any(), any()});
      const std::vector<Contact> contacts{any(), any()};
      used.apply(contacts);
      fresh.apply({});
      fresh.apply(contacts);
      ASSERT_EQ(bits(used.surface), bits(fresh.surface));
    }
  }
}

// Double buffering: two surfaces take turns.
TEST(EveryWay, ServesSeveralSurfaces) {
  for (const auto& [forms, way, rounds] : everyWay()) {
    Stage stage(test::torso(), forms, way);
    DeformedSurface other(stage.skin);
    Stage judge(test::torso(), forms, way);
    Random random(5);
    for (int i = 0; i < rounds; ++i) {
      const Contact contact = anyFormedContact(stage.mesh, random);
      DeformedSurface& turn = i % 2 == 0 ? stage.surface : other;
      stage.deformer.apply({&contact, 1}, turn);
      judge.apply({contact});
      ASSERT_EQ(bits(turn), bits(judge.surface));
    }
  }
}

TEST(EveryWay, ChangedRangesNameEverythingThatChanged) {
  for (const auto& [forms, way, rounds] : everyWay()) {
    Stage stage(lab::backMesh(8163), forms, way);
    Random random(31);
    auto before = bits(stage.surface);
    for (int i = 0; i < rounds; ++i) {
      stage.apply({anyFormedContact(stage.mesh, random)});
      std::vector<bool> named(stage.skin.vertices, false);
      Index last = 0;
      for (const auto [first, end] : stage.surface.changed()) {
        EXPECT_TRUE(last == 0 || first > last) << "ranges must ascend and not touch";
        for (Index v = first; v < end; ++v) named[v] = true;
        last = end;
      }
      const auto after = bits(stage.surface);
      for (std::size_t k = 0; k < after.size(); ++k) {
        if (after[k] != before[k]) {
          ASSERT_TRUE(named[k % stage.skin.vertices]);
        }
      }
      before = after;
    }
  }
}

TEST(EveryWay, AppliesWithoutAllocating) {
  for (const auto& [forms, way, rounds] : everyWay()) {
    Stage stage(lab::backMesh(8163), forms, way);
    Random random(3);
    std::vector<std::vector<Contact>> frames;
    for (int i = 0; i < 3 * rounds; ++i) {
      std::vector<Contact> contacts;
      for (std::uint64_t n = random.below(20); n > 0; --n) contacts.push_back(anyFormedContact(stage.mesh, random));
      frames.push_back(contacts);
    }
    support::expectNoAllocation([&] {
      for (const auto& contacts : frames) stage.apply(contacts);
    });
  }
}

TEST(EveryWay, NeverMakesANonFiniteNumber) {
  Random random(41);
  for (const auto& specimen : zoo::specimens()) {
    bool sound = true;
    for (const Triangle& t : specimen.mesh.triangles) {
      for (const Index v : t) {
        sound = sound && v < specimen.mesh.positions.size() && specimen.mesh.positions[v].allFinite();
      }
    }
    if (!sound || specimen.mesh.triangles.empty()) continue;
    for (const auto& [forms, way, rounds] : everyWay()) {
      Stage stage(specimen.mesh, forms, way);
      for (int i = 0; i < rounds; ++i) {
        stage.apply({anyFormedContact(stage.mesh, random), anyFormedContact(stage.mesh, random)});
        for (Index v = 0; v < stage.skin.vertices; ++v) {
          ASSERT_TRUE(stage.surface.positionAt(v).allFinite()) << specimen.name;
          ASSERT_TRUE(stage.surface.normalAt(v).allFinite()) << specimen.name;
          ASSERT_TRUE(std::isfinite(stage.surface.strain()[v])) << specimen.name;
        }
      }
    }
  }
}

TEST(EveryWay, EmptyMeshIsNothingToDeform) {
  for (const Way way : {Way::chosen, Way::general}) {
    Stage stage(mesh::TriangleMesh{}, {}, way);
    EXPECT_EQ(stage.apply({Contact{}}).status, kIgnoredNoTriangle);
    EXPECT_TRUE(stage.surface.changed().empty());
  }
}

TEST(EveryWay, IgnoresWhatMakesNoSenseAndSaysSo) {
  for (const Way way : {Way::chosen, Way::general}) {
    Stage stage(lab::backMesh(2962), {}, way);
    const auto rest = bits(stage.surface);
    const Contact good = press(stage.mesh, 1000, 5.0);
    const auto broken = [&](auto&& change) {
      Contact contact = drag(good, {2, 1, 0});
      change(contact);
      return stage.apply({contact}).status;
    };
    const auto ignored = [&](auto&& change) {
      const auto status = broken(change);
      EXPECT_EQ(bits(stage.surface), rest);
      return status;
    };
    EXPECT_EQ(ignored([](Contact& c) { c.anchor.x() = NAN; }), kIgnoredNotFinite);
    EXPECT_EQ(ignored([](Contact& c) { c.depth_mm = INFINITY; }), kIgnoredNotFinite);
    EXPECT_EQ(ignored([](Contact& c) { c.drag_mm.y() = NAN; }), kIgnoredNotFinite);
    EXPECT_EQ(ignored([](Contact& c) { c.normal.setZero(); }), kIgnoredNotFinite);
    EXPECT_EQ(ignored([](Contact& c) { c.tangential_region.aspect = NAN; }), kIgnoredNotFinite);
    EXPECT_EQ(ignored([](Contact& c) { c.anchor_triangle = kNoIndex; }), kIgnoredNoTriangle);
    EXPECT_EQ(ignored([](Contact& c) { c.depth_mm = -1.0, c.drag_mm.setZero(); }), 0u);
    EXPECT_EQ(ignored([](Contact& c) {
                c.normal_region.half_major.setZero();
                c.tangential_region.aspect = 0.0;
              }),
              kDegenerateRegion | kNoVertexInRegion);
    EXPECT_EQ(ignored([](Contact& c) { c.anchor.z() += 1e6, c.anchor.x() += 1e6; }), kNoVertexInRegion);
    EXPECT_EQ(broken([](Contact& c) { c.normal_region.half_major.setZero(); }), kDegenerateRegion);
    EXPECT_EQ(stage.apply(std::vector<Contact>(17, good)).status, kIgnoredOverCapacity);
  }
}

}  // namespace palpate::deform
