// The state of the measuring view without a window: marks corrected by clicks and keys, taken back, measured again
// beside the display, and the table that grows by a row.
#include "measure/window/measuring_view.h"

#include <gtest/gtest.h>

#include <thread>

#include "measure/window/key_table_file.h"
#include "measure/window/measuring_work.h"
#include "measure/window/photo_frame.h"
#include "palpate/base/output_file.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/maps/key_points.h"
#include "palpate/measure/synthesis/synthetic_pair.h"
#include "support/temporary_folder.h"

namespace palpate::viewer {
namespace {

namespace fs = std::filesystem;

constexpr double kReachPx = 10.0;
constexpr double kSlackPx = 3.0;

/// Three marks in each photograph, as if they had been measured.
MeasuringView threeMarks() {
  MeasuringView view;
  view.open = true;
  choosePhoto(view, Photo::before, "before.png");
  choosePhoto(view, Photo::after, "after.png");
  view.stale = Stale::nothing;
  view.tool = MeasuringTool::dots;
  for (const double x : {100.0, 200.0, 300.0}) {
    view.marks.before.push_back({Vec2(x, 50.0), 30.0});
    view.marks.after.push_back({Vec2(x + 5.0, 50.0), 30.0});
  }
  return view;
}

void clickPhoto(MeasuringView& view, Photo which, const Vec2& at, bool shift = false) {
  pressPhoto(view, which, at, kReachPx, shift);
  dragPhoto(view, at, kSlackPx);
  releasePhoto(view);
}

TEST(MeasuringView, AClickOnBareSkinAddsADotAndOneOnADotRemovesIt) {
  MeasuringView view = threeMarks();
  clickPhoto(view, Photo::after, {400.0, 60.0});
  ASSERT_EQ(view.marks.after.size(), 4u);
  EXPECT_EQ(view.marks.after.back().place_px, Vec2(400.0, 60.0));
  EXPECT_EQ(view.marks.before.size(), 3u) << "each photograph has its own marks";
  EXPECT_TRUE(view.corrected && view.unsaved);
  EXPECT_EQ(view.stale, Stale::marks);
  clickPhoto(view, Photo::before, {203.0, 53.0});
  ASSERT_EQ(view.marks.before.size(), 2u);
  EXPECT_EQ(view.marks.before[1].place_px.x(), 300.0);
}

TEST(MeasuringView, ADragMovesADotInOneStepAndFromBareSkinDoesNothing) {
  MeasuringView view = threeMarks();
  pressPhoto(view, Photo::before, {202.0, 50.0}, kReachPx, false);
  for (const double x : {206.0, 215.0, 232.0}) dragPhoto(view, {x, 58.0}, kSlackPx);
  releasePhoto(view);
  EXPECT_EQ(view.marks.before[1].place_px, Vec2(230.0, 58.0)) << "it is held where it was taken";
  EXPECT_EQ(undoCorrection(view), "move a dot");
  EXPECT_EQ(view.marks.before[1].place_px, Vec2(200.0, 50.0));
  EXPECT_EQ(undoCorrection(view), "") << "one drag, one step";
  pressPhoto(view, Photo::before, {500.0, 200.0}, kReachPx, false);
  dragPhoto(view, {540.0, 200.0}, kSlackPx);
  releasePhoto(view);
  EXPECT_EQ(view.marks.before.size(), 3u);
}

TEST(MeasuringView, CorrectionsAndTheContactAreTakenBackAndDoneAgain) {
  MeasuringView view = threeMarks();
  clickPhoto(view, Photo::before, {100.0, 50.0});
  view.tool = MeasuringTool::contact;
  clickPhoto(view, Photo::after, {77.0, 88.0});
  EXPECT_FALSE(view.settings.contact_px) << "the contact is a place of the first photograph";
  clickPhoto(view, Photo::before, {77.0, 88.0});
  ASSERT_TRUE(view.settings.contact_px);
  EXPECT_EQ(undoCorrection(view), "mark the contact");
  EXPECT_FALSE(view.settings.contact_px);
  EXPECT_EQ(undoCorrection(view), "remove a dot");
  EXPECT_EQ(view.marks.before.size(), 3u);
  EXPECT_FALSE(view.unsaved) << "there is nothing left of what was done by hand";
  redoCorrection(view);
  EXPECT_EQ(redoCorrection(view), "mark the contact");
  EXPECT_EQ(view.marks.before.size(), 2u);
  EXPECT_EQ(*view.settings.contact_px, Vec2(77.0, 88.0));
}

TEST(MeasuringView, ArrowsNudgeTheSelectedDotAsOneStep) {
  MeasuringView view = threeMarks();
  MeasuringRequests requests;
  EXPECT_TRUE(measuringKey(view, window::Key::right, {}, requests));
  EXPECT_FALSE(view.history.canUndo()) << "nothing was selected";
  clickPhoto(view, Photo::after, {205.0, 50.0}, true);
  ASSERT_EQ(view.marks.after.size(), 3u) << "with Shift a click only selects";
  for (int i = 0; i < 5; ++i) measuringKey(view, window::Key::right, {}, requests);
  measuringKey(view, window::Key::up, {.ctrl = false, .shift = true}, requests);
  EXPECT_TRUE(view.marks.after[1].place_px.isApprox(Vec2(210.0, 49.8)));
  EXPECT_EQ(undoCorrection(view), "nudge a dot");
  EXPECT_EQ(view.marks.after[1].place_px, Vec2(205.0, 50.0));
  view.selected = ChosenMark{Photo::before, 2};
  measuringKey(view, window::Key::delete_key, {}, requests);
  EXPECT_EQ(view.marks.before.size(), 2u);
  EXPECT_FALSE(view.selected);
}

TEST(MeasuringView, KeysOfTheBodyDoNothingAndEscLeavesOneThingAtATime) {
  MeasuringView view = threeMarks();
  MeasuringRequests requests;
  view.tab = MeasuringTab::before;
  for (const auto tab : {MeasuringTab::after, MeasuringTab::result, MeasuringTab::all, MeasuringTab::before}) {
    measuringKey(view, window::Key::tab, {}, requests);
    EXPECT_EQ(view.tab, tab);
  }
  measuringKey(view, window::Key::tab, {.ctrl = false, .shift = true}, requests);
  EXPECT_EQ(view.tab, MeasuringTab::all);
  EXPECT_TRUE(measuringKey(view, window::key('W'), {}, requests)) << "wires of a body that is not seen";
  EXPECT_FALSE(measuringKey(view, window::functionKey(1), {}, requests));
  EXPECT_FALSE(measuringKey(view, window::key('Z'), {.ctrl = true, .shift = false}, requests));
  measuringKey(view, window::Key::enter, {}, requests);
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<AcceptMeasurement>(requests.front()));
  view.selected = ChosenMark{Photo::before, 0};
  view.dialog = Photo::after;
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(measuringKey(view, window::Key::escape, {}, requests)) << i;
  EXPECT_EQ(view.tool, MeasuringTool::look);
  EXPECT_FALSE(measuringKey(view, window::Key::escape, {}, requests)) << "the view itself is the window's to close";
}

TEST(MeasuringView, AnotherPhotographForgetsWhatWasCorrected) {
  MeasuringView view = threeMarks();
  view.settings.contact_px = Vec2(1.0, 2.0);
  view.settings.spacing_mm = 20.0;
  clickPhoto(view, Photo::before, {100.0, 50.0});
  choosePhoto(view, Photo::after, "other.jpg");
  EXPECT_TRUE(view.marks.before.empty() && view.marks.after.empty());
  EXPECT_FALSE(view.unsaved || view.history.canUndo() || view.settings.contact_px);
  EXPECT_EQ(view.settings.spacing_mm, 20.0) << "of the stencil, not of the photograph";
  EXPECT_EQ(view.stale, Stale::photographs);
  EXPECT_EQ(view.photo(Photo::before).file, "before.png");
}

TEST(MeasuringView, AZoomKeepsThePlaceUnderTheCursorAndTheFrameLeadsBack) {
  MeasuringView view = threeMarks();
  const auto frame = [&] {
    return PhotoFrame{{300.0, 40.0}, {600.0, 500.0}, {1224.0, 1632.0}, view.zoom, view.middle};
  };
  const Vec2 mouse(620.0, 250.0);
  const Vec2 before = frame().toPhoto(mouse);
  zoomAbout(view, frame().share(mouse), 3.0);
  EXPECT_TRUE(frame().toPhoto(mouse).isApprox(before, 1e-9)) << frame().toPhoto(mouse).transpose();
  EXPECT_TRUE(frame().toScreen(frame().toPhoto({444.0, 111.0})).isApprox(Vec2(444.0, 111.0), 1e-9));
  MeasuringRequests requests;
  measuringKey(view, window::Key::home, {}, requests);
  EXPECT_EQ(view.zoom, 1.0);
  EXPECT_EQ(view.middle, Vec2(0.5, 0.5)) << "the whole photograph is in the middle";
}

TEST(MeasuringView, PhotographsAreKnownByTheirNames) {
  EXPECT_TRUE(isPhotograph("a/before.JPG") && isPhotograph("x.tiff") && isPhotograph("x.png"));
  EXPECT_FALSE(isPhotograph("scene.toml") || isPhotograph("jpg") || isPhotograph("") || isPhotograph("a.png.toml"));
}

TEST(MeasuringView, APairIsKnownByTheWordsBeforeAndAfterInOneName) {
  const std::vector<std::filesystem::path> files = {"a/site-4 before.jpg", "a/anna_before.png", "a/anna_after.png",
                                                    "a/after.jpg"};
  const auto pair = pairAmong(files);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->before, "a/anna_before.png") << "the first one has no photograph after";
  EXPECT_EQ(pair->after, "a/anna_after.png");
  EXPECT_FALSE(pairAmong(std::span(files).first(2)));
}

