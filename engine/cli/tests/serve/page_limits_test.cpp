// Every limit of `serve` that docs/reference/security.md names, gone up to and over: what a page may do to a finger,
// how many connections there may be, and how long one may get nowhere.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "cli/serve/access.h"
#include "cli/serve/finger_control.h"
#include "cli/serve/network.h"
#include "cli/serve/visit_book.h"
#include "cli/tests/serve/plain_stream.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace palpate::app::serving {
namespace {

using support::ask;
using support::PlainStream;
using support::PlainWire;

// --- a page's finger

constexpr WatcherId kPage = 7;
constexpr WatcherId kOther = 8;

/// A body of 100 mm, and what the servo is told of its one finger.
struct PageFinger {
  device::FingerTarget target;
  std::vector<bool> halts;
  FingerControl control{{{"left", 8.0, ""}},
                        Box3(Vec3::Constant(-50.0), Vec3::Constant(50.0)),
                        [this](std::size_t, const device::FingerTarget& to) { target = to; },
                        [this](bool halted) { halts.push_back(halted); }};

  std::string press(const Vec3& place, double now_s, double depth_mm = 6.0, std::optional<double> force_n = {}) {
    return control.handleRequest(kPage, Role::control, Point{0, true, place, Vec3::UnitZ(), depth_mm, force_n}, now_s);
  }
  std::string press(double now_s) { return press(Vec3::Zero(), now_s); }
};

TEST(PageFinger, PressesWithFifteenNewtonsAndNoMore) {
  PageFinger page;
  ASSERT_EQ(page.press(Vec3::Zero(), 0.0, 0.0, 14.9), "");
  EXPECT_EQ(page.target.by, device::PressBy::force);
  EXPECT_EQ(page.target.force_n, 14.9);
  page.press(Vec3::Zero(), 0.1, 0.0, 15.1);
  EXPECT_EQ(page.target.force_n, 15.0);
}

TEST(PageFinger, PressesTwentyFiveMillimetresDeepAndNoDeeper) {
  PageFinger page;
  page.press(Vec3::Zero(), 0.0, 24.9);
  EXPECT_EQ(page.target.by, device::PressBy::depth);
  EXPECT_EQ(page.target.depth_mm, 24.9);
  page.press(Vec3::Zero(), 0.1, 25.1);
  EXPECT_EQ(page.target.depth_mm, 25.0);
  page.press(Vec3::Zero(), 0.2, 0.0, 15.0);
  EXPECT_EQ(page.target.max_depth_mm, 25.0) << "soft skin gives way to a force for ever";
}

TEST(PageFinger, IsLiftedAfterHalfASecondOfSilence) {
  PageFinger page;
  page.press(10.0);
  page.control.tick(10.49);
  EXPECT_TRUE(page.target.pressed);
  page.press(10.49);
  page.control.tick(10.98);
  EXPECT_TRUE(page.target.pressed) << "half a second since it was heard, not since it began";
  page.control.tick(11.0);
  EXPECT_FALSE(page.target.pressed);
  EXPECT_TRUE(page.target.present) << "it rises first";
  page.control.tick(11.49);
  EXPECT_TRUE(page.target.present);
  page.control.tick(11.51);
  EXPECT_FALSE(page.target.present);
}

TEST(PageFinger, LosesItsHolderAfterAMinuteOfSilence) {
  PageFinger page;
  page.press(0.0);
  page.control.handleRequest(kPage, Role::control, Listen{}, 1.0);
  page.control.tick(60.9);
  EXPECT_EQ(page.control.holder(), kPage);
  page.control.tick(61.1);
  EXPECT_EQ(page.control.holder(), 0u);
}

TEST(PageFinger, IsFollowedAtFourHundredMillimetresASecondWhileItPresses) {
  PageFinger page;
  page.press(0.0);
  page.press({4.9, 0, 0}, 0.01);
  EXPECT_EQ(page.target.place, Vec3(4.9, 0, 0)) << "1 mm and 400 mm/s for 10 ms";
  page.press({40, 0, 0}, 0.02);
  EXPECT_NEAR(page.target.place.x(), 9.9, 1e-9);
  page.press({-50, 0, 0}, 5.0);
  EXPECT_NEAR(page.target.place.x(), 9.9 - 41.0, 1e-9) << "a page that froze: at most 0.1 s of way";
  page.control.handleRequest(kPage, Role::control, Lift{}, 6.0);
  page.press({50, 0, 0}, 6.01);
  EXPECT_EQ(page.target.place.x(), 50.0) << "in the air it is wherever it is";
}

TEST(PageFinger, IsNoFartherThanThirtyMillimetresFromTheBody) {
  PageFinger page;
  EXPECT_EQ(page.press({0, 0, 79.9}, 0.0), "");
  EXPECT_EQ(page.press({0, 0, 80.1}, 0.1), "the place is not on the body");
  EXPECT_EQ(page.press({-80.1, 0, 0}, 0.1), "the place is not on the body");
}

TEST(PageFinger, IsOneHoldersAtATime) {
  PageFinger page;
  page.press(0.0);
  EXPECT_EQ(page.control.handleRequest(kOther, Role::control, Take{}, 0.1), "another user controls the finger");
  EXPECT_EQ(page.control.handleRequest(kOther, Role::control, Lift{}, 0.1), "another user controls the finger");
  EXPECT_EQ(page.control.handleRequest(kOther, Role::look, Take{}, 0.1), "this token is for looking on");
  EXPECT_TRUE(page.target.pressed);
  EXPECT_EQ(page.control.handleRequest(kOther, Role::instruct, Take{}, 0.2), "");
  EXPECT_EQ(page.control.holder(), kOther);
  EXPECT_FALSE(page.target.pressed);
  EXPECT_EQ(page.press(0.3), "another user controls the finger");
  page.control.left(kPage, 0.3);
  EXPECT_EQ(page.control.holder(), kOther) << "who has nothing leaves nothing";
  page.control.left(kOther, 0.4);
  EXPECT_EQ(page.control.holder(), 0u);
}

TEST(PageFinger, IsLiftedWhereWhoInstructsPauses) {
  PageFinger page;
  page.press(0.0);
  EXPECT_EQ(page.control.handleRequest(kPage, Role::control, Pause{true}, 0.1), "only an instructor can pause");
  EXPECT_TRUE(page.target.pressed);
  EXPECT_EQ(page.control.handleRequest(kOther, Role::instruct, Pause{true}, 0.1), "");
  EXPECT_FALSE(page.target.pressed);
  EXPECT_EQ(page.press(0.2), "paused by the instructor");
  EXPECT_EQ(page.control.handleRequest(kOther, Role::instruct, Pause{true}, 0.2), "");
  EXPECT_EQ(page.control.handleRequest(kOther, Role::instruct, Pause{false}, 0.3), "");
  EXPECT_EQ(page.halts, (std::vector<bool>{true, false})) << "devices too, once each";
  EXPECT_EQ(page.press(0.4), "");
  page.control.close(0.5);
  EXPECT_FALSE(page.target.pressed);
  EXPECT_NE(page.press(0.6), "") << "the end is the end";
}

TEST(PageFinger, AFingerThatIsNotThereOrThatADeviceHoldsIsRefused) {
  device::FingerTarget target;
  FingerControl control({{"left", 8.0, "touch"}, {"right", 6.0, ""}}, Box3(Vec3::Constant(-50.0), Vec3::Constant(50.0)),
                        [&](std::size_t, const device::FingerTarget& to) { target = to; });
  EXPECT_TRUE(control.hasFreeFinger());
  EXPECT_EQ(control.handleRequest(kPage, Role::control, Point{0, true}, 0.0), "a device moves this finger");
  EXPECT_EQ(control.handleRequest(kPage, Role::control, Point{2, true}, 0.0), "no such finger");
  EXPECT_EQ(control.handleRequest(kPage, Role::control, Point{1, true}, 0.0), "");
  EXPECT_EQ(target.radius_mm, 6.0);
  EXPECT_EQ(control.handleRequest(kPage, Role::control, Lift{2}, 0.0), "no such finger");
}

/// Why the text is no request; empty: it is one.
std::string refusalReason(const std::string& text) {
  std::string why;
  return parseRequest(text, why) ? "" : why;
}

TEST(PageMessage, HasAThousandAndTwentyFourBytesAtMost) {
  std::string text = R"({"type":"take"})";
  text.resize(1024, ' ');
  EXPECT_EQ(refusalReason(text), "");
  EXPECT_EQ(refusalReason(text + " "), "too long");
}

TEST(PageMessage, NumbersBeyondTheirRangeAreNoMessage) {
  const auto point = [](const std::string& finger, const std::string& x, const std::string& how) {
    return R"({"type":"finger","finger":)" + finger + R"(,"pressed":true,"place":[)" + x +
           R"(,0,0],"normal":[0,0,1],)" + how + "}";
  };
  EXPECT_EQ(refusalReason(point("0", "1e5", R"("depth_mm":60)")), "");
  EXPECT_EQ(refusalReason(point("0", "-100001", R"("depth_mm":60)")), "place is out of range");
  EXPECT_EQ(refusalReason(point("0", "0", R"("depth_mm":60.1)")), "depth_mm is out of range");
  EXPECT_EQ(refusalReason(point("0", "0", R"("depth_mm":-0.1)")), "depth_mm is out of range");
  EXPECT_EQ(refusalReason(point("64", "0", R"("force_n":60)")), "");
  EXPECT_EQ(refusalReason(point("0", "0", R"("force_n":60.1)")), "force_n is out of range");
  EXPECT_EQ(refusalReason(point("65", "0", R"("force_n":1)")), "finger is out of range");
  const auto say = [](std::size_t letters) {
    return R"({"type":"message","text":")" + std::string(letters, 'a') + "\"}";
  };
  EXPECT_EQ(refusalReason(say(200)), "");
  EXPECT_EQ(refusalReason(say(201)), "text is too long");
}

