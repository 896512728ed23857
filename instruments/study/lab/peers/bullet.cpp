// Bullet: a tree of quantised boxes over the triangles, and for each part of a tool one compound of spheres that is
// laid against it. It returns points of contact; only whether there is one matters here.
//
// Based on: Coumans, "Bullet physics simulation", SIGGRAPH courses 2015. Coordinates are floats, as Debian builds it.

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "lab/peers/timed_answers.h"

namespace palpate::bench {

namespace {

btVector3 toBtVector(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btTransform toTransform(const contact::ToolPose& pose) {
  btMatrix3x3 turn;
  for (int row = 0; row < 3; ++row) turn[row] = toBtVector(pose.rotation.row(row));
  return btTransform(turn, toBtVector(pose.position));
}

/// The skin, alone in a world of its own.
class Skin {
 public:
  explicit Skin(const mesh::TriangleMesh& mesh) : world_(&dispatcher_, &broadphase_, &configuration_) {
    for (const Vec3& position : mesh.positions) corners_.push_back(toBtVector(position));
    for (const auto& triangle : mesh.triangles) {
      for (const Index corner : triangle) indices_.push_back(static_cast<int>(corner));
    }
    triangles_ = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.triangles.size()), indices_.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(corners_.size()), corners_[0].m_floats, static_cast<int>(sizeof(btVector3)));
    constexpr bool kQuantised = true;
    shape_ = std::make_unique<btBvhTriangleMeshShape>(triangles_.get(), kQuantised);
    shape_->setMargin(0);
    object.setCollisionShape(shape_.get());
    world_.addCollisionObject(&object);
  }
  ~Skin() { world_.removeCollisionObject(&object); }
  Skin(const Skin&) = delete;
  Skin& operator=(const Skin&) = delete;

  void meet(btCollisionObject& part, btCollisionWorld::ContactResultCallback& contacts) {
    world_.contactPairTest(&part, &object, contacts);
  }

  btCollisionObject object;

 private:
  std::vector<btVector3> corners_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> triangles_;
  std::unique_ptr<btBvhTriangleMeshShape> shape_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_;
};

/// A part of a tool: its pads as one rigid thing.
struct Part {
  btCompoundShape shape;
  std::vector<std::unique_ptr<btSphereShape>> spheres;
  btCollisionObject object;
  std::vector<char> touches;  ///< one per pad
};

std::vector<std::unique_ptr<Part>> makeParts(const contact::ToolShape& tool) {
  std::vector<std::unique_ptr<Part>> parts;
  for (std::size_t i = 0; i < tool.rest.size(); ++i) parts.push_back(std::make_unique<Part>());
  for (const contact::Pad& pad : tool.pads) {
    Part& part = *parts[pad.part];
    part.spheres.push_back(std::make_unique<btSphereShape>(static_cast<btScalar>(pad.radius_mm)));
    part.shape.addChildShape(btTransform(btMatrix3x3::getIdentity(), toBtVector(pad.offset)),
                             part.spheres.back().get());
    part.touches.push_back(0);
  }
  for (const auto& part : parts) part->object.setCollisionShape(&part->shape);
  return parts;
}

/// Pads of a part with points of contact.
struct Touching : btCollisionWorld::ContactResultCallback {
  Touching(const btCollisionObject& skin_object, std::vector<char>& pads) : skin(skin_object), touches(pads) {}

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* one, int /*part*/, int one_index,
                           const btCollisionObjectWrapper* /*other*/, int /*part*/, int other_index) override {
    const int pad = one->getCollisionObject() == &skin ? other_index : one_index;
    if (point.getDistance() <= 0) touches[static_cast<std::size_t>(pad)] = 1;
    return 0;
  }

  const btCollisionObject& skin;
  std::vector<char>& touches;
};

PeerRun<ToolAnswer> answerTool(const mesh::TriangleMesh& mesh, const ToolQueries& queries, double seconds) {
  PeerRun<ToolAnswer> run;
  const auto skin = timedBuild(mesh.triangles.size(), run, [&] { return std::make_unique<Skin>(mesh); });
  const std::vector<std::unique_ptr<Part>> parts = makeParts(queries.shape);
  ToolAnswer answer;
  const auto ask = [&](std::size_t tick) {
    answer = {};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      Part& part = *parts[i];
      std::fill(part.touches.begin(), part.touches.end(), char{0});
      part.object.setWorldTransform(toTransform(queries.at(tick)[i]));
      Touching contacts(skin->object, part.touches);
      skin->meet(part.object, contacts);
      answer.touching += static_cast<std::size_t>(std::count(part.touches.begin(), part.touches.end(), char{1}));
    }
  };
  timeAnswers(queries.ticks(), seconds, run, ask, [&](std::size_t) { return answer; });
  return run;
}

}  // namespace

ToolPeer bulletToolPeer() { return {"bullet", "libbullet-dev", answerTool}; }

}  // namespace palpate::bench