// ---- measured beside the display

/// The true places of dots of a pair that nobody has to paint.
measure::DotPair trueMarks(std::uint64_t seed = 7) {
  const measure::SyntheticTruth truth = measure::computeTruth(measure::drawCase(seed));
  measure::DotPair marks;
  for (const measure::TrueDot& dot : truth.dots) {
    marks.before.push_back({dot.before_px, 0.0});
    if (!dot.hidden()) marks.after.push_back({dot.after_px, 0.0});
  }
  return marks;
}

std::optional<MeasuringResult> waitFor(MeasuringWork& work) {
  const auto end = Clock::now() + std::chrono::seconds(60);
  while (work.busy() && Clock::now() < end) {
    if (auto result = work.collectResult()) return result;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return std::nullopt;
}

TEST(MeasuringWork, MeasuresCorrectedMarksAndKeepsWhatOnlyPhotographsTell) {
  MeasuringWork work;
  MeasuringJob job{.marks = trueMarks(), .width_px = 1224, .height_px = 1632};
  job.of_photographs = {{measure::Severity::warning, "time", "Taken a day apart."}};
  const std::size_t dots = job.marks.before.size();
  work.request(job);
  const auto whole = waitFor(work);
  ASSERT_TRUE(whole && whole->measured && whole->measured->fit);
  ASSERT_FALSE(whole->measured->findings.empty());
  EXPECT_EQ(whole->measured->findings.back().code, "time");
  EXPECT_EQ(whole->measured->width_px, 1224);
  EXPECT_EQ(whole->overlay.panels.size(), 3u);
  EXPECT_EQ(photoMarks(*whole->measured).before.size(), dots) << "every mark is in the grid or a stray";
  job.marks.after[40].place_px += Vec2(400.0, 0.0);
  work.request(job);
  const auto wrong = waitFor(work);
  ASSERT_TRUE(wrong && wrong->measured);
  EXPECT_EQ(wrong->measured->matched + 1, whole->measured->matched) << "a dot that lies elsewhere is none of the grid";
}

TEST(MeasuringWork, TellsOfFilesThatAreNoPhotographs) {
  const support::TemporaryFolder folder;
  writeFile(folder / "notes.jpg", "these are words, not a picture\n");
  MeasuringWork work;
  work.request({.files = {(folder / "notes.jpg").string(), (folder / "gone.png").string()}});
  const auto result = waitFor(work);
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->measured);
  ASSERT_EQ(result->errors.size(), 2u);
  EXPECT_NE(result->errors[0].find("notes.jpg: "), std::string::npos) << result->errors[0];
  EXPECT_NE(result->errors[1].find("gone.png: "), std::string::npos) << result->errors[1];
}

