// Skin, forms and contacts that went over a wire as bytes deform as those that did not; and bytes of anybody harm
// nobody.
#include "palpate/engine/contact_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "palpate/base/byte_wire.h"
#include "palpate/base/error.h"
#include "palpate/deform/deformer.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/scene_file.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"
#include "support/counted.h"

namespace palpate::engine {
namespace {

constexpr const char* kTwoFingers = R"(
[[finger]]
name = "index"
at = "T6"
radius_mm = 8
script = [{ do = "press", depth_mm = 6, seconds = 0.3 }, { do = "drag", by_mm = [9, 14], seconds = 0.3 }]
[[finger]]
name = "middle"
at = "T8 right 32 mm"
script = [{ do = "press", depth_mm = 5, seconds = 0.2 }, { do = "drag", by_mm = [-8, 5], seconds = 0.2 }, { do = "lift", height_mm = 10, seconds = 0.2 }]
)";

std::shared_ptr<const scene::World> bodyWith(const std::string& more) {
  return scene::build(scene::parse("[body]\ntriangles = 20000\n" + more + kTwoFingers, "stream.toml"));
}

bool sameFloats(std::span<const float> a, std::span<const float> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

void expectSameSurface(const deform::DeformedSurface& a, const deform::DeformedSurface& b) {
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_TRUE(sameFloats(a.position(axis), b.position(axis))) << axis;
    ASSERT_TRUE(sameFloats(a.normal(axis), b.normal(axis))) << axis;
  }
  ASSERT_TRUE(sameFloats(a.strain(), b.strain()));
}

/// Runs the scene; every 50 ms the surface of the direct way and that of the bytes are compared. Returns the most bytes
/// that a frame had.
std::size_t expectSameOverTheWire(const scene::World& world) {
  const StreamedSkin skin = decodeSkin(encodedSkinOf(world));
  const deform::Skin far_skin = deform::buildSkin(skin.mesh);
  deform::Deformer far_deformer(far_skin, decodeForms(encodedFormsOf(world, 2)));
  deform::DeformedSurface far_surface(far_skin);
  LivingSkin living(world);
  StreamedFrame frame = frameFor(2);
  StreamedFrame far_frame;
  std::string bytes;
  std::size_t most = 0;
  Index moved = 0;
  const device::FingerPaths paths = device::pathsOf(world);
  servo::Rig rig = servo::scriptedRig(world, paths);
  servo::runHeadless(rig, paths.ticks, [&](std::span<const trace::Sample> samples) {
    if (samples.front().tick % 50 != 0) return;
    moved = std::max(moved, living.follow(samples).moved_vertices);
    fillFrame(world, samples, frame);
    encodeFrame(frame, bytes);
    most = std::max(most, bytes.size());
    ASSERT_TRUE(decodeFrame(bytes, static_cast<Index>(skin.mesh.triangles.size()), far_frame));
    EXPECT_EQ(far_frame.tick, samples.front().tick);
    EXPECT_EQ(far_frame.lift_mm, living.lift());
    ASSERT_EQ(far_frame.fingers.size(), 2u);
    EXPECT_EQ(far_frame.fingers[1].touch, samples[1].contact.touch);
    EXPECT_NEAR((far_frame.fingers[0].force - samples[0].contact.force).norm(), 0.0, 1e-6);
    EXPECT_NEAR((far_frame.fingers[0].tip - samples[0].contact.tip).norm(), 0.0, 1e-4);
    far_deformer.apply(far_frame.contacts, far_surface);
    expectSameSurface(far_surface, living.surface());
  });
  EXPECT_GT(moved, 100u) << "nothing was deformed: nothing was compared";
  return most;
}

TEST(ContactStream, TheHalfGaussianIsTheSameToTheBit) {
  const auto world = bodyWith("[deformation]\ntissue = \"gaussian\"\n");
  EXPECT_LT(expectSameOverTheWire(*world), 450u) << "bytes for two fingers; 60 a second make 27 kB/s";
}

TEST(ContactStream, SoIsLayeredTissueThatBreathesAndRelaxes) {
  const auto world = bodyWith("[breathing]\non = true\ndepth_mm = 2\n[tissue]\nrelaxation = 0.4\nrelaxation_s = 0.5\n");
  ASSERT_NE(world->layered, nullptr);
  const StreamedSkin skin = decodeSkin(encodedSkinOf(*world));
  ASSERT_EQ(skin.breath_share.size(), skin.mesh.positions.size());
  EXPECT_GT(*std::max_element(skin.breath_share.begin(), skin.breath_share.end()), 0.5f);
  EXPECT_LT(expectSameOverTheWire(*world), 1300u);
}

TEST(ContactStream, SoAreContoursThatFollowTheBones) {
  const auto world = bodyWith("[deformation]\nshape = \"contour\"\n");
  ASSERT_NE(world->reach, nullptr);
  EXPECT_GT(expectSameOverTheWire(*world), 800u) << "contours came along";
}

TEST(ContactStream, SoAreProfilesOfOnesOwnAndTheFormulaeAsPrinted) {
  expectSameOverTheWire(
      *bodyWith("[deformation]\nprofile = \"two_gaussians\"\ntangential_profile = \"power\"\n"
                "radial_share = 0.08\ntogether = \"summed\"\nnormals = \"recomputed\"\n"));
  expectSameOverTheWire(*bodyWith("[deformation]\ntissue = \"literal\"\n"));
}

// --- forms

deform::FormSettings uncommonForms() {
  deform::FormSettings forms;
  forms.common = {{1.0, 2.0, 3.0, 4.0, 5.0}, deform::Normals::incremental, true, false, 77};
  forms.normal_profile.kind = tissue::ProfileKind::user;
  forms.normal_profile.rim = tissue::ProfileRim::smooth;
  forms.normal_profile.table_entries = 12;
  forms.normal_profile.lookup = tissue::TableLookup::linear;
  forms.normal_profile.two_gaussians = {0.1, 0.2, -0.3};
  forms.normal_profile.power = {0.4, 0.5};
  forms.normal_profile.knots = {{0.0, 1.0}, {0.5, 0.25}, {1.0, 0.0}};
  forms.normal_profile.interpolation = tissue::UserInterpolation::linear;
  forms.tangential_profile.kind = tissue::ProfileKind::logarithm;
  forms.radial = {0.07, 0.3};
  forms.search = deform::Search::octree;
  forms.shape = deform::Shape::contour;
  forms.region = deform::NormalRegion::scaled;
  forms.boundary = deform::Boundary::two_mm;
  forms.together = deform::Together::summed;
  forms.strain_kind = deform::StrainKind::principal;
  forms.fidelity.setLiteral(Erratum::E1_anchor);
  forms.fidelity.setLiteral(Erratum::E34_drag_direction);
  return forms;
}

TEST(ContactStream, EverySettingOfTheFormsComesAcross) {
  const deform::FormSettings sent = uncommonForms();
  const deform::FormSettings got = decodeForms(encodedForms(sent));
  EXPECT_EQ(got.common.tissue.normal_cap_mm, 1.0);
  EXPECT_EQ(got.common.tissue.tangential_cap_mm, 2.0);
  EXPECT_EQ(got.common.tissue.f_adj, 3.0);
  EXPECT_EQ(got.common.tissue.normal_radius_mm, 4.0);
  EXPECT_EQ(got.common.tissue.normal_radius_per_depth, 5.0);
  EXPECT_EQ(got.common.normals, sent.common.normals);
  EXPECT_TRUE(got.common.strain);
  EXPECT_FALSE(got.common.limit_shear);
  EXPECT_EQ(got.common.max_contacts, 77u);
  EXPECT_EQ(got.normal_profile.kind, sent.normal_profile.kind);
  EXPECT_EQ(got.normal_profile.rim, sent.normal_profile.rim);
  EXPECT_EQ(got.normal_profile.table_entries, 12u);
  EXPECT_EQ(got.normal_profile.lookup, sent.normal_profile.lookup);
  EXPECT_EQ(got.normal_profile.two_gaussians.narrow, 0.1);
  EXPECT_EQ(got.normal_profile.two_gaussians.wide, 0.2);
  EXPECT_EQ(got.normal_profile.two_gaussians.wide_weight, -0.3);
  EXPECT_EQ(got.normal_profile.power.width, 0.4);
  EXPECT_EQ(got.normal_profile.power.exponent, 0.5);
  ASSERT_EQ(got.normal_profile.knots.size(), 3u);
  EXPECT_EQ(got.normal_profile.knots[1].q, 0.5);
  EXPECT_EQ(got.normal_profile.knots[1].value, 0.25);
  EXPECT_EQ(got.normal_profile.interpolation, sent.normal_profile.interpolation);
  EXPECT_EQ(got.tangential_profile.kind, sent.tangential_profile.kind);
  EXPECT_EQ(got.radial.share, 0.07);
  EXPECT_EQ(got.radial.width, 0.3);
  EXPECT_EQ(got.search, sent.search);
  EXPECT_EQ(got.shape, sent.shape);
  EXPECT_EQ(got.region, sent.region);
  EXPECT_EQ(got.boundary, sent.boundary);
  EXPECT_EQ(got.together, sent.together);
  EXPECT_EQ(got.strain_kind, sent.strain_kind);
  EXPECT_EQ(got.fidelity, sent.fidelity);
  EXPECT_EQ(encodedForms(got), encodedForms(sent));
}

// Whoever adds a setting to the forms adds it to form_stream.cpp and to the test above, and then this number.
TEST(ContactStream, TheFormsHaveNoSettingThatIsNotSent) {
#if defined(__x86_64__) && defined(__GLIBCXX__)
  EXPECT_EQ(sizeof(deform::FormSettings), 280u);
  EXPECT_EQ(sizeof(deform::Contact), 904u);
#else
  GTEST_SKIP() << "sizes are known of one machine";
#endif
}

// --- bytes of anybody

std::string decodeError(const std::string& bytes, bool forms) {
  try {
    forms ? static_cast<void>(decodeForms(bytes)) : static_cast<void>(decodeSkin(bytes));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

mesh::TriangleMesh twoTriangles() {
  mesh::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(ContactStream, ASkinIsTakenWholeOrRefused) {
  const std::string good = encodedSkin(twoTriangles());
  ASSERT_EQ(good.size(), 16 + 4 * 24 + 2 * 12u);
  EXPECT_EQ(decodeError(good, false), "");
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(decodeError(good.substr(0, size), false).find("ends too early"), std::string::npos) << size;
  }
  EXPECT_EQ(decodeError(good + "x", false), "skin: byte 136: goes on after its end");
  std::string other = good;
  other[3] = '2';
  EXPECT_NE(decodeError(other, false).find("another version"), std::string::npos);
  other = good;
  other[16 + 4 * 24] = 4;  // a corner
  EXPECT_NE(decodeError(other, false).find("out of range"), std::string::npos);
  other = good;
  for (std::size_t i = 16; i < 24; ++i) other[i] = '\xff';
  EXPECT_NE(decodeError(other, false).find("not finite"), std::string::npos);
}

TEST(ContactStream, AFewBytesThatPromiseBillionsCostNothing) {
  std::string bytes = "PSK1";
  bytes += std::string(8, '\xff') + std::string(4, '\0');
  EXPECT_NE(decodeError(bytes, false).find("ends too early"), std::string::npos);
  EXPECT_NE(decodeError("PSK1" + std::string(4, '\0') + std::string(8, '\1'), false).find("without vertices"),
            std::string::npos);
}

TEST(ContactStream, FormsAreTakenWholeOrRefused) {
  const std::string good = encodedForms(uncommonForms());
  for (std::size_t size = 0; size < good.size(); ++size) EXPECT_NE(decodeError(good.substr(0, size), true), "") << size;
  EXPECT_NE(decodeError(good + "x", true), "");
  std::string other = good;
  other[4 + 5 * 8] = 9;  // the word of the normals
  EXPECT_NE(decodeError(other, true).find("unknown word"), std::string::npos);
  for (std::size_t i = 4; i < 12; ++i) other[i] = '\xff';
  EXPECT_NE(decodeError(other, true).find("not finite"), std::string::npos);
}

StreamedFrame someFrame() {
  StreamedFrame frame;
  frame.tick = 1234567890123;
  frame.lift_mm = 1.5;
  frame.fingers = {{Vec3(1, 2, 3), Vec3(1, 2, 4), Vec3(0, 0, 1), Vec3(0, 0, 4), 2.5, contact::Touch::slip}, {}};
  deform::Contact plain;
  plain.anchor_triangle = 1;
  plain.normal_region.half_major = Vec3(9, 0, 0);
  deform::Contact full = plain;
  full.layered.emplace();
  full.layered->press.radius_mm = 20.0;
  full.layered->drag.terms[6] = 0.5;
  full.tangential_contour.contour = maps::contourOf(maps::Ellipse{20.0, 0.5, 1.0}, 5);
  frame.contacts = {plain, full};
  return frame;
}

TEST(ContactStream, AFrameIsTakenWholeOrNobodyTouches) {
  std::string good;
  encodeFrame(someFrame(), good);
  StreamedFrame frame;
  ASSERT_TRUE(decodeFrame(good, 2, frame));
  EXPECT_EQ(frame.tick, 1234567890123u);
  EXPECT_EQ(frame.fingers[0].touch, contact::Touch::slip);
  EXPECT_EQ(frame.fingers[0].proxy, Vec3(1, 2, 4));
  EXPECT_EQ(frame.fingers[0].normal, Vec3(0, 0, 1));
  EXPECT_EQ(frame.fingers[0].force, Vec3(0, 0, 4));
  EXPECT_EQ(frame.fingers[0].depth_mm, 2.5);
  EXPECT_FALSE(frame.contacts[0].layered);
  EXPECT_EQ(frame.contacts[1].layered->drag.terms[6], 0.5);
  EXPECT_EQ(frame.contacts[1].tangential_contour.contour.count, 5u);
  std::string again;
  encodeFrame(frame, again);
  EXPECT_EQ(again, good);
  for (std::size_t size = 0; size < good.size(); ++size) {
    decodeFrame(good, 2, frame);
    EXPECT_FALSE(decodeFrame(std::string_view(good).substr(0, size), 2, frame)) << size;
    EXPECT_TRUE(frame.contacts.empty() && frame.fingers.empty() && frame.tick == 0 && frame.lift_mm == 0.0) << size;
  }
  EXPECT_FALSE(decodeFrame(good + "x", 2, frame));
  EXPECT_FALSE(decodeFrame(good, 1, frame)) << "a triangle that the skin has not";
  EXPECT_TRUE(frame.contacts.empty());
}

TEST(ContactStream, NoBitThatFlipsGivesAContactThatIsNone) {
  std::string good;
  encodeFrame(someFrame(), good);
  StreamedFrame frame;
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bytes = good;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ (1 << (bit % 8)));
    if (!decodeFrame(bytes, 2, frame)) {
      ++refused;
      continue;
    }
    for (const deform::Contact& contact : frame.contacts) {
      ASSERT_LT(contact.anchor_triangle, 2u) << bit;
      ASSERT_TRUE(contact.anchor.cwiseAbs().maxCoeff() <= kMaxWire && std::isfinite(contact.depth_mm)) << bit;
      ASSERT_LE(contact.tangential_contour.contour.count, maps::kMaxContourRadii) << bit;
    }
  }
  EXPECT_GT(refused, 100u);
}

TEST(ContactStream, EncodingAFrameAgainTakesNoMemory) {
  const StreamedFrame frame = someFrame();
  std::string bytes;
  encodeFrame(frame, bytes);
  support::expectNoAllocation([&] { encodeFrame(frame, bytes); });
}

}  // namespace
}  // namespace palpate::engine
