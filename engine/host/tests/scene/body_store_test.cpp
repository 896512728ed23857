// Built-in bodies that are kept from run to run: the same body to the last bit, sooner, and never from a damaged file.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/scene/beneath/bone_width.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/ready_body.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate::scene {
namespace {

namespace fs = std::filesystem;

BodySettings bodySettings(BodyKind kind, std::size_t triangles) {
  BodySettings settings;
  settings.kind = kind;
  settings.triangles = triangles;
  return settings;
}

BodySettings smallTrunk() { return bodySettings(BodyKind::trunk, 8000); }

/// With what each kind has and others lack: a support, an open border, skin alone.
std::vector<BodySettings> oneOfEachKind() {
  BodySettings prone = smallTrunk();
  prone.shape.posture = body::Posture::prone;
  return {prone, bodySettings(BodyKind::torso, 6000), bodySettings(BodyKind::back, 0)};
}

void expectSameMesh(const mesh::TriangleMesh& a, const mesh::TriangleMesh& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.triangles, b.triangles);
}

void expectSameBody(const BodyParts& a, const BodyParts& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.closed, b.closed);
  EXPECT_EQ(a.self_intersecting, b.self_intersecting);
  EXPECT_EQ(a.notes, b.notes);
  expectSameMesh(a.skin, b.skin);
  EXPECT_EQ(a.anatomy.depth_mm, b.anatomy.depth_mm);
  EXPECT_EQ(a.anatomy.nearest_bone, b.anatomy.nearest_bone);
  EXPECT_EQ(a.anatomy.bone_radius_mm, b.anatomy.bone_radius_mm);
  ASSERT_EQ(a.anatomy.bones.size(), b.anatomy.bones.size());
  for (std::size_t i = 0; i < a.anatomy.bones.size(); ++i) {
    EXPECT_EQ(a.anatomy.bones[i].name, b.anatomy.bones[i].name);
    EXPECT_EQ(a.anatomy.bones[i].kind, b.anatomy.bones[i].kind);
    expectSameMesh(a.anatomy.bones[i].mesh, b.anatomy.bones[i].mesh);
  }
  ASSERT_EQ(a.anatomy.landmarks.size(), b.anatomy.landmarks.size());
  for (std::size_t i = 0; i < a.anatomy.landmarks.size(); ++i) {
    const body::SkinLandmark &left = a.anatomy.landmarks[i], &right = b.anatomy.landmarks[i];
    EXPECT_EQ(left.name, right.name);
    EXPECT_EQ(left.bone, right.bone);
    EXPECT_EQ(left.position, right.position);
    EXPECT_EQ(left.normal, right.normal);
    EXPECT_EQ(left.bone_position, right.bone_position);
  }
  ASSERT_EQ(a.anatomy.support.has_value(), b.anatomy.support.has_value());
  if (!a.anatomy.support) return;
  EXPECT_EQ(a.anatomy.support->point, b.anatomy.support->point);
  EXPECT_EQ(a.anatomy.support->normal, b.anatomy.support->normal);
}

double secondsOfTheProcessor() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A variable of the environment, as it was again at the end.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    const char* before = std::getenv(name);
    had_ = before != nullptr;
    if (had_) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { had_ ? ::setenv(name_, before_.c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  bool had_ = false;
  std::string before_;
};

class BodyStoreFiles : public ::testing::Test {
 protected:
  fs::path bodies() const { return folder_ / "palpate/bodies"; }
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    if (fs::exists(bodies())) {
      for (const auto& entry : fs::directory_iterator(bodies())) all.push_back(entry.path());
    }
    return all;
  }
  static void write(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  }
  static void letBeUnusedFor(const fs::path& file, std::chrono::hours hours) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - hours);
  }
  /// The file that keeping this body adds.
  fs::path addBodyFile(const BodySettings& settings, const BodyParts& parts) const {
    const std::vector<fs::path> before = files();
    storeBody(settings, parts);
    for (const fs::path& file : files()) {
      if (std::find(before.begin(), before.end(), file) == before.end()) return file;
    }
    ADD_FAILURE() << "nothing was kept";
    return {};
  }

  support::TemporaryFolder folder_;
  Variable cache_{"XDG_CACHE_HOME", folder_.path().string()};
  Variable bound_{"PALPATE_BODY_CACHE_MB", ""};
};

