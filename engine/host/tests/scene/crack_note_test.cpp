// What the load says of cracks that a finger cannot enter.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "palpate/scene/body_parts.h"
#include "support/mesh_zoo.h"

namespace palpate::scene {
namespace {

std::shared_ptr<const Body> bodyOfBoxes(double gap_mm) {
  const mesh::TriangleMesh boxes = zoo::joined(zoo::cube(60.0, {0, 0, 0}), zoo::cube(60.0, {60.0 + gap_mm, 0, 0}));
  std::vector<Index> source_vertex;
  return builtBody(mendedBody(boxes, "boxes", {}, source_vertex), {}, {});
}

std::size_t notesOfCracks(const Body& body, const std::string& count) {
  return static_cast<std::size_t>(std::ranges::count_if(body.notes, [&](const std::string& note) {
    return note.starts_with("cracks narrower than 0.25 mm: " + count + ", the largest at (60.");
  }));
}

TEST(CrackNote, SaysHowManyThereAreAndWhere) {
  EXPECT_EQ(notesOfCracks(*bodyOfBoxes(0.1), "1"), 1u);
  EXPECT_EQ(notesOfCracks(*bodyOfBoxes(0.5), "1"), 0u) << "a gap that a point enters";
}

}  // namespace
}  // namespace palpate::scene
