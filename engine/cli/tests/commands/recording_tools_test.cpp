// What is made of recording files from the outside: trimmed, joined, salvaged, bundled, exported; and felt again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "palpate/base/private_folder.h"
#include "palpate/base/random.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/save.h"
#include "palpate/trace/recording_reader.h"
#include "support/mesh_zoo.h"
#include "support/places.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate {
namespace {

using support::CommandResult;
using support::contentOf;
using support::runPalpate;

class RecordingTools : public testing::Test {
 protected:
  void SetUp() override {
    mesh::save(folder_ / "dome.obj", zoo::dome({-100.0, -100.0}, 10.0, 20.0));
    // Free, 0.3 s of contact, free, 0.3 s of contact, free.
    std::ofstream(folder_ / "path.csv")
        << "t_s,x_mm,y_mm,z_mm\n0,0,0,40\n0.2,0,0,30\n0.3,0,0,15\n0.4,10,0,14\n0.6,10,0,"
           "30\n0.8,0,5,30\n0.9,0,5,13\n1.1,5,5,14\n1.2,5,5,40\n1.4,0,0,40\n";
  }
  CommandResult palpate(const std::string& arguments) const { return runPalpate(arguments, folder_.path()); }
  nlohmann::json jsonFrom(const std::string& arguments, int exit_code = 0) const {
    const CommandResult result = palpate(arguments + " --json");
    EXPECT_EQ(result.exit_code, exit_code) << arguments << ": " << result.out << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }
  void record(const std::string& body = "dome.obj") const {
    const CommandResult result = palpate(
        "simulate " + body + " --trajectory path.csv --trajectory path.csv --radius-mm 4 --no-pictures --session");
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  std::string pathOf(const std::string& name) const { return (folder_ / name).string(); }
  support::TemporaryFolder folder_;
};

// --- trim ---

TEST_F(RecordingTools, ATrimmedRecordingIsFeltAgainToTheBit) {
  record();
  for (const char* span : {"--from 0.7 --to 1.0", "--from 0.95 --to 1.3", "--from 0.35", "--to 0.45", "--from 1.25"}) {
    jsonFrom(std::string("recording trim results/run.session -o part.session ") + span);
    const auto replay = jsonFrom("recording replay part.session --verify");
    EXPECT_EQ(replay["identical"], true) << span;
    EXPECT_EQ(replay["unproven"], 0) << span;
    EXPECT_GT(replay["ticks"], 300) << span;
  }
}

TEST_F(RecordingTools, ATrimSaysHowMuchEarlierItBegins) {
  record();
  const auto trim = jsonFrom("recording trim results/run.session -o part.session --from 0.95 --to 1.3");
  EXPECT_EQ(trim["first_tick"].get<int>() + trim["earlier_ticks"].get<int>(), 950);
  EXPECT_GT(trim["first_tick"], 600) << "between the contacts";
  EXPECT_GT(trim["earlier_ticks"], 50);
  EXPECT_NE(palpate("recording trim results/run.session -o part.session --from 0.95").out.find("last at rest"),
            std::string::npos);
}

TEST_F(RecordingTools, AnExactTrimInAContactIsProvenFromWhereTheFingersRest) {
  record();
  const auto trim = jsonFrom("recording trim results/run.session -o part.session --from 0.4 --exact");
  EXPECT_EQ(trim["first_tick"], 400);
  EXPECT_EQ(trim["not_at_rest"].size(), 2u);
  const auto replay = jsonFrom("recording replay part.session --verify");
  EXPECT_EQ(replay["identical"], true) << "what can be proven";
  EXPECT_GT(replay["unproven"], 2 * 100);
  EXPECT_GT(replay["ticks"], 2 * 600);
  EXPECT_EQ(replay["gaps"].size(), 2u);
  const CommandResult words = palpate("recording replay part.session --verify");
  EXPECT_NE(words.out.find("cannot be verified"), std::string::npos) << words.out;
  // All of it in the contact: nothing can be proven, and nobody may believe it was.
  palpate("recording trim results/run.session -o inside.session --from 0.35 --to 0.4 --exact");
  const CommandResult nothing = palpate("recording replay inside.session --verify");
  EXPECT_EQ(nothing.exit_code, 1) << nothing.out;
  EXPECT_NE(nothing.out.find("nothing    could be compared"), std::string::npos) << nothing.out;
}

TEST_F(RecordingTools, ATrimOfADamagedRecordStillDiffers) {
  record();
  mesh::save(folder_ / "dome.obj", zoo::dome({-100.0, -100.0}, 10.0, 21.0));
  palpate("recording trim results/run.session -o part.session --from 0.7");
  EXPECT_EQ(palpate("recording replay part.session --verify").exit_code, 1);
}

// --- join ---

TEST_F(RecordingTools, JoinedRecordingsAreFeltAgainToTheBit) {
  record();
  jsonFrom("recording trim results/run.session -o a.session --to 0.35");  // ends in a contact
  jsonFrom("recording trim results/run.session -o b.session --from 0.7");
  jsonFrom("recording trim results/run.session -o c.session --from 0.4 --exact");
  const auto join = jsonFrom("recording join a.session results/run.session b.session -o all.session");
  EXPECT_EQ(join["begins"].size(), 3u);
  const auto replay = jsonFrom("recording replay all.session --verify");
  EXPECT_EQ(replay["identical"], true);
  EXPECT_EQ(replay["unproven"], 0);
  EXPECT_EQ(replay["ticks"], join["samples"]);
  // One that was cut in a contact stays unproven there, and only there.
  jsonFrom("recording join results/run.session c.session b.session -o all.session");
  const auto again = jsonFrom("recording replay all.session --verify");
  EXPECT_EQ(again["identical"], true);
  EXPECT_EQ(again["unproven"], jsonFrom("recording replay c.session --verify")["unproven"]);
}

// --- repair ---

TEST_F(RecordingTools, ASalvagedRecordingIsFeltAgainAroundItsHoles) {
  record();
  std::string bytes = readFile(folder_ / "results/run.session", 1 << 26);
  ASSERT_GT(bytes.size(), 100000u);
  for (std::size_t at = bytes.size() / 2; at < bytes.size() / 2 + 9000; ++at) bytes[at] = 'x';
  std::ofstream(folder_ / "bent.session", std::ios::binary) << bytes;
  EXPECT_EQ(palpate("recording replay bent.session --verify").exit_code, 2);
  const auto repair = jsonFrom("recording repair bent.session -o mended.session");
  EXPECT_EQ(repair["nothing_lost"], false);
  EXPECT_GT(repair["samples_lost"], 100);
  EXPECT_EQ(repair["samples"].get<int>() + repair["samples_lost"].get<int>(), 2 * 1401);
  EXPECT_EQ(contentOf(folder_ / "bent.session"), bytes);
  const auto replay = jsonFrom("recording replay mended.session --verify");
  EXPECT_EQ(replay["identical"], true);
  EXPECT_EQ(replay["ticks"].get<int>() + replay["unproven"].get<int>(), repair["samples"]);
  EXPECT_GT(replay["ticks"], 500);
}

TEST_F(RecordingTools, ASoundRecordingIsRepairedWithoutALoss) {
  record();
  const CommandResult result = palpate("recording repair results/run.session -o mended.session");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("nothing was lost"), std::string::npos) << result.out;
  EXPECT_EQ(palpate("recording replay mended.session --verify").exit_code, 0);
}

// --- bundle ---

TEST_F(RecordingTools, ABundleIsFeltAgainSomewhereElseWithNothingElse) {
  record();
  const auto bundle = jsonFrom("recording bundle results/run.session -o bundle.session --include .");
  EXPECT_EQ(bundle["files"].size(), 2u) << "mesh and path";
  for (const char* gone : {"dome.obj", "path.csv"}) std::filesystem::remove(folder_ / gone);
  EXPECT_EQ(palpate("recording replay results/run.session --verify").exit_code, 2);
  const support::TemporaryFolder elsewhere;
  std::filesystem::rename(folder_ / "bundle.session", elsewhere / "bundle.session");
  EXPECT_EQ(runPalpate("recording replay bundle.session --verify", elsewhere.path()).exit_code, 0);
  // What is made of a bundle carries the files on.
  for (const char* made :
       {"recording trim bundle.session -o made.session --from 0.7", "recording repair bundle.session -o made.session",
        "recording join bundle.session bundle.session -o made.session",
        "recording bundle bundle.session -o made.session"}) {
    EXPECT_EQ(runPalpate(made, elsewhere.path()).exit_code, 0) << made;
    const CommandResult replay = runPalpate("recording replay made.session --verify", elsewhere.path());
    EXPECT_EQ(replay.exit_code, 0) << made << replay.out << replay.err;
  }
}

TEST_F(RecordingTools, ABundleCarriesWhatAGltfFileNames) {
  std::filesystem::create_directories(folder_ / "model/parts");
  const std::string indices{"\0\0\1\0\2\0\0\0", 8};
  std::string bytes = indices;
  for (const float number : {0.0f, 0.0f, 0.0f, 0.1f, 0.0f, 0.0f, 0.0f, 0.1f, 0.0f}) {
    bytes.append(reinterpret_cast<const char*>(&number), 4);
  }
  std::ofstream(folder_ / "model/parts/back.bin", std::ios::binary) << bytes;
  std::ofstream(folder_ / "model/back.gltf")
      << R"({"asset":{"version":"2.0"},"buffers":[{"uri":"parts/back.bin","byteLength":44}],"bufferViews":[)"
      << R"({"buffer":0,"byteLength":6},{"buffer":0,"byteOffset":8,"byteLength":36}],"accessors":[)"
      << R"({"bufferView":0,"componentType":5123,"count":3,"type":"SCALAR"},)"
      << R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}],)"
      << R"("meshes":[{"primitives":[{"attributes":{"POSITION":1},"indices":0}]}],"nodes":[{"mesh":0}],)"
      << R"("scenes":[{"nodes":[0]}],"scene":0})";
  record("model/back.gltf");
  EXPECT_EQ(jsonFrom("recording bundle results/run.session -o bundle.session --include .")["files"].size(), 3u);
  std::filesystem::remove_all(folder_ / "model");
  EXPECT_EQ(palpate("recording replay bundle.session --verify").exit_code, 0);
}