TEST(MeasuringWork, TheNewestRequestWinsAndACancelledOneNeverComes) {
  MeasuringWork work;
  MeasuringJob job{.marks = trueMarks()};
  for (const double spacing : {10.0, 20.0, 30.0}) {
    job.settings.spacing_mm = spacing;
    work.request(job);
  }
  double last = 0.0;
  while (const auto result = waitFor(work)) last = result->measured->settings.spacing_mm;
  EXPECT_EQ(last, 30.0);
  work.request(job);
  work.cancel();
  EXPECT_FALSE(waitFor(work));
  EXPECT_FALSE(work.busy());
}

// ---- the table

const KeyTableRow kRow{"name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg,stiffness_n_per_mm,peak_mm",
                       "T6,-40,73,71.3,1.4,80,,17.2"};

TEST(KeyTableFile, ANewTableHasAllColumnsAndAnOldOneKeepsItsOwn) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "keys.csv";
  KeyTableFile table = readKeyTable(file);
  EXPECT_EQ(table.kind, KeyTableFile::Kind::none);
  EXPECT_EQ(tableWith(table, kRow), kRow.header + "\n" + kRow.values + "\n");

  const std::string old =
      "# of a friend\n"
      "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg\n"
      "L2,0,-170,55,1.2,90  # twice measured\n";
  writeFile(file, old);
  table = readKeyTable(file);
  ASSERT_EQ(table.kind, KeyTableFile::Kind::key_points) << table.trouble;
  EXPECT_TRUE(table.has("L2") && !table.has("T6"));
  const std::string grown = tableWith(table, kRow);
  EXPECT_EQ(grown, old + "T6,-40,73,71.3,1.4,80\n");
  EXPECT_EQ(maps::parseKeyPoints(grown, "grown").size(), 2u);
}

