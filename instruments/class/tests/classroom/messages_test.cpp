// Messages of a class come back as they went out, keep their size whatever is in them, and what is not exactly one is
// none.
#include "palpate/classroom/messages.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "palpate/classroom/class_settings.h"
#include "teach/tests/training/records_samples.h"

namespace palpate::classroom {
namespace {

namespace samples = training::samples;

const Envelope kEnvelope{42, samples::id(9, 1), 1234.5};
const Envelope kLongEnvelope{9'999'999'999U, samples::id(9, 2), 99'999'999.999};

LiveSample aLiveSample() {
  LiveSample live;
  live.finger_mm = {-12.3, 45.6, 120.7};
  live.force_n = 1.25;
  live.depth_mm = 4.5;
  live.site = 7;
  live.sites_pressed = 5;
  return live;
}

StationState aState() {
  StationState state;
  state.session = samples::id(2, 1);
  state.trainee = samples::trainee().id;
  state.kind = training::SessionKind::exam;
  state.screen = training::Screen::trial;
  state.trial = 12;
  state.trials_at_most = 40;
  state.change = 0.28;
  state.threshold = 0.1833;
  state.low = 0.13;
  state.high = 0.25;
  state.wrong_in_a_row = 2;
  state.sites_skipped = 1;
  state.palpate_force_n = 1.5;
  return state;
}

TEST(ClassMessages, LiveSampleComesBack) {
  const auto read = parseLive(liveText(kEnvelope, aLiveSample()));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->envelope.sequence, 42U);
  EXPECT_EQ(read->envelope.id, kEnvelope.id);
  EXPECT_DOUBLE_EQ(read->envelope.monotonic_s, 1234.5);
  EXPECT_LT((read->content.finger_mm - aLiveSample().finger_mm).norm(), 1e-9);
  EXPECT_DOUBLE_EQ(read->content.force_n, 1.25);
  EXPECT_EQ(read->content.site, 7);
  EXPECT_EQ(read->content.sites_pressed, 5);
}

TEST(ClassMessages, LiveSampleHasAtMostTwoHundredBytesWhateverIsMeasured) {
  LiveSample live = aLiveSample();
  for (const double value : {-1e300, 1e300, -98765.4321, std::nan(""), 0.1 + 0.2}) {
    live.finger_mm.setConstant(value);
    live.force_n = live.depth_mm = value;
    live.site = live.sites_pressed = 40;
    live.phase = training::Screen::familiarisation;
    const std::string text = liveText(kLongEnvelope, live);
    EXPECT_LE(text.size(), 200U) << text;
    EXPECT_TRUE(parseLive(text)) << text;
  }
}

TEST(ClassMessages, StateStatusAndCommandComeBack) {
  const auto state = parseState(stateText(kEnvelope, aState()));
  ASSERT_TRUE(state);
  EXPECT_EQ(state->content, aState());
  const StationStatus status{true, "palpate 0.9", "Touch \"left\"", "ok"};
  const auto read_status = parseStatus(statusText(kEnvelope, status));
  ASSERT_TRUE(read_status);
  EXPECT_EQ(read_status->content, status);
  const Command command{CommandKind::message, "Press harder – ½ N is too light."};
  const auto read_command = parseCommand(commandText(kEnvelope, command));
  ASSERT_TRUE(read_command);
  EXPECT_EQ(read_command->content, command);
}

TEST(ClassMessages, NoCommandTouchesForceOrDevice) {
  for (const char* word : {"force", "device", "stop", "gain", "exec"}) {
    std::string text = commandText(kEnvelope, {CommandKind::pause, {}});
    text.replace(text.find("pause"), 5, word);
    EXPECT_FALSE(parseCommand(text)) << text;
  }
  EXPECT_EQ(enumNames<CommandKind>().size(), 4U);
}

TEST(ClassMessages, LongTextOfACommandIsCutBetweenLetters) {
  std::string text;
  for (int i = 0; i < 150; ++i) text += "é";
  const auto read = parseCommand(commandText(kEnvelope, {CommandKind::message, text}));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->content.text, text.substr(0, 200));
}

TEST(ClassMessages, RowOfAnyLengthComesBackWithinFourKilobytes) {
  Random random(3);
  for (const std::size_t outcomes : {0U, 60U, 400U}) {
    training::BlockRow block = samples::block(samples::session(samples::trainee(), 1), 1);
    block.state_json = R"({"seed":"7","outcomes":[)";
    for (std::size_t i = 0; i < outcomes; ++i) {
      block.state_json += std::string(i == 0 ? "" : ",") + "[" + std::to_string(random.below(13)) + ",1,12,1]";
    }
    block.state_json += "]}";
    const std::string body = training::rowJson(block);
    const std::string text = rowText(kEnvelope, body);
    EXPECT_LE(text.size(), kMaxMessageBytes) << outcomes;
    const auto read = parseRowMessage(text);
    ASSERT_TRUE(read) << outcomes;
    EXPECT_EQ(training::rowJson(training::rowFromJson("block", read->body)), body);
    EXPECT_EQ(training::outboxKey(training::rowFromJson("block", read->body)), training::outboxKey(block));
  }
}

TEST(ClassMessages, AMessageHasFourThousandAndNinetySixBytesAtMost) {
  const auto blanks = [](const std::string& text, std::size_t bytes) {
    std::string longer = text;
    longer.insert(text.find('{') + 1, bytes - text.size(), ' ');
    return longer;
  };
  const std::string live = liveText(kEnvelope, aLiveSample());
  EXPECT_TRUE(parseLive(blanks(live, 200)));
  EXPECT_FALSE(parseLive(blanks(live, 201))) << "many a second";
  const std::string state = stateText(kEnvelope, aState());
  EXPECT_TRUE(parseState(blanks(state, 4096)));
  EXPECT_FALSE(parseState(blanks(state, 4097)));
  const std::string row = rowText(kEnvelope, training::rowJson(samples::trainee()));
  EXPECT_TRUE(parseRowMessage(blanks(row, 100'000)));
  EXPECT_FALSE(parseRowMessage(blanks(row, 100'001)));
  const std::string ack = ackTexts(kEnvelope, std::vector{samples::id(8, 1)}).front();
  EXPECT_TRUE(parseAck(blanks(ack, 4096)));
  EXPECT_FALSE(parseAck(blanks(ack, 4097)));
}

TEST(ClassMessages, ARowThatUnpacksToMoreThanAnyRowIsRefused) {
  const std::string bomb = rowText(kEnvelope, "\"" + std::string(1'000'000, 'a') + "\"");
  EXPECT_LT(bomb.size(), kMaxMessageBytes);  // it would be taken for its size
  EXPECT_FALSE(parseRowMessage(bomb));
}

TEST(ClassMessages, AcknowledgementsAreSharedOutOverMessages) {
  std::vector<training::Uuid> keys;
  for (std::uint64_t i = 0; i < 500; ++i) keys.push_back(samples::id(8, i));
  std::vector<training::Uuid> read;
  for (const std::string& text : ackTexts(kEnvelope, keys)) {
    EXPECT_LE(text.size(), kMaxMessageBytes);
    const auto some = parseAck(text);
    ASSERT_TRUE(some);
    read.insert(read.end(), some->begin(), some->end());
  }
  EXPECT_EQ(read, keys);
}

TEST(ClassMessages, WhatIsNotExactlyAMessageIsNone) {
  const std::string good = liveText(kEnvelope, aLiveSample());
  ASSERT_TRUE(parseLive(good));
  const auto json = nlohmann::json::parse(good);
  for (const auto& [name, value] : json.items()) {
    auto without = json;
    without.erase(name);
    EXPECT_FALSE(parseLive(without.dump())) << name;
    auto other = json;
    other[name] = value.is_string() ? nlohmann::json(7) : nlohmann::json("x");
    EXPECT_FALSE(parseLive(other.dump())) << name;
  }
  auto more = json;
  more["x"] = 1;
  EXPECT_FALSE(parseLive(more.dump()));
  for (const std::string& text :
       {std::string(), std::string("[]"), std::string("null"), good.substr(0, good.size() - 1),
        std::string(100000, '['), good + good, stateText(kEnvelope, aState())}) {
    EXPECT_FALSE(parseLive(text)) << text.substr(0, 40);
  }
  for (std::size_t cut = 0; cut < good.size(); ++cut) EXPECT_FALSE(parseLive(good.substr(0, cut)));
}

TEST(ClassMessages, TopicsAreReadStrictly) {
  const auto topic = parseTopic("palpate/v1/osteo-1/st/s07/trial");
  ASSERT_TRUE(topic);
  EXPECT_EQ(topic->class_id, "osteo-1");
  EXPECT_EQ(topic->station, "s07");
  EXPECT_EQ(topic->kind, "trial");
  EXPECT_TRUE(isRowKind(topic->kind));
  EXPECT_FALSE(isRowKind("live"));
  for (const char* other :
       {"", "palpate/v1/osteo-1/st/s07", "palpate/v1/osteo-1/st/s07/trial/x", "palpate/v2/osteo-1/st/s07/trial",
        "palpate/v1/osteo-1/st/instructor/trial", "palpate/v1/osteo-1/st/ingest/ack",
        "palpate/v1/osteo-1/st/instructor+/trial", "palpate/v1/Osteo/st/s07/trial", "palpate/v1/osteo-1/st/ s07/trial",
        "$SYS/broker/uptime"}) {
    EXPECT_FALSE(parseTopic(other)) << other;
  }
}

}  // namespace
}  // namespace palpate::classroom
