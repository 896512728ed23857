#include "palpate/training/protocol.h"

#include <gtest/gtest.h>

#include "palpate/base/error.h"
#include "support/error_message.h"

namespace palpate::training {
namespace {

TEST(Protocol, WhatIsWrittenIsReadAgain) {
  Protocol protocol = builtInProtocol();
  protocol.id = "own-1";
  protocol.version = 3;
  protocol.title = "with \"quotes\" and \\";
  protocol.sites = {"T6 left 30 mm", "T6 right 30 mm", "T10"};
  protocol.hidden.depth_mm = 7.5;
  protocol.exam.block.stop.mark = 0.28;
  protocol.practice.natural_stiffness = true;
  for (SessionSettings* settings : {&protocol.practice, &protocol.mastery, &protocol.pre_test, &protocol.post_test,
                                    &protocol.exam, &protocol.retention}) {
    settings->block.choices = 3;
  }
  const std::string text = protocolText(protocol);
  const Protocol again = parseProtocol(text, "own.toml");
  EXPECT_EQ(protocolText(again), text);
  EXPECT_EQ(again.title, protocol.title);
  EXPECT_EQ(again.exam.block.stop.mark, 0.28);
  EXPECT_EQ(again.practice.block.levels, protocol.practice.block.levels);
  EXPECT_EQ(again.practice.block.choices, 3);
  EXPECT_EQ(protocolSha256(again), protocolSha256(protocol));
  EXPECT_NE(protocolSha256(again), protocolSha256(builtInProtocol()));
}

TEST(Protocol, LumpsAreWrittenAndReadAgain) {
  Protocol protocol = builtInLumpProtocol();
  protocol.lump->diameters_mm = {4.0, 6.5, 12.0};
  protocol.lump->empty_share = 0.4;
  protocol.lump->pad_shown = true;
  protocol.lump->most_false = 2;
  const Protocol again = parseProtocol(protocolText(protocol), "own.toml");
  EXPECT_EQ(again.lump, protocol.lump);
  EXPECT_EQ(protocolSha256(again), protocolSha256(protocol));
  EXPECT_EQ(protocolNamed("lumps").lump, lumps::LumpTask());
}

/// Records that were made before there were lumps name the hash of their protocol.
TEST(Protocol, WithoutLumpsNothingIsSaidOfThem) {
  EXPECT_EQ(protocolText(builtInProtocol()).find("lump"), std::string::npos);
  EXPECT_FALSE(parseProtocol(protocolText(builtInProtocol()), "own.toml").lump);
}

TEST(Protocol, DefaultsAreThoseThatAreDocumented) {
  const Protocol protocol = builtInProtocol();
  EXPECT_EQ(protocol.pre_test.block.method, Method::marginal_psi);
  EXPECT_EQ(protocol.pre_test.block.stop.most, 40);
  EXPECT_EQ(protocol.pre_test.block.warm_up, 3);
  EXPECT_EQ(protocol.pre_test.block.easy, 4);
  EXPECT_FALSE(protocol.pre_test.feedback);
  EXPECT_EQ(protocol.pre_test.block.draw, SiteDraw::independent);
  EXPECT_TRUE(protocol.practice.feedback);
  EXPECT_EQ(protocol.practice.block.draw, SiteDraw::balanced);
  EXPECT_EQ(protocol.exam.block.stop.mark, 0.20);
  EXPECT_EQ(protocol.exam.block.stop.most, 60);
}

struct WrongProtocol {
  const char* text;
  const char* told;
};

class WrongProtocols : public testing::TestWithParam<WrongProtocol> {};

TEST_P(WrongProtocols, AreRefusedWithTheirLineAndInOneLine) {
  const std::string message = support::thrownMessage([] { parseProtocol(GetParam().text, "own.toml"); });
  EXPECT_NE(message.find(GetParam().told), std::string::npos) << message;
  EXPECT_EQ(message.find("own.toml:"), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Protocol, WrongProtocols,
    testing::Values(WrongProtocol{"\nbase = 3\n", "own.toml:2"}, WrongProtocol{"id = 'a b'", "letters"},
                    WrongProtocol{"[exam]\nmost = 0\n", "own.toml:2"},
                    WrongProtocol{"[exam]\nmethod = 'psi'\n", "marginal_psi"},
                    WrongProtocol{"[exam]\nlevels_percent = [0, 3]\n", "own.toml:2"},
                    WrongProtocol{"[exam]\nleast = 30\nmost = 20\n", "own.toml:1"},
                    WrongProtocol{"sites = ['T6']", "one site"}, WrongProtocol{"hidden = 3", "[hidden]"},
                    WrongProtocol{"[hidden]\nradius_mm = 1e9", "own.toml:2"}, WrongProtocol{"x = [", "own.toml:1"},
                    WrongProtocol{"[lump]\nratios = [5, 3, 20]\n", "own.toml:2"},
                    WrongProtocol{"[lump]\ndepths_mm = [1, 3, 5]\n", "out of range"},
                    WrongProtocol{"[lump]\ndiameters_mm = [3, 5]\n", "three numbers"},
                    WrongProtocol{"[lump]\nempty = 1\n", "empty_share"},
                    WrongProtocol{"[pre_test]\nmeaning = 'cue'\n", "own.toml:1"},
                    // The parser's message quotes the end of the line.
                    WrongProtocol{"[exam]\nfeedback = f\ndraw = 'balanced'\n", "own.toml:"}));

}  // namespace
}  // namespace palpate::training
