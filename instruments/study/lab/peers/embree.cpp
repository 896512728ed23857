// Embree 3: point query for the nearest point, ray intersection for the segment, point query with the sphere around a
// box and an exact test for the triangles in it. Single precision, its default build quality, one thread.
//
// Its point query finds boxes; the distance to a triangle is the caller's, here the textbook's in floats.
// Based on: Wald et al., "Embree: a kernel framework for efficient CPU ray tracing" (2014); Ericson, "Real-Time
// Collision Detection" (2005), 5.1.5; Akenine-Moeller, "Fast 3D triangle-box overlap testing" (2001).

#include <embree3/rtcore.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

#include "lab/literal/triangle_tests.h"
#include "lab/peers/timed_answers.h"
#include "palpate/base/error.h"

namespace palpate::bench {

namespace {

using Vec3f = Eigen::Vector3f;

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

struct Model {
  std::unique_ptr<std::atomic<std::int64_t>> bytes = std::make_unique<std::atomic<std::int64_t>>(0);
  std::unique_ptr<RTCDeviceTy, ReleaseDevice> device;
  std::unique_ptr<RTCSceneTy, ReleaseScene> scene;
  std::vector<Vec3f> positions;
  std::vector<std::array<unsigned, 3>> triangles;
};

bool countBytes(void* bytes, ssize_t change, bool) {
  *static_cast<std::atomic<std::int64_t>*>(bytes) += change;
  return true;
}

void addTriangles(Model& model) {
  RTCGeometry geometry = rtcNewGeometry(model.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                sizeof(Vec3f), model.positions.size()));
  for (const Vec3f& p : model.positions) {
    for (int axis = 0; axis < 3; ++axis) *positions++ = p[axis];
  }
  auto* corners = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), model.triangles.size()));
  for (const auto& triangle : model.triangles) corners = std::copy(triangle.begin(), triangle.end(), corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(model.scene.get(), geometry);
  rtcReleaseGeometry(geometry);
}

Model buildModel(const mesh::TriangleMesh& mesh) {
  Model model;
  model.device.reset(rtcNewDevice("threads=1"));
  if (!model.device) throw Error("Embree does not start on this processor");
  rtcSetDeviceMemoryMonitorFunction(model.device.get(), countBytes, model.bytes.get());
  for (const Vec3& p : mesh.positions) model.positions.push_back(p.cast<float>());
  for (const auto& [a, b, c] : mesh.triangles) model.triangles.push_back({a, b, c});
  model.scene.reset(rtcNewScene(model.device.get()));
  addTriangles(model);
  rtcCommitScene(model.scene.get());
  return model;
}

template <class Answer>
Model timedModel(const mesh::TriangleMesh& mesh, PeerRun<Answer>& run) {
  Model model = timedBuild(mesh.triangles.size(), run, [&] { return buildModel(mesh); });
  run.bytes_per_triangle = static_cast<double>(model.bytes->load()) / static_cast<double>(mesh.triangles.size());
  return model;
}

struct Nearest {
  const Model* model;
  float squared;
};

bool tryNearest(RTCPointQueryFunctionArguments* call) {
  auto& best = *static_cast<Nearest*>(call->userPtr);
  const auto& [a, b, c] = best.model->triangles[call->primID];
  const auto& positions = best.model->positions;
  const Vec3f point(call->query->x, call->query->y, call->query->z);
  const float squared = squaredDistance<float>(point, positions[a], positions[b], positions[c]);
  if (!(squared < best.squared)) return false;
  best.squared = squared;
  call->query->radius = std::sqrt(squared);
  return true;
}

double nearest(const Model& model, const Vec3& point, double reach) {
  RTCPointQuery query{};
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.radius = static_cast<float>(reach);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const float limit = query.radius * query.radius;
  Nearest best{&model, limit};
  rtcPointQuery(model.scene.get(), &query, &context, tryNearest, &best);
  return best.squared < limit ? std::sqrt(static_cast<double>(best.squared)) : std::numeric_limits<double>::infinity();
}

bool crosses(const Model& model, const Vec3& from, const Vec3& to) {
  const Vec3f origin = from.cast<float>(), way = (to - from).cast<float>();
  RTCRayHit hit{};
  hit.ray.org_x = origin.x();
  hit.ray.org_y = origin.y();
  hit.ray.org_z = origin.z();
  hit.ray.dir_x = way.x();
  hit.ray.dir_y = way.y();
  hit.ray.dir_z = way.z();
  hit.ray.tfar = 1.0f;
  hit.ray.mask = ~0u;
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(model.scene.get(), &context, &hit);
  return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

/// `bounded`: the point query gets the finger's known bound, instead of its whole reach.
template <bool bounded>
PeerRun<ContactAnswer> answerContact(const mesh::TriangleMesh& mesh, std::span<const ContactQuery> queries,
                                     double seconds) {
  PeerRun<ContactAnswer> run;
  const Model model = timedModel(mesh, run);
  timeContactAnswers(
      queries, seconds, run,
      [&](const ContactQuery& q) { return nearest(model, q.point, bounded ? q.bound : q.reach); },
      [&](const ContactQuery& q) { return crosses(model, q.from, q.to); });
  return run;
}

struct InBox {
  const Model* model;
  Vec3f centre, half;
  std::vector<Index>* found;
};

bool tryBox(RTCPointQueryFunctionArguments* call) {
  const auto& box = *static_cast<const InBox*>(call->userPtr);
  const auto& [a, b, c] = box.model->triangles[call->primID];
  const auto& p = box.model->positions;
  if (triangleMeetsBox<float>({p[a] - box.centre, p[b] - box.centre, p[c] - box.centre}, box.half)) {
    box.found->push_back(call->primID);
  }
  return false;
}

PeerRun<BoxAnswer> answerBoxes(const mesh::TriangleMesh& mesh, std::span<const Box3> boxes, double seconds) {
  PeerRun<BoxAnswer> run;
  const Model model = timedModel(mesh, run);
  std::vector<Index> found;
  found.reserve(mesh.triangles.size());
  const auto ask = [&](std::size_t i) {
    found.clear();
    InBox box{&model, boxes[i].center().cast<float>(), (0.5 * boxes[i].sizes()).cast<float>(), &found};
    RTCPointQuery query{};
    query.x = box.centre.x();
    query.y = box.centre.y();
    query.z = box.centre.z();
    query.radius = box.half.norm();
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(model.scene.get(), &query, &context, tryBox, &box);
  };
  timeAnswers(boxes.size(), seconds, run, ask, [&](std::size_t) { return summariseTriangles(found); });
  return run;
}

}  // namespace

Peer embreePeer() { return {"embree", "libembree-dev", answerContact<false>, answerBoxes, BoxTest::triangle}; }

Peer embreeBoundedPeer() { return {"embree_told", "libembree-dev", answerContact<true>, nullptr, BoxTest::triangle}; }

}  // namespace palpate::bench