TEST_F(BodyStoreFiles, GiveWhatTheMakersMakeToTheLastBit) {
  for (const BodySettings& settings : oneOfEachKind()) {
    BodyParts fresh;
    {
      const Variable off("PALPATE_BODY_CACHE_MB", "0");
      fresh = makeBody(settings, {});
    }
    EXPECT_FALSE(keptBody(settings));
    expectSameBody(makeBody(settings, {}), fresh);  // kept now
    const std::optional<BodyParts> kept = keptBody(settings);
    ASSERT_TRUE(kept);
    expectSameBody(*kept, fresh);
    EXPECT_EQ(kept->anatomy.bone_radius_mm, boneRadii(kept->skin, kept->anatomy.depth_mm, kept->anatomy.bones));
    expectSameBody(makeBody(settings, {}), fresh);  // read
  }
  EXPECT_EQ(files().size(), oneOfEachKind().size());
}

TEST_F(BodyStoreFiles, TakeAFractionOfTheTime) {
  const double begin = secondsOfTheProcessor();
  makeBody(smallTrunk(), {});
  const double made = secondsOfTheProcessor();
  makeBody(smallTrunk(), {});
  const double read = secondsOfTheProcessor();
  EXPECT_LT(read - made, 0.3 * (made - begin));
}

TEST_F(BodyStoreFiles, AreForTheirUserAlone) {
  makeBody(smallTrunk(), {});
  ASSERT_EQ(files().size(), 1u);
  EXPECT_EQ(fs::status(bodies()).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(files()[0]).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(BodyStoreFiles, AreNotMadeWhereTheyAreTurnedOff) {
  const Variable off("PALPATE_BODY_CACHE_MB", "0");
  makeBody(bodySettings(BodyKind::back, 0), {});
  EXPECT_FALSE(fs::exists(bodies()));
}

TEST_F(BodyStoreFiles, AreNeverTheBodyOfOtherSettings) {
  std::vector<BodySettings> others = {smallTrunk()};
  const auto add = [&](const auto& change) {
    others.push_back(smallTrunk());
    change(others.back());
  };
  add([](BodySettings& s) { s.kind = BodyKind::torso; });
  add([](BodySettings& s) { s.kind = BodyKind::back; });
  add([](BodySettings& s) { s.triangles += 2; });
  add([](BodySettings& s) { s.bone_triangles = 2000; });
  add([](BodySettings& s) { s.shape.posture = body::Posture::prone; });
  add([](BodySettings& s) { s.shape.posture = body::Posture::sitting; });
  for (double body::TrunkShape::*number :
       {&body::TrunkShape::stature_mm, &body::TrunkShape::girth, &body::TrunkShape::body_mass_index,
        &body::TrunkShape::muscle, &body::TrunkShape::kyphosis_deg, &body::TrunkShape::lordosis_deg,
        &body::TrunkShape::asymmetry}) {
    add([&](BodySettings& s) { s.shape.*number = std::nextafter(s.shape.*number, 1e9); });
  }
  for (double body::ReliefSettings::*number :
       {&body::ReliefSettings::spine, &body::ReliefSettings::ribs, &body::ReliefSettings::scapulae}) {
    add([&](BodySettings& s) { s.shape.relief.*number = 0.5; });
  }
  for (body::LevelWeights body::ReliefSettings::*levels :
       {&body::ReliefSettings::spine_level, &body::ReliefSettings::rib_level, &body::ReliefSettings::scapula_level}) {
    for (std::size_t i = 0; i < 4; ++i) {
      add([&](BodySettings& s) { (s.shape.relief.*levels)[i] = 0.25; });
    }
  }
  std::set<std::string> recipes;
  for (const BodySettings& settings : others) recipes.insert(bodyRecipe(settings));
  EXPECT_EQ(recipes.size(), others.size());

  makeBody(smallTrunk(), {});
  for (const BodySettings& settings : others) EXPECT_EQ(keptBody(settings).has_value(), &settings == &others[0]);
}

/// A file under another recipe's name is not that recipe's body.
TEST_F(BodyStoreFiles, AreNotBelievedByTheirName) {
  const BodyParts parts = makeBody(smallTrunk(), {});
  const fs::path own = files().at(0);
  BodySettings other = smallTrunk();
  other.shape.girth = 1.1;
  const fs::path file = addBodyFile(other, parts);
  fs::copy_file(own, file, fs::copy_options::overwrite_existing);
  EXPECT_FALSE(keptBody(other));
  EXPECT_TRUE(keptBody(smallTrunk()));
}

TEST_F(BodyStoreFiles, AreIgnoredAndMadeAgainWhenTheyAreDamaged) {
  const BodyParts fresh = makeBody(smallTrunk(), {});
  const fs::path file = files().at(0);
  const std::string whole = support::contentOf(file);
  ASSERT_TRUE(keptBody(smallTrunk()));
  std::vector<std::string> damaged = {"", "palpate", whole + "x", std::string(whole.size(), '\0')};
  for (std::size_t size = 1; size < whole.size(); size += whole.size() / 20) damaged.push_back(whole.substr(0, size));
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 60) {
    damaged.push_back(whole);
    damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 4);
  }
  for (const std::string& bytes : damaged) {
    write(file, bytes);
    EXPECT_FALSE(keptBody(smallTrunk())) << bytes.size();
  }
  expectSameBody(makeBody(smallTrunk(), {}), fresh);
  EXPECT_EQ(support::contentOf(file), whole);
}