TEST_F(RecordingTools, ABundleSaysNothingOfWhoRecordedItAndWhere) {
  std::filesystem::create_directories(folder_ / "zaphod/scans");
  mesh::save(folder_ / "zaphod/scans/back.obj", zoo::dome({-100.0, -100.0}, 10.0, 20.0));
  std::ofstream(folder_ / "zaphod/scene.toml")
      << "title = \"of zaphod, practice\"\n[body]\nkind = \"mesh\"\nfile = \"scans/back.obj\"\n[[finger]]\nname = "
         "\"index\"\ntrajectory = \""
      << pathOf("path.csv") << "\"\n";
  ASSERT_EQ(palpate("simulate zaphod/scene.toml --no-pictures --session").exit_code, 0);
  ASSERT_NE(readFile(folder_ / "results/run.session", 1 << 26).find("zaphod"), std::string::npos);
  ::setenv("USER", "zaphod", 1);
  const CommandResult result =
      palpate("recording bundle results/run.session -o bundle.session --include zaphod --include path.csv");
  ::unsetenv("USER");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string bytes = readFile(folder_ / "bundle.session", 1 << 26);
  EXPECT_EQ(bytes.find("zaphod"), std::string::npos);
  EXPECT_EQ(bytes.find(folder_.path().string()), std::string::npos);
  EXPECT_EQ(bytes.find(folder_.path().filename().string()), std::string::npos);
  EXPECT_NE(bytes.find("of user, practice"), std::string::npos) << "the rest of the words stays";
  std::filesystem::remove_all(folder_ / "zaphod");
  EXPECT_EQ(palpate("recording replay bundle.session --verify").exit_code, 0);
}

