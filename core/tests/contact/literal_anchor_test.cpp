#include "palpate/contact/friction.h"

#include <gtest/gtest.h>

#include "support/golden.h"

namespace palpate::contact {

using test::vec3;

TEST(LiteralAnchor, LiesOnTheNormalAsInTheReference) {
  for (const auto& c : test::goldenRows("friction_anchor", "cases")) {
    const Vec3 expected = vec3(c.contains("printed_2_6_as_vector") ? c["printed_2_6_as_vector"] : c["expected_A"]);
    const Vec3 anchor = literalAnchorOfForce(vec3(c["P"]), vec3(c["D"]), vec3(c["n"]), vec3(c["F"]));
    EXPECT_LT((anchor - expected).norm(), 1e-9) << c;
  }
}

}  // namespace palpate::contact