TEST(KeyTableFile, ARowOfTheSameNameIsReplacedWhereItStands) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "keys.csv";
  writeFile(file, kRow.header + "\nT6,1,2,3,1,0,0.5,\nL2,0,-170,55,1.2,90,,\n\n");
  const KeyTableFile table = readKeyTable(file);
  EXPECT_EQ(tableWith(table, kRow), kRow.header + "\n" + kRow.values + "\nL2,0,-170,55,1.2,90,,\n");
}

TEST(KeyTableFile, ATableWithoutAHeaderGetsAPlainRow) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "keys.csv";
  writeFile(file, "L2,0,-170,55,1.2,90,0.7\n");
  EXPECT_EQ(tableWith(readKeyTable(file), kRow), "L2,0,-170,55,1.2,90,0.7\nT6,-40,73,71.3,1.4,80,\n");
}

TEST(KeyTableFile, WhatIsNoTableIsToldAndNotMixedWithOne) {
  const support::TemporaryFolder folder;
  const fs::path file = folder / "scene.toml";
  writeFile(file, "[body]\nfile = \"a.ply\"\n");
  const KeyTableFile table = readKeyTable(file);
  EXPECT_EQ(table.kind, KeyTableFile::Kind::other);
  EXPECT_FALSE(table.trouble.empty());
  EXPECT_EQ(tableWith(table, kRow), kRow.header + "\n" + kRow.values + "\n");
}

}  // namespace
}  // namespace palpate::viewer