TEST_F(RecordingTools, AFileThatABundleNeedsAndThatIsGoneIsNamed) {
  record();
  std::filesystem::remove(folder_ / "dome.obj");
  const CommandResult result = palpate("recording bundle results/run.session -o bundle.session --include .");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("dome.obj"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bundle.session"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bundle.session.partial"));
}

TEST_F(RecordingTools, FilesThatAStrangersRecordingCarriesStayInTheirFolder) {
  for (const char* name : {"../evil", "/tmp/evil", "a/../../evil", "", ".", "a/./b", "a\\\\b", "files/"}) {
    {
      trace::RecordingWriter writer(folder_ / "evil.session", trace::RecordingHeader(), {{"a", "b"}});
      writer.add(trace::RecordingWorld{"", "", "torso", 1, 1, {{"", ""}}});
      writer.add(trace::RecordingAttachment{0, "file", name, "", "evil"});
      writer.add(trace::Sample{});
      writer.finish("done");
    }
    const CommandResult result = palpate("recording replay evil.session");
    EXPECT_EQ(result.exit_code, 2) << name;
    EXPECT_NE(result.err.find("outside its folder"), std::string::npos) << name << ": " << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists("/tmp/evil"));
}

TEST_F(RecordingTools, ABundleTakesNoFileFromElsewhereUnlessItIsToldTo) {
  record();
  const CommandResult refused = palpate("recording bundle results/run.session -o bundle.session");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  for (const char* name : {"dome.obj", "path.csv"}) {
    EXPECT_NE(refused.err.find("--include '" + pathOf(name) + "'"), std::string::npos) << refused.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "bundle.session"));
  EXPECT_EQ(palpate("recording bundle results/run.session -o bundle.session --include dome.obj").exit_code, 2);
  EXPECT_EQ(
      palpate("recording bundle results/run.session -o bundle.session --include dome.obj --include path.csv").exit_code,
      0);
  // What lies beside the recording needs no word; a link that leads out of there does.
  std::filesystem::rename(folder_ / "results/run.session", folder_ / "run.session");
  EXPECT_EQ(palpate("recording bundle run.session -o beside.session").exit_code, 0);
  const palpate::TemporaryFolder elsewhere("elsewhere");
  std::filesystem::rename(folder_ / "path.csv", elsewhere.path() / "id_rsa");
  std::filesystem::create_symlink(elsewhere.path() / "id_rsa", folder_ / "path.csv");
  const CommandResult linked = palpate("recording bundle run.session -o linked.session");
  EXPECT_EQ(linked.exit_code, 2);
  EXPECT_NE(linked.err.find("id_rsa"), std::string::npos) << linked.err;
}