/// Somebody who can compute the hash gets no further than the checks of the bytes.
TEST_F(BodyStoreFiles, AreCheckedAlsoWhereTheirHashIsRight) {
  makeBody(smallTrunk(), {});
  const fs::path file = files().at(0);
  const std::string whole = support::contentOf(file);
  std::size_t head = 0;
  for (int line = 0; line < 3; ++line) head = whole.find('\n', head) + 1;
  constexpr std::size_t kHashLine = 17;
  const auto with_bytes = [&](const std::string& bytes) {
    Hash hash;
    for (const char byte : bytes) hash.addByte(static_cast<unsigned char>(byte));
    char text[kHashLine + 1];
    std::snprintf(text, sizeof(text), "%016llx\n", static_cast<unsigned long long>(hash.value()));
    write(file, whole.substr(0, head) + text + bytes);
  };
  const std::string bytes = whole.substr(head + kHashLine);
  with_bytes(bytes);
  ASSERT_EQ(support::contentOf(file), whole) << "the test computes the hash that the store does";
  with_bytes(bytes.substr(0, bytes.size() - 1));
  EXPECT_FALSE(keptBody(smallTrunk()));
  with_bytes(bytes + '\0');
  EXPECT_FALSE(keptBody(smallTrunk()));
  std::string hostile = bytes;
  for (std::size_t i = 30; i < hostile.size(); ++i) hostile[i] = '\xff';
  with_bytes(hostile);
  EXPECT_FALSE(keptBody(smallTrunk()));
}

