// CGAL's AABB tree: closest point with the last answer as hint, any crossing of the segment (not the first: its first
// one is for rays only), all triangles that a box meets. Simple cartesian kernel of doubles, no exact arithmetic.
//
// The package is under the GPL, which is why this file is part of the program palpate_peers and of no other.
// Based on: Alliez, Tayeb, Wormser, "3D fast intersection and distance computation", CGAL 5.5.

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

#include "lab/peers/timed_answers.h"

namespace palpate::bench {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point toPoint(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

struct Model {
  Triangles triangles;
  Tree tree;
};

std::unique_ptr<Model> buildModel(const mesh::TriangleMesh& mesh) {
  auto model = std::make_unique<Model>();
  model->triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    model->triangles.emplace_back(toPoint(mesh.positions[a]), toPoint(mesh.positions[b]), toPoint(mesh.positions[c]));
  }
  model->tree.insert(model->triangles.cbegin(), model->triangles.cend());
  model->tree.do_not_accelerate_distance_queries();  // the hint takes the place of its tree of points
  model->tree.build();
  return model;
}

PeerRun<ContactAnswer> answerContact(const mesh::TriangleMesh& mesh, std::span<const ContactQuery> queries,
                                     double seconds) {
  PeerRun<ContactAnswer> run;
  const auto model = timedBuild(mesh.triangles.size(), run, [&] { return buildModel(mesh); });
  Tree::Point_and_primitive_id hint{model->triangles.front()[0], model->triangles.cbegin()};
  const auto nearest = [&](const ContactQuery& q) {
    const Point point = toPoint(q.point);
    hint = model->tree.closest_point_and_primitive(point, hint);
    const double distance = std::sqrt(CGAL::squared_distance(point, hint.first));
    return distance < q.reach ? distance : std::numeric_limits<double>::infinity();
  };
  timeContactAnswers(queries, seconds, run, nearest, [&](const ContactQuery& q) {
    return model->tree.do_intersect(Kernel::Segment_3(toPoint(q.from), toPoint(q.to)));
  });
  return run;
}

PeerRun<BoxAnswer> answerBoxes(const mesh::TriangleMesh& mesh, std::span<const Box3> boxes, double seconds) {
  PeerRun<BoxAnswer> run;
  const auto model = timedBuild(mesh.triangles.size(), run, [&] { return buildModel(mesh); });
  std::vector<Triangles::const_iterator> found;
  found.reserve(mesh.triangles.size());
  const auto ask = [&](std::size_t i) {
    found.clear();
    const Kernel::Iso_cuboid_3 box(toPoint(boxes[i].min()), toPoint(boxes[i].max()));
    model->tree.all_intersected_primitives(box, std::back_inserter(found));
  };
  std::vector<Index> triangles;
  timeAnswers(boxes.size(), seconds, run, ask, [&](std::size_t) {
    triangles.clear();
    for (const auto& place : found) triangles.push_back(static_cast<Index>(place - model->triangles.cbegin()));
    return summariseTriangles(triangles);
  });
  return run;
}

}  // namespace

Peer cgalPeer() { return {"cgal", "libcgal-dev", answerContact, answerBoxes, BoxTest::triangle}; }

}  // namespace palpate::bench