TEST_F(RecordingTools, WordsOfAStrangerReachNoTerminalAsCommands) {
  const std::string words =
      "\x1b]0;owned\x07\x1b[2J\x9b"
      "1m\xe2\x80\xae\rforged\nsoftware    mine";
  {
    trace::RecordingWriter writer(folder_ / "evil.session", {"now", words, words, 1000.0, words, words},
                                  {{words, words}});
    writer.add(trace::RecordingWorld{"", "", words, 1, 1, {{"", ""}}});
    writer.add(trace::RecordingEvent{0, std::nullopt, words, words});
    writer.add(trace::Sample{});
    writer.finish(words);
  }
  std::ofstream(folder_ / "evil.toml") << "\x1b[2J = 1\n";
  for (const char* command : {"recording info evil.session", "recording list .", "recording list . --json",
                              "recording info evil.session --json", "simulate evil.toml",
                              "recording join evil.session evil.session -o both.session"}) {
    const CommandResult result = palpate(command);
    const std::string said = result.out + result.err;
    EXPECT_FALSE(said.empty());
    EXPECT_EQ(said.find_first_of("\x1b\x07\x7f\r\x9b"), std::string::npos) << command << ": " << said;
    EXPECT_EQ(said.find("\nsoftware    mine"), std::string::npos) << command;
    EXPECT_EQ(said.find("\xe2\x80\xae"), std::string::npos) << command;
  }
}

TEST_F(RecordingTools, OneFileThatWasMadeToHangItsReaderDoesNotStopTheList) {
  record();
  std::filesystem::copy_file(folder_ / "results/run.session", folder_ / "a.session");
  trace::Database(folder_ / "a.session", trace::Database::Mode::write)
      .run(
          "DROP TABLE columns; CREATE VIEW columns AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) "
          "SELECT i AS position, 'tick' AS name, 'u64' AS type FROM n WHERE i < 0");
  const CommandResult list = palpate("recording list .");
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.out.find("a.session: contains the view 'columns'"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("run.session  "), std::string::npos) << list.out;
  EXPECT_EQ(palpate("recording info a.session").exit_code, 2);
  EXPECT_EQ(palpate("recording repair a.session -o sound.session").exit_code, 0) << "which reads no SQL";
}

TEST_F(RecordingTools, ANameThatBeginsLikeAFormulaIsNoneInATable) {
  {
    trace::RecordingWriter writer(folder_ / "a.session", {"now", "", "", 1000.0, "", ""}, {{"=1+1,2", "mouse"}});
    writer.add(trace::RecordingWorld{"", "", "torso", 1, 1, {{"", ""}}});
    writer.add(trace::Sample{});
    writer.finish("done");
  }
  ASSERT_EQ(palpate("recording export a.session --csv safe.csv").exit_code, 0);
  ASSERT_EQ(palpate("recording export a.session --csv raw.csv --raw").exit_code, 0);
  EXPECT_NE(contentOf(folder_ / "safe.csv").find("\n0,\"'=1+1,2\","), std::string::npos);
  EXPECT_NE(contentOf(folder_ / "raw.csv").find("\n0,\"=1+1,2\","), std::string::npos);
  EXPECT_EQ(palpate("recording export a.session --json a.json --raw").exit_code, 2);
}

