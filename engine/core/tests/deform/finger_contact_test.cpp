#include "palpate/deform/finger_contact.h"

#include <gtest/gtest.h>

namespace palpate::deform {

contact::FingerOutput dragging() {
  contact::FingerOutput finger{};
  finger.tip = {3, 4, -6};
  finger.proxy = {3, 4, 0};
  finger.anchor = {0, 0, 0};
  finger.normal = Vec3::UnitZ();
  finger.depth_mm = 6.0;
  finger.touch = contact::Touch::slip;
  finger.anchor_triangle = 7;
  return finger;
}

TEST(FingerContact, CentresOnTheFrictionAnchor) {
  const auto contact = contactOf(dragging(), maps::EllipseMap({}), {});
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->anchor, Vec3(0, 0, 0));
  EXPECT_EQ(contact->anchor_triangle, 7u);
  EXPECT_EQ(contact->drag_mm, Vec3(3, 4, 0));
  EXPECT_EQ(contact->depth_mm, 6.0);
  EXPECT_NEAR(contact->normal_region.half_major.norm(), 13.2 + 6 * 1.22, 1e-12);
  EXPECT_NEAR(contact->tangential_region.half_major.norm(), 150.0, 1e-9);
}

TEST(FingerContact, FreeFingerTouchesNothing) {
  auto finger = dragging();
  finger.touch = contact::Touch::free;
  EXPECT_FALSE(contactOf(finger, maps::EllipseMap({}), {}));
}

}  // namespace palpate::deform
