// FCL: a hierarchy of OBBs and rectangle swept spheres. It knows neither points nor segments: the nearest point is the
// distance to a sphere of no size, a segment a capsule too thin to matter, the triangles in a box all contacts of a
// box.
//
// Based on: Pan, Chitta, Manocha, "FCL: a general purpose library for collision and proximity queries" (2012).

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <Eigen/Geometry>

#include <limits>
#include <memory>

#include "lab/peers/timed_answers.h"

namespace palpate::bench {

namespace {

using Model = fcl::BVHModel<fcl::OBBRSS<double>>;
using Place = fcl::Transform3<double>;
/// Radius of the capsule that replaces a segment, as a share of its length.
constexpr double kThinness = 1e-6;

std::unique_ptr<Model> buildModel(const mesh::TriangleMesh& mesh) {
  auto model = std::make_unique<Model>();
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) triangles.emplace_back(a, b, c);
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(mesh.positions.size()));
  model->addSubModel(mesh.positions, triangles);
  model->endModel();
  return model;
}

Place at(const Vec3& centre) {
  Place place = Place::Identity();
  place.translation() = centre;
  return place;
}

double nearest(const Model& model, const Vec3& point, double reach) {
  const fcl::Sphere<double> sphere(0.0);
  fcl::DistanceRequest<double> request;
  fcl::DistanceResult<double> result;
  const double distance = fcl::distance(&sphere, at(point), &model, Place::Identity(), request, result);
  return distance < reach ? distance : std::numeric_limits<double>::infinity();
}

bool crosses(const Model& model, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double length = way.norm();
  if (length == 0.0) return false;
  const fcl::Capsule<double> capsule(kThinness * length, length);
  Place place = at(0.5 * (from + to));
  place.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), way).toRotationMatrix();
  fcl::CollisionRequest<double> request;
  fcl::CollisionResult<double> result;
  return fcl::collide(&capsule, place, &model, Place::Identity(), request, result) > 0;
}

PeerRun<ContactAnswer> answerContact(const mesh::TriangleMesh& mesh, std::span<const ContactQuery> queries,
                                     double seconds) {
  PeerRun<ContactAnswer> run;
  const auto model = timedBuild(mesh.triangles.size(), run, [&] { return buildModel(mesh); });
  timeContactAnswers(
      queries, seconds, run, [&](const ContactQuery& q) { return nearest(*model, q.point, q.reach); },
      [&](const ContactQuery& q) { return crosses(*model, q.from, q.to); });
  return run;
}

PeerRun<BoxAnswer> answerBoxes(const mesh::TriangleMesh& mesh, std::span<const Box3> boxes, double seconds) {
  PeerRun<BoxAnswer> run;
  const auto model = timedBuild(mesh.triangles.size(), run, [&] { return buildModel(mesh); });
  fcl::CollisionRequest<double> request(mesh.triangles.size());
  fcl::CollisionResult<double> result;
  const auto ask = [&](std::size_t i) {
    result.clear();
    const fcl::Box<double> box(boxes[i].sizes());
    fcl::collide(&box, at(boxes[i].center()), model.get(), Place::Identity(), request, result);
  };
  std::vector<Index> triangles;
  timeAnswers(boxes.size(), seconds, run, ask, [&](std::size_t) {
    triangles.clear();
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
      // Which side the mesh is on is FCL's choice; the other side says NONE, -1.
      triangles.push_back(static_cast<Index>(std::max(result.getContact(k).b1, result.getContact(k).b2)));
    }
    return summariseTriangles(triangles);
  });
  return run;
}

/// A sphere for each pad; the first contact is enough.
PeerRun<ToolAnswer> answerTool(const mesh::TriangleMesh& mesh, const ToolQueries& queries, double seconds) {
  PeerRun<ToolAnswer> run;
  const auto model = timedBuild(mesh.triangles.size(), run, [&] { return buildModel(mesh); });
  std::vector<fcl::Sphere<double>> spheres;
  for (const contact::Pad& pad : queries.shape.pads) spheres.emplace_back(pad.radius_mm);
  ToolAnswer answer;
  const auto ask = [&](std::size_t tick) {
    answer = {};
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const Place place = at(queries.centreOf(queries.shape.pads[i], tick));
      fcl::CollisionRequest<double> request;
      fcl::CollisionResult<double> result;
      answer.touching += fcl::collide(&spheres[i], place, model.get(), Place::Identity(), request, result) > 0 ? 1 : 0;
    }
  };
  timeAnswers(queries.ticks(), seconds, run, ask, [&](std::size_t) { return answer; });
  return run;
}

}  // namespace

ToolPeer fclToolPeer() { return {"fcl", "libfcl-dev", answerTool}; }

Peer fclPeer() { return {"fcl", "libfcl-dev", answerContact, answerBoxes, BoxTest::triangle}; }

}  // namespace palpate::bench