// --- export ---

TEST_F(RecordingTools, EveryColumnComesOutForNumPy) {
  record();
  ASSERT_EQ(palpate("recording export results/run.session --npz run.npz --csv run.csv --from 0.2 --to 1.1").exit_code,
            0);
  // With nothing but what comes with Python: an archive of .npy files, each with a head that says its type and shape.
  std::ofstream(folder_ / "read.py") << R"(
import ast, csv, struct, zipfile
arrays = {}
with zipfile.ZipFile('run.npz') as npz:
    assert npz.testzip() is None
    for name in npz.namelist():
        data = npz.read(name)
        assert data[:8] == b'\x93NUMPY\x01\x00' and name.endswith('.npy'), name
        size = struct.unpack('<H', data[8:10])[0]
        assert (10 + size) % 64 == 0 and data[9 + size:10 + size] == b'\n', name
        head = ast.literal_eval(data[10:10 + size].decode('latin1'))
        assert head['fortran_order'] is False
        code = {'<f8': 'd', '<u8': 'Q', '<u4': 'I'}[head['descr']]
        count = head['shape'][0] if head['shape'] else 1
        assert len(data) == 10 + size + count * struct.calcsize(code), name
        arrays[name[:-4]] = struct.unpack('<%d%s' % (count, code), data[10 + size:])
assert arrays['ticks_per_s'] == (1000.0,)
rows = [row for row in csv.DictReader(open('run.csv')) if row['finger'] == 'finger_2']
assert len(rows) == 901 == len(arrays['finger_2.tick']), len(rows)
for i, row in enumerate(rows):
    assert arrays['finger_2.tick'][i] == 200 + i
    for name, there in (('force_x_n', 'force_x_n'), ('depth_mm', 'depth_mm'), ('tip_z_mm', 'tip_z_mm')):
        if there in row: assert float(row[there]) == arrays['finger_2.' + name][i], (i, name)
    assert ['free', 'stick', 'slip'][arrays['finger_2.touch'][i]] == row['state']
print(len(arrays))
)";
  const auto python = support::runProgram("/bin/sh", "-c \"cd '" + folder_.path().string() + "' && python3 read.py\"");
  ASSERT_EQ(python.exit_code, 0) << python.err;
  EXPECT_EQ(std::stoul(python.out), 1 + 2 * trace::sampleColumns().size());
}

TEST_F(RecordingTools, TheSkinOfAMomentIsThatOfTheRun) {
  std::ofstream(folder_ / "scene.toml") << "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n[[finger]]\nname = "
                                           "\"index\"\ntrajectory = \"path.csv\"\n[output]\nsurfaces_at_s = [0.35]\n";
  ASSERT_EQ(palpate("simulate scene.toml --no-pictures --session").exit_code, 0);
  ASSERT_EQ(palpate("recording export results/run.session --ply skin.ply --at 0.35").exit_code, 0);
  EXPECT_EQ(contentOf(folder_ / "skin.ply"), contentOf(folder_ / "results/surface_0.350s.ply"));
  ASSERT_EQ(palpate("recording export results/run.session --ply deepest.ply").exit_code, 0);
  EXPECT_EQ(contentOf(folder_ / "deepest.ply"), contentOf(folder_ / "results/surface_deepest.ply"));
  mesh::save(folder_ / "dome.obj", zoo::dome({-100.0, -100.0}, 10.0, 21.0));
  EXPECT_NE(palpate("recording export results/run.session --ply skin.ply --at 0.35").out.find("not the recorded one"),
            std::string::npos);
  const CommandResult picture = palpate("render results/run.session --size 80x60 --at 0.35");
  EXPECT_NE(picture.out.find("not the recorded one"), std::string::npos) << picture.out;
  mesh::save(folder_ / "dome.obj", zoo::grid(2, 50.0));
  const CommandResult other = palpate("recording export results/run.session --ply skin.ply --at 0.35");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("differs from the recorded one"), std::string::npos) << other.err;
}