TEST(PageMessage, APlaceIsThreeNumbersAndADirectionComesToLengthOne) {
  const auto point = [](const std::string& place, const std::string& normal) {
    return R"({"type":"finger","finger":0,"pressed":true,"place":)" + place + R"(,"normal":)" + normal +
           R"(,"depth_mm":6})";
  };
  EXPECT_EQ(refusalReason(point("[1,2]", "[0,0,1]")), "place is not three numbers");
  EXPECT_EQ(refusalReason(point(R"([1,2,"3"])", "[0,0,1]")), "place is out of range");
  EXPECT_EQ(refusalReason(point("[1,2,3]", "[0,0,0.4]")), "normal has no length");
  std::string why;
  const auto request = parseRequest(point("[1,2,3]", "[0,0,0.6]"), why);
  ASSERT_TRUE(request) << why;
  EXPECT_EQ(std::get<Point>(*request).normal, Vec3::UnitZ());
}

// --- how many connections

TEST(VisitBook, HoldsTwoHundredAndFiftySixStrangersAndSixtyFourOfOneAddress) {
  VisitBook book;
  VisitId id = 0;
  for (; id < 64; ++id) EXPECT_EQ(book.enter(id + 1, "one", static_cast<double>(id)), 0u) << id;
  EXPECT_EQ(book.enter(65, "one", 100.0), 1u);
  for (id = 65; id < 257; ++id) EXPECT_EQ(book.enter(id + 1, std::to_string(id), 101.0), 0u) << id;
  EXPECT_EQ(book.size(), 256u);
  EXPECT_NE(book.enter(1000, "late", 102.0), 0u);
  EXPECT_EQ(book.size(), 256u);
}

