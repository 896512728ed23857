// The kernels give the same surface on every instruction set that this machine has.
#include "palpate/deform/kernels/kernels.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "core/tests/deform/shapes.h"

namespace palpate::deform {

/// Lets the kernels be chosen again among the given targets; all of the machine's when it goes out of scope.
class OnlyTargets {
 public:
  explicit OnlyTargets(std::int64_t targets) { choose(targets); }
  ~OnlyTargets() { choose(0); }

 private:
  static void choose(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

TEST(Kernels, EveryInstructionSetAgrees) {
  const auto mesh = test::torso();
  const Skin skin = buildSkin(mesh);
  Random random(77);
  std::vector<std::vector<Contact>> frames;
  for (int i = 0; i < 20; ++i) frames.push_back({test::anyContact(mesh, random), test::anyContact(mesh, random)});
  frames.push_back({frames[0][0]});
  std::vector<DeformedSurface> expected;
  for (const auto& contacts : frames) expected.push_back(deformed(mesh, contacts));

  int compared = 0;
  const std::int64_t all = hwy::SupportedTargets();
  for (std::int64_t left = all; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    const OnlyTargets only(target);
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto surface = deformed(mesh, frames[i]);
      for (Index v = 0; v < skin.vertices; ++v) {
        ASSERT_LT((surface.positionAt(v) - expected[i].positionAt(v)).norm(), 1e-4f) << hwy::TargetName(target);
        ASSERT_LT((surface.normalAt(v) - expected[i].normalAt(v)).norm(), 1e-3f) << hwy::TargetName(target);
      }
    }
    ++compared;
  }
  EXPECT_GE(compared, 1);
}

}  // namespace palpate::deform