TEST_F(RecordingTools, PicturesAndSoundsComeOutByTheirTime) {
  {
    trace::RecordingWriter writer(folder_ / "a.session", trace::RecordingHeader(), {{"index", "script"}});
    writer.add(trace::RecordingWorld{"", "", "torso", 1, 1, {{"", ""}}});
    writer.add(trace::Sample{});
    writer.add(trace::RecordingAttachment{2500, "sound", "../../note", "audio/wav", "RIFF"});
    writer.add(trace::RecordingAttachment{1250, "picture", "p", "image/png", "PNG"});
    writer.add(trace::RecordingAttachment{0, "file", "body.obj", "", "v 0 0 0"});
    writer.finish("done");
  }
  ASSERT_EQ(palpate("recording export a.session --attachments notes").exit_code, 0);
  EXPECT_EQ(contentOf(folder_ / "notes/0001_picture_1.250s.png"), "PNG");
  EXPECT_EQ(contentOf(folder_ / "notes/0002_sound_2.500s.wav"), "RIFF");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "notes"), {}), 2);
}

// --- pictures ---

TEST_F(RecordingTools, ARecordingIsDrawnAsTheRunWas) {
  std::ofstream(folder_ / "scene.toml") << "[body]\nkind = \"mesh\"\nfile = \"dome.obj\"\n[[finger]]\nname = "
                                           "\"index\"\ntrajectory = \"path.csv\"\n";
  ASSERT_EQ(palpate("simulate scene.toml --no-pictures --session").exit_code, 0);
  const std::string look = " --at 0.35 --frames 2 --fps 4 --size 160x120 --supersampling 1";
  const auto run = jsonFrom("render scene.toml -o run.png" + look);
  const auto recording = jsonFrom("render results/run.session -o recording.png" + look);
  for (const char* number : {"_0001.png", "_0002.png"}) {
    EXPECT_EQ(contentOf(folder_ / (std::string("recording") + number)),
              contentOf(folder_ / (std::string("run") + number)));
  }
  EXPECT_EQ(recording["pictures"][1]["fingers"], run["pictures"][1]["fingers"]);
  palpate("recording bundle results/run.session -o bundle.session --include .");
  std::filesystem::remove(folder_ / "dome.obj");
  EXPECT_EQ(palpate("render bundle.session -o bundle.png --size 80x60 --at 0.35").exit_code, 0);
  EXPECT_EQ(palpate("render bundle.session -o bundle.png --size 80x60 --at 9").exit_code, 2);
  EXPECT_EQ(palpate("render bundle.session -o bundle.png --size 80x60 --radius-mm 4").exit_code, 2);
}

TEST_F(RecordingTools, ARecordingOfEveryVersionIsSalvagedWhole) {
  int versions = 0;
  for (const auto& version : std::filesystem::directory_iterator(support::testData() / "sessions")) {
    if (!version.is_directory()) continue;
    for (const auto& file : std::filesystem::directory_iterator(version)) {
      if (file.path().extension() != ".session") continue;
      ++versions;
      const auto repair = jsonFrom("recording repair '" + file.path().string() + "' -o mended.session");
      EXPECT_EQ(repair["nothing_lost"], true) << file.path();
      const auto was =
          jsonFrom("recording replay '" + file.path().string() + "' --folder '" + version.path().string() + "'");
      const auto is = jsonFrom("recording replay mended.session --folder '" + version.path().string() + "'");
      EXPECT_EQ(is["ticks"], was["ticks"]) << file.path();
      EXPECT_EQ(repair["samples"].get<int>(), is["ticks"].get<int>() + is["unproven"].get<int>()) << file.path();
    }
  }
  EXPECT_GE(versions, 2);
}

// --- wrong input ---

TEST_F(RecordingTools, WrongInputIsOneLineAndExitTwo) {
  record();
  std::ofstream(folder_ / "text.session") << "hello";
  for (const char* arguments :
       {"recording trim results/run.session", "recording trim results/run.session -o results/run.session --from 0.5",
        "recording trim results/run.session -o a.session --from 3",
        "recording trim results/run.session -o a.session --from 2 --to 1", "recording trim text.session -o a.session",
        "recording join results/run.session -o a.session",
        "recording join results/run.session text.session -o a.session",
        "recording join results/run.session results/run.session -o results/run.session",
        "recording repair text.session -o a.session", "recording repair results/run.session -o results/run.session",
        "recording repair results/run.session -o a.session --no-weld",
        "recording repair results/run.session -o a.session --unit m", "recording repair none.session -o a.session"}) {
    const CommandResult result = palpate(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << arguments << ": " << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.session")) << arguments;
  }
  EXPECT_NE(
      palpate("recording repair results/run.session -o a.session --no-weld").err.find("--no-weld applies to meshes"),
      std::string::npos);
  EXPECT_EQ(palpate("recording replay results/run.session --verify").exit_code, 0) << "the source is as it was";
}

}  // namespace
}  // namespace palpate