TEST(VisitBook, HoldsTwoHundredAndFiftySixThatShowedAToken) {
  VisitBook book;
  for (VisitId id = 1; id <= 256; ++id) {
    book.enter(id, "", static_cast<double>(id));
    EXPECT_EQ(book.markTokenShown(id, static_cast<double>(id)), 0u) << id;
  }
  book.enter(257, "", 300.0);
  EXPECT_EQ(book.markTokenShown(257, 300.0), 1u);
}

// --- over the wire

const std::string kToken = "control-0123456789abcdef";

/// The network alone, with deadlines that a test can wait for.
struct ServedSite {
  support::TemporaryFolder folder;
  Network network;
  explicit ServedSite(const NetworkSettings& settings = {}) : network(withTokens(settings), site(folder), body()) {}

  static NetworkSettings withTokens(NetworkSettings settings) {
    settings.port = 0;
    settings.tokens = {"look-0123456789abcdef", kToken, "instruct-0123456789abcdef"};
    return settings;
  }
  static ServedContent site(const support::TemporaryFolder& folder) {
    std::ofstream(folder / "index.html") << "<!doctype html><head></head>";
    std::ofstream(folder / "large.bin") << std::string(std::size_t{1} << 20, 'x');
    return {Site(folder.path()), {}, {}, Json::object(), nullptr};
  }
  static FingerControl body() {
    return {{{"left", 8.0, ""}}, Box3(Vec3::Constant(-50.0), Vec3::Constant(50.0)), [](std::size_t, const auto&) {}};
  }
};

