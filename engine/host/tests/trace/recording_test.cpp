// Recording files: the same bits back, whatever ends the writer, and nothing but an error from what is damaged.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <cstring>
#include <fstream>
#include <limits>
#include <thread>

#include "host/tests/trace/whole_recording.h"
#include "host/tests/trace/wild_sample.h"
#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/base/text.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_schema.h"
#include "palpate/trace/sample_block.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::trace {
namespace {

void expectSameBits(const Sample& a, const Sample& b) {
  EXPECT_EQ(a.finger, b.finger);
  for (const SampleColumn& column : sampleColumns()) {
    ASSERT_EQ(column.bits(a), column.bits(b)) << column.name << " at tick " << a.tick;
  }
}

TEST(SampleBlock, GivesEveryBitBack) {
  Random random(1);
  std::vector<Sample> samples;
  for (std::uint64_t tick = 0; tick < 137; ++tick) samples.push_back(wildSample(random, 3 * tick + 5, 1));
  const SampleBlock block = packSamples(samples);
  const std::vector<Sample> back = unpackSamples(block.bytes, block.crc32, samples.size(), 1);
  ASSERT_EQ(back.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) expectSameBits(samples[i], back[i]);
}

TEST(SampleBlock, HoldsAllOfASample) {
  // What a new member of Sample adds must get a column, or replays would lose it; tissue_mm follows from the place,
  // finger_mm from the settings.
  EXPECT_EQ(sizeof(contact::FingerOutput), 8 * sizeof(Vec3) + sizeof(Vec2) + 6 * sizeof(double) + 16 + 8 + 8);
  EXPECT_EQ(sizeof(Sample), 16 + sizeof(contact::FingerOutput) + sizeof(Vec3) + 32);
  EXPECT_EQ(sampleColumns().size(), 1u + 6 * 3 + 1 + 3 + 4 + 5 + 6 + 7);
}

TEST(SampleBlock, RefusesWhatIsDamaged) {
  Random random(2);
  const std::vector<Sample> samples = {wildSample(random, 1, 0), wildSample(random, 2, 0)};
  const SampleBlock block = packSamples(samples);
  std::string bent = block.bytes;
  bent[bent.size() / 2] = static_cast<char>(bent[bent.size() / 2] ^ 1);
  EXPECT_THROW(unpackSamples(bent, block.crc32, 2, 0), Error);
  EXPECT_THROW(unpackSamples(block.bytes, block.crc32, 3, 0), Error);
  EXPECT_THROW(unpackSamples(block.bytes, block.crc32, 1, 0), Error);
  EXPECT_THROW(unpackSamples(block.bytes, block.crc32, std::size_t{1} << 60, 0), Error);
  EXPECT_THROW(packSamples({}), Error);
}

// --- files ---

class RecordingFile : public testing::Test {
 protected:
  static RecordingHeader header() {
    RecordingHeader header;
    header.started_utc = "2026-11-21T12:00:00Z";
    header.software = "test";
    header.machine = "bench";
    header.notes = "two fingers";
    header.tags = "practice T6";
    return header;
  }
  static std::vector<RecordingFinger> fingers() { return {{"index", "script"}, {"middle", "mouse"}}; }

  RecordingWriter begin(const std::string& name = "a.session") const { return {folder_ / name, header(), fingers()}; }

  static Sample sample(std::uint64_t tick, std::uint32_t finger) {
    Sample sample;
    sample.tick = tick;
    sample.finger = finger;
    sample.contact.tip = {1.0 + static_cast<double>(tick), 0.1 * finger, 1.0 / (1.0 + static_cast<double>(tick))};
    return sample;
  }

  std::vector<Sample> read(RecordingReader& reader, const TickSpan& span = {}) const {
    std::vector<Sample> all;
    reader.forEachTick(span, [&](std::span<const Sample> tick) {
      all.insert(all.end(), tick.begin(), tick.end());
      return true;
    });
    return all;
  }