TEST_F(BodyStoreFiles, OfAnotherOrAnOpenFolderAreNeitherReadNorWritten) {
  const BodyParts parts = makeBody(smallTrunk(), {});
  fs::permissions(bodies(), fs::perms::others_read | fs::perms::others_exec, fs::perm_options::add);
  EXPECT_FALSE(keptBody(smallTrunk()));
  storeBody(bodySettings(BodyKind::trunk, 9000), parts);
  EXPECT_EQ(files().size(), 1u);
  fs::permissions(bodies(), fs::perms::owner_all);
  EXPECT_TRUE(keptBody(smallTrunk()));
  fs::rename(bodies(), folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", bodies());
  EXPECT_FALSE(keptBody(smallTrunk())) << "a link";
}

TEST_F(BodyStoreFiles, AreDoneWithoutWhereThereIsNoPlaceForThem) {
  write(folder_ / "file", "");
  const BodySettings settings = bodySettings(BodyKind::back, 0);
  const Variable no_folder("XDG_CACHE_HOME", (folder_ / "file/below").string());
  const BodyParts made = makeBody(settings, {});
  EXPECT_FALSE(keptBody(settings));
  const Variable no_cache("XDG_CACHE_HOME", ""), no_home("HOME", "");
  storeBody(settings, made);
  EXPECT_FALSE(keptBody(settings));
  EXPECT_TRUE(files().empty());
}

TEST_F(BodyStoreFiles, ThatWereNotUsedForLongestGoFirst) {
  const BodyParts parts = makeBody(smallTrunk(), {});
  const fs::path first = files().at(0);
  const BodySettings b = bodySettings(BodyKind::trunk, 9000), c = bodySettings(BodyKind::trunk, 10000);
  const fs::path second = addBodyFile(b, parts);
  const double each_mb = static_cast<double>(fs::file_size(first)) / 1e6;
  const Variable two("PALPATE_BODY_CACHE_MB", std::to_string(2.5 * each_mb));
  letBeUnusedFor(first, std::chrono::hours(2));
  letBeUnusedFor(second, std::chrono::hours(1));
  EXPECT_TRUE(keptBody(smallTrunk()));  // used now
  const fs::path third = addBodyFile(c, parts);
  EXPECT_FALSE(fs::exists(second));
  EXPECT_TRUE(fs::exists(first));
  EXPECT_TRUE(fs::exists(third));
  const Variable half("PALPATE_BODY_CACHE_MB", std::to_string(0.5 * each_mb));
  storeBody(b, parts);
  EXPECT_FALSE(fs::exists(second)) << "more than the folder may hold";
  EXPECT_TRUE(fs::exists(first));
}

TEST_F(BodyStoreFiles, MayBeWrittenByManyProcessesAtOnce) {
  const BodySettings settings = smallTrunk();
  constexpr int kProcesses = 3, kTimes = 5;
  std::string whole;
  {
    const Variable off("PALPATE_BODY_CACHE_MB", "0");
    whole = encodedBody({settings.triangles, makeBody(settings, {})});
  }
  const BodyParts parts = decodeBody(whole, "test").parts;
  std::vector<pid_t> children;
  for (int i = 0; i < kProcesses; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      bool good = true;
      for (int time = 0; time < kTimes; ++time) {
        storeBody(settings, parts);
        const std::optional<BodyParts> kept = keptBody(settings);
        good = good && kept && encodedBody({settings.triangles, *kept}) == whole;
      }
      ::_exit(good ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(files().size(), 1u) << "nothing half written is left";
  EXPECT_TRUE(keptBody(settings));
}

/// Whoever changes how a body is made must not get what the code before has made.
TEST_F(BodyStoreFiles, BearTheNameOfTheSourcesThatMadeThem) {
  const fs::path source = support::sourceFolder() / "engine";
  const auto makers_of = [&](const fs::path& root) {
    const fs::path output = folder_ / "makers.cpp";
    const auto run =
        support::runProgram("cmake", "'-DROOT=" + root.string() + "' '-DOUTPUT=" + output.string() + "' -P '" +
                                         (support::sourceFolder() / "cmake/body_makers.cmake").string() + "'");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return support::contentOf(output);
  };
  const std::string built = makers_of(source);
  EXPECT_EQ(support::contentOf(support::buildFolder() / "engine/host/body_makers.cpp"), built) << "of this build";
  const fs::path copy = folder_ / "copy";
  fs::create_directories(copy / "core/palpate");
  for (const char* room : {"base", "mesh", "body", "scene", "tissue"}) {
    fs::copy(source / "core/palpate" / room, copy / "core/palpate" / room, fs::copy_options::recursive);
  }
  EXPECT_EQ(makers_of(copy), built);
  for (const char* file : {"base/elementary.cpp", "mesh/reorder.cpp", "body/trunk/trunk_numbers.txt",
                           "scene/body_parts.cpp", "scene/beneath/bone_width.cpp", "tissue/narrow_bone.h"}) {
    ASSERT_TRUE(fs::exists(copy / "core/palpate" / file)) << file;
    std::ofstream(copy / "core/palpate" / file, std::ios::app) << "//\n";
    const std::string changed = makers_of(copy);
    EXPECT_NE(changed, built) << file;
    fs::copy_file(source / "core/palpate" / file, copy / "core/palpate" / file, fs::copy_options::overwrite_existing);
  }
}

TEST(ReadyBody, OneTriangleIsABody) {
  BodyParts parts;
  parts.skin = {{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}}, {{0, 1, 2}}};
  parts.anatomy.bones = {{"bone", body::BoneKind::rib, parts.skin}};
  parts.anatomy.depth_mm.assign(3, 1.0);
  parts.anatomy.nearest_bone.assign(3, 0);
  parts.anatomy.bone_radius_mm.assign(3, 5.0f);
  EXPECT_EQ(decodeBody(encodedBody({0, parts}), "body").parts.skin.triangles.size(), 1u);
}

TEST(ReadyBody, NoneIsLargerThanTwoMillionTriangles) {
  const BodyParts back = makeBody(bodySettings(BodyKind::back, 500), {});
  EXPECT_EQ(decodeBody(encodedBody({2'000'000, back}), "body").triangles, 2'000'000u);
  EXPECT_THROW(decodeBody(encodedBody({2'000'001, back}), "body"), Error);
}

TEST(ReadyBody, RefusesBytesThatAreNotAWholeBody) {
  const std::string whole = encodedBody({0, makeBody(bodySettings(BodyKind::back, 500), {})});
  EXPECT_NO_THROW(decodeBody(whole, "body"));
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 100) {
    EXPECT_THROW(decodeBody(whole.substr(0, size), "body"), Error) << size;
  }
  EXPECT_THROW(decodeBody(whole + '\0', "body"), Error);
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 200) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    try {
      const BodyParts parts = decodeBody(damaged, "body").parts;  // another body, but one
      for (const Triangle& triangle : parts.skin.triangles) {
        for (const Index v : triangle) ASSERT_LT(v, parts.skin.positions.size()) << at;
      }
      for (const Vec3& position : parts.skin.positions) ASSERT_TRUE(position.allFinite()) << at;
      for (const Index bone : parts.anatomy.nearest_bone) ASSERT_LT(bone, parts.anatomy.bones.size()) << at;
      ASSERT_EQ(parts.anatomy.depth_mm.size(), parts.skin.positions.size()) << at;
      ASSERT_EQ(parts.anatomy.bone_radius_mm.size(), parts.skin.positions.size()) << at;
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace palpate::scene