void wait(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

TEST(ServeLimits, ARequestsHeadHasEightThousandOneHundredAndNinetyTwoBytesAtMost) {
  const ServedSite served;
  const std::string around = "GET / HTTP/1.1\r\nHost: localhost\r\nX: \r\n\r\n";
  const auto status = [&](std::size_t path_bytes, std::size_t head_bytes) {
    PlainWire wire(served.network.port());
    const std::string value(head_bytes - around.size() - path_bytes, 'x');
    return ask(wire, "GET", "/" + std::string(path_bytes, 'x'), "X: " + value + "\r\n").status;
  };
  EXPECT_EQ(status(0, 8192), 200);
  EXPECT_EQ(status(0, 8193), 431);
  EXPECT_EQ(status(4000, 8192), 404);
  EXPECT_EQ(status(4000, 8193), 431) << "first line and others together";
}

TEST(ServeLimits, SixtyFourMayLookOnAndNoMore) {
  const ServedSite served;
  std::vector<std::unique_ptr<PlainStream>> viewers;
  for (int i = 0; i < 64; ++i) {
    viewers.push_back(std::make_unique<PlainStream>(served.network.port(), kToken));
    ASSERT_EQ(viewers.back()->status(), 101) << i;
  }
  ASSERT_TRUE(support::waitFor([&] { return served.network.counts().watchers == 64; }));
  EXPECT_EQ(PlainStream(served.network.port(), kToken).status(), 503);
  EXPECT_EQ(served.network.counts().refused_full, 1u);
}

TEST(ServeLimits, APagesMessageOfAThousandAndTwentyFiveBytesEndsItsStream) {
  const ServedSite served;
  std::string take = R"({"type":"take"})";
  take.resize(1024, ' ');
  PlainStream stream(served.network.port(), kToken);
  stream.say(take);
  EXPECT_TRUE(stream.receiveText(R"("holder":1)"));
  stream.say(take + " ");
  const auto goodbye = stream.receiveKind(8);
  ASSERT_TRUE(goodbye);
  EXPECT_EQ(goodbye->code(), 1009);
}

TEST(ServeLimits, APageMaySendTwoHundredMessagesAtOnceAndNotThreeHundred) {
  const ServedSite served;
  const auto at_once = [](int many) {
    std::string frames;
    for (int i = 0; i < many; ++i) frames += PlainStream::framed(1, R"({"type":"give"})");
    return frames;
  };
  PlainStream modest(served.network.port(), kToken);
  modest.wire().send(at_once(199) + PlainStream::framed(1, R"({"type":"take"})"));
  EXPECT_TRUE(modest.receiveText(R"("holder":1)"));
  PlainStream hasty(served.network.port(), kToken);
  hasty.wire().send(at_once(300));
  const auto goodbye = hasty.receiveKind(8);
  ASSERT_TRUE(goodbye);
  EXPECT_EQ(goodbye->reason(), "too many messages");
}

TEST(ServeLimits, ARequestHasItsTimeAndNoMore) {
  NetworkSettings settings;
  settings.handshake_s = 0.6;
  const ServedSite served(settings);
  PlainWire slow(served.network.port());
  slow.send("GET / HTTP/1.1\r\nHost: lo");
  EXPECT_FALSE(slow.endsWithin(0.3));
  EXPECT_TRUE(slow.endsWithin(5.0));
}

TEST(ServeLimits, EachPieceOfAnAnswerHasItsTimeAndTheWholeMayTakeLonger) {
  NetworkSettings settings;
  settings.piece_s = 0.6;
  const ServedSite served(settings);
  const std::string request = "GET /large.bin HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  PlainWire steady(served.network.port(), nullptr, 4096);
  steady.send(request);
  std::size_t got = 0;
  for (int i = 0; i < 16; ++i, wait(0.08)) {
    const auto piece = steady.receive(65536, 5.0);
    if (piece) got += piece->size();
  }
  EXPECT_EQ(got, std::size_t{1} << 20) << "1.3 s in all";

  PlainWire idle(served.network.port(), nullptr, 4096);
  idle.send(request);
  wait(2.0);
  EXPECT_FALSE(idle.receive(std::size_t{1} << 20, 5.0)) << "it took nothing for two seconds";
  EXPECT_FALSE(idle.isOpen());
}

TEST(ServeLimits, AViewerThatAnswersNoPingIsGone) {
  NetworkSettings settings;
  settings.silence_s = 0.6;
  const ServedSite served(settings);
  PlainStream silent(served.network.port(), kToken);
  PlainStream lively(served.network.port(), kToken);
  ASSERT_TRUE(support::waitFor([&] { return served.network.counts().watchers == 2; }));
  lively.receiveKind(8, 1.5);  // answers every ping meanwhile
  EXPECT_EQ(served.network.counts().watchers, 1u);
  EXPECT_EQ(served.network.counts().dropped, 1u);
  EXPECT_TRUE(silent.wire().endsWithin(5.0));
}

TEST(ServeLimits, AViewerThatTakesNothingIsDroppedAfterItsTime) {
  NetworkSettings settings;
  settings.stall_s = 0.6;
  ServedSite served(settings);
  const PlainStream stuck(served.network.port(), kToken, {}, nullptr, 2048);
  ASSERT_TRUE(support::waitFor([&] { return served.network.counts().watchers == 1; }));
  served.network.show(std::make_shared<const std::string>(std::size_t{4} << 20, 'x'));
  wait(0.3);
  EXPECT_EQ(served.network.counts().dropped, 0u);
  EXPECT_TRUE(support::waitFor([&] { return served.network.counts().dropped == 1; }));
}

}  // namespace
}  // namespace palpate::app::serving