  support::TemporaryFolder folder_;
};

TEST(RecordingVersion, ASceneThatNamedNoBodyMeantTheTorsoBeforeTheTrunkWasMade) {
  const std::string tissue =
      "\n[deformation]\ntissue = \"gaussian\"\n\n[tissue]\nnarrow_bone = false\nby_finger_radius = false\n";
  EXPECT_EQ(sceneOfVersion(2, "title = \"a\"\n"), "title = \"a\"\n\n[body]\nkind = \"torso\"\n" + tissue);
  EXPECT_EQ(sceneOfVersion(1, "[body]\ntriangles = 8163\n\n[view]\nkind = 1\n"),
            "[body]\nkind = \"torso\"\ntriangles = 8163\n\n[view]\nkind = 1\n" + tissue);
  const std::string mesh = "[body]\nscale = 2\nkind = \"mesh\"\nfile = \"a.ply\"\n";
  EXPECT_EQ(sceneOfVersion(2, mesh), mesh + tissue);
}

TEST(RecordingVersion, ASceneThatNamedNoTissueMeantTheHalfGaussianBeforeLayersWereTheRule) {
  const std::string radius = "\n[tissue]\nnarrow_bone = false\nby_finger_radius = false\n";
  EXPECT_EQ(sceneOfVersion(3, "title = \"a\"\n"), "title = \"a\"\n\n[deformation]\ntissue = \"gaussian\"\n" + radius);
  const std::string layered = "[deformation]\ntissue = \"layered\"\n";
  EXPECT_EQ(sceneOfVersion(3, layered), layered + radius);
}

TEST(RecordingVersion, LayersPushedBackOnEveryFingerAsOnAFingertipBeforeTheRadiusCounted) {
  EXPECT_EQ(sceneOfVersion(4, "[tissue]\nfat_mm = 8\n"),
            "[tissue]\nnarrow_bone = false\nby_finger_radius = false\nfat_mm = 8\n");
}

TEST(RecordingVersion, AllBoneWasFeltAsWideBeforeNarrowBoneWasTheRule) {
  EXPECT_EQ(sceneOfVersion(5, "[tissue]\nfat_mm = 8\n"), "[tissue]\nnarrow_bone = false\nfat_mm = 8\n");
  EXPECT_EQ(sceneOfVersion(5, "[tissue]\nnarrow_bone = true\n"), "[tissue]\nnarrow_bone = true\n");
  EXPECT_EQ(sceneOfVersion(6, "title = \"a\"\n"), "title = \"a\"\n");
}

TEST_F(RecordingFile, GivesBackHeaderWorldsEventsAndTicks) {
  {
    RecordingWriter writer = begin();
    writer.add(
        RecordingWorld{"[body]\n", "/tmp", "torso", 20389, 0xfeedull, {{"radius_mm = 8", "limited = 1"}, {"", ""}}});
    for (std::uint64_t tick = 10; tick < 1000; ++tick) {
      writer.add(sample(tick, 0));
      if (tick > 400) writer.add(sample(tick, 1));
    }
    writer.add(RecordingEvent{500, 1u, "mark", "here"});
    writer.add(RecordingEvent{700, std::nullopt, "note", "all"});
    writer.setDropped(3);
    writer.finish("done");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.session-wal")) << "one file";
  RecordingReader reader(folder_ / "a.session");
  const RecordingFacts& facts = reader.facts();
  EXPECT_EQ(facts.header.notes, "two fingers");
  EXPECT_EQ(facts.header.tags, "practice T6");
  EXPECT_EQ(facts.ended_by, "done");
  EXPECT_EQ(facts.dropped, 3u);
  EXPECT_EQ(facts.samples, 990u + 599u);
  EXPECT_EQ(facts.first_tick, 10u);
  EXPECT_EQ(facts.last_tick, 999u);
  ASSERT_EQ(facts.fingers.size(), 2u);
  EXPECT_EQ(facts.fingers[1].device, "mouse");
  EXPECT_EQ(reader.world(0).hash, 0xfeedull);
  EXPECT_EQ(reader.world(0).fingers[0].contact, "radius_mm = 8");
  EXPECT_THROW(reader.world(1), Error);
  ASSERT_EQ(reader.events().size(), 2u);
  EXPECT_EQ(reader.events()[0].finger, 1u);
  EXPECT_FALSE(reader.events()[1].finger);
  EXPECT_EQ(reader.events({600, 700}).size(), 1u);
  const std::vector<Sample> all = read(reader);
  ASSERT_EQ(all.size(), facts.samples);
  for (const Sample& is : all) expectSameBits(is, sample(is.tick, is.finger));
  const std::vector<Sample> some = read(reader, {450, 451});
  ASSERT_EQ(some.size(), 4u);
  EXPECT_EQ(some[0].tick, 450u);
  EXPECT_EQ(some[1].finger, 1u);
  EXPECT_EQ(some[3].tick, 451u);
}

TEST_F(RecordingFile, EverythingIsReadBackUnderItsOwnName) {
  writeWholeRecording(folder_ / "a.session");
  EXPECT_EQ(contentOf(folder_ / "a.session"),
            "2026-11-21T12:00:00Z to 2026-11-21T12:00:09Z: a fault; the software on the machine, 500 a second, 3 "
            "dropped; the notes; the tags\n"
            "finger index, mouse, max_force_n = 3, scale = 2\n"
            "finger middle, touch, rate_hz = 4, \n"
            "world /one, trunk, 11, a1, # first\n"
            "  felt with radius_mm = 8; limited = 1\n"
            "  felt with c; l\n"
            "world /two, dome, 22, b2, # second\n"
            "  felt with radius_mm = 4; \n"
            "  felt with ; limited = 0\n"
            "mark 7 1: here\n"
            "note 9 all: " +
                longText("n") + "\nfile 5: body.obj, , " + longText("v") +
                "\n"
                "picture 30: seen.png, image/png, bytes\n"
                "800 samples from 0 to 399, 2 events, 2 attachments\n");
}

TEST_F(RecordingFile, AnEarlierOneStaysUntilTheNextIsFinished) {
  begin().finish("first");
  RecordingWriter next = begin();
  next.add(sample(0, 0));
  next.flush();
  EXPECT_EQ(RecordingReader(folder_ / "a.session").facts().ended_by, "first");
  EXPECT_EQ(RecordingReader(next.partial()).facts().samples, 1u);
  next.finish("second");
  EXPECT_EQ(RecordingReader(folder_ / "a.session").facts().ended_by, "second");
}

TEST_F(RecordingFile, WithoutAnEndStaysUnderItsPartialName) {
  {
    RecordingWriter writer = begin();
    writer.add(sample(0, 0));
    writer.flush();
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.session"));
  EXPECT_EQ(RecordingReader(folder_ / "a.session.partial").facts().ended_by, "");
}

TEST_F(RecordingFile, OfNothingIsNotLeftBehind) {
  { begin(); }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(RecordingFile, CanBeReadWhileItIsWritten) {
  RecordingWriter writer = begin();
  for (std::uint64_t tick = 0; tick < 400; ++tick) writer.add(sample(tick, 0));
  RecordingReader reader(writer.partial());
  EXPECT_EQ(reader.facts().samples, 300u) << "whole parts of 150 ms";
  EXPECT_EQ(reader.facts().ended_by, "");
  writer.finish("done");
  EXPECT_EQ(RecordingReader(folder_ / "a.session").facts().samples, 400u) << "complete in spite of the reader";
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.session.partial-wal"));
}

TEST_F(RecordingFile, SaysWhatIsNoRecording) {
  std::ofstream(folder_ / "text.session") << "hello";
  std::ofstream(folder_ / "empty.session") << "";
  EXPECT_THROW(RecordingReader(folder_ / "text.session"), Error);
  EXPECT_THROW(RecordingReader(folder_ / "empty.session"), Error);
  EXPECT_THROW(RecordingReader(folder_ / "none.session"), Error);
  EXPECT_THROW(RecordingReader(folder_.path()), Error);
  Database foreign(folder_ / "foreign.session", Database::Mode::create);
  foreign.run("CREATE TABLE session(id)");
  EXPECT_EQ(support::thrownMessage([&] { RecordingReader(folder_ / "foreign.session"); }),
            (folder_ / "foreign.session").string() + ": is not a recording file of Palpate");
  begin("later.session").finish("done");
  Database(folder_ / "later.session", Database::Mode::write).run("PRAGMA user_version = 99");
  EXPECT_EQ(
      support::thrownMessage([&] { RecordingReader(folder_ / "later.session"); }),
      (folder_ / "later.session").string() + ": is a recording of version 99; this program reads versions up to 6");
}

TEST_F(RecordingFile, NamesABlockThatIsDamaged) {
  {
    RecordingWriter writer = begin();
    for (std::uint64_t tick = 0; tick < 400; ++tick) writer.add(sample(tick, 0));
    writer.finish("done");
  }
  Database(folder_ / "a.session", Database::Mode::write).run("UPDATE blocks SET crc32 = crc32 + 1 WHERE id = 2");
  RecordingReader reader(folder_ / "a.session");
  EXPECT_EQ(support::thrownMessage([&] { read(reader); }),
            (folder_ / "a.session").string() + ": block 2: block checksum mismatch");
  ASSERT_EQ(reader.damagedBlocks().size(), 1u);
  EXPECT_EQ(reader.damagedBlocks()[0].first, 2);
}

TEST_F(RecordingFile, OfAnyBytesIsReadOrRefused) {
  {
    RecordingWriter writer = begin();
    for (std::uint64_t tick = 0; tick < 400; ++tick) writer.add(sample(tick, 0));
    writer.finish("done");
  }
  const std::string sound = readFile(folder_ / "a.session", 1 << 24);
  Random random(5);
  int read_through = 0;
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::string bent = sound;
    for (int i = 0; i < 1 + round % 20; ++i)
      bent[random.below(static_cast<std::uint32_t>(bent.size()))] = static_cast<char>(random.below(256));
    if (round % 5 == 0) bent.resize(random.below(static_cast<std::uint32_t>(bent.size())));
    std::ofstream(folder_ / "bent.session", std::ios::binary) << bent;
    try {
      RecordingReader reader(folder_ / "bent.session");
      read(reader);
      reader.events();
      reader.damagedBlocks();
      ++read_through;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("bent.session: "), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(read_through, 20) << "a byte that is not looked at";
  EXPECT_GT(refused, 100);
}

// --- kill -9 ---

/// Records two fingers, a tick a millisecond, until it is killed; says through the pipe what it has handed over.
[[noreturn]] void recordUntilKilled(const std::filesystem::path& file, int pipe_end) {
  RecordingWriter writer(file,
                         {.started_utc = utcNow(), .software = "test", .machine = "bench", .notes = {}, .tags = {}},
                         {{"left", "a"}, {"right", "b"}});
  const auto started = std::chrono::steady_clock::now();
  for (std::uint64_t tick = 0;; ++tick) {
    std::this_thread::sleep_until(started + std::chrono::milliseconds(tick));
    for (std::uint32_t finger = 0; finger < 2; ++finger) {
      Sample sample;
      sample.tick = tick;
      sample.finger = finger;
      sample.contact.tip = {static_cast<double>(tick), 0.0, static_cast<double>(finger)};
      writer.add(sample);
    }
    if (::write(pipe_end, &tick, sizeof(tick)) != sizeof(tick)) ::_exit(3);
  }
}

TEST_F(RecordingFile, SurvivesKillNineAtAnyMomentWithAtMostTwoHundredMillisecondsLost) {
  const int kills = std::getenv("PALPATE_HEAVY") != nullptr ? 200 : 12;
  Random random(9);
  std::uint64_t most_lost = 0;
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    const std::filesystem::path file = folder_ / ("killed" + std::to_string(kill_number) + ".session");
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) recordUntilKilled(file, ends[1]);
    ::close(ends[1]);
    const int wait_ticks = 1 + static_cast<int>(random.below(700));
    std::uint64_t handed_over = 0;
    for (int i = 0; i < wait_ticks; ++i) ASSERT_EQ(::read(ends[0], &handed_over, sizeof(handed_over)), 8);
    ::kill(child, SIGKILL);
    while (::read(ends[0], &handed_over, sizeof(handed_over)) == 8) {
    }
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
    RecordingReader reader(file.string() + ".partial");
    std::uint64_t next = 0;
    for (const Sample& sample : read(reader)) {
      ASSERT_EQ(sample.tick, next / 2);
      ASSERT_EQ(sample.contact.tip.x(), static_cast<double>(sample.tick));
      ++next;
    }
    EXPECT_TRUE(reader.damagedBlocks().empty());
    EXPECT_EQ(reader.facts().ended_by, "");
    most_lost = std::max(most_lost, handed_over + 1 - next / 2);
  }
  EXPECT_LE(most_lost, 200u);
  RecordProperty("most_lost_ms", static_cast<int>(most_lost));
}

}  // namespace
}  // namespace palpate::trace
