// A person measured in the window: photographs come, are measured beside the display, corrected by the mouse, accepted
// into a table, and the skin follows.
#include "view/tests/viewer/stage.h"

#include <thread>

#include "measure/window/key_table_file.h"
#include "measure/window/measuring_mode.h"
#include "measure/window/photo_frame.h"
#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/maps/key_points.h"
#include "palpate/measure/synthesis/synthetic_pair.h"

namespace palpate::viewer {
namespace {

/// A stage whose viewer has the mode.
class MeasuringStage : public Stage {
 public:
  MeasuringStage() : MeasuringStage(std::make_unique<MeasuringMode>()) {}
  MeasuringMode& measuring() { return *measuring_; }

 private:
  // Braces: the pointer is read before it is moved from.
  explicit MeasuringStage(std::unique_ptr<MeasuringMode> mode) : MeasuringStage{mode.get(), std::move(mode)} {}
  MeasuringStage(MeasuringMode* measuring, std::unique_ptr<Mode> mode)
      : Stage(std::move(mode)), measuring_(measuring) {}

  MeasuringMode* measuring_;  // the viewer's
};

namespace fs = std::filesystem;

constexpr window::Modifiers kCtrl{.ctrl = true, .shift = false};

/// Of which only an ellipse is known.
std::shared_ptr<measure::Measurement> madeUpMeasurement() {
  auto measured = std::make_shared<measure::Measurement>();
  measure::FieldFit& fit = measured->fit.emplace();
  fit.at_2_mm = {2.0, {71.3, 1.2}, {52.8, 0.9}, {1.35, 0.03}, {80.0, 2.0}};
  fit.at_4_mm = {4.0, {50.1, 0.9}, {37.1, 0.7}, {1.35, 0.03}, {80.0, 2.0}};
  fit.peak_mm = {17.2, 0.8};
  return measured;
}

/// A view that could be accepted, into a table in the folder.
void fillIn(MeasuringMode& mode, ViewerState& viewer, const fs::path& folder) {
  MeasuringView& view = mode.view();
  view.measured = madeUpMeasurement();
  view.form.name = "T6 left";
  view.form.at_mm = Vec2(-40.0, 73.0);
  view.form.table = "keys.csv";
  viewer.output_folder = folder;
}

TEST(MeasuringMode, AcceptingWritesARowAndTheSceneTakesTheTable) {
  const support::TemporaryFolder folder;
  ViewerState viewer;
  MeasuringMode mode;
  fillIn(mode, viewer, folder.path());
  mode.view().unsaved = true;
  ASSERT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::done);
  const auto keys = maps::readKeyPoints(folder / "keys.csv");
  ASSERT_EQ(keys.size(), 1u);
  EXPECT_EQ(keys[0].name, "T6 left");
  EXPECT_EQ(keys[0].position_mm, Vec2(-40.0, 73.0));
  EXPECT_NEAR(keys[0].ellipse.half_major_mm, 71.3, 0.01);
  EXPECT_NEAR(keys[0].ellipse.aspect, 1.0 / 1.35, 1e-3);
  EXPECT_EQ(viewer.scene.ellipses.key_points, folder / "keys.csv");
  EXPECT_EQ(viewer.output.changed, kMapChange);
  EXPECT_FALSE(mode.view().unsaved);

  mode.view().form.name = "L2";
  mode.view().form.use_in_scene = false;
  viewer.output.changed = kNothing;
  ASSERT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::done);
  EXPECT_EQ(maps::readKeyPoints(folder / "keys.csv").size(), 2u);
  EXPECT_EQ(viewer.output.changed, kNothing);
}

TEST(MeasuringMode, AsksBeforeItTakesWhatWasRefusedOrReplacesSomething) {
  const support::TemporaryFolder folder;
  ViewerState viewer;
  MeasuringMode mode;
  fillIn(mode, viewer, folder.path());
  auto refused = madeUpMeasurement();
  refused->findings = {{measure::Severity::refusal, "moved", "The body moved."},
                       {measure::Severity::refusal, "leaves_dots", "Allow it with --partial."}};
  mode.view().measured = refused;
  ASSERT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::asked);
  ASSERT_TRUE(viewer.question);
  EXPECT_NE(viewer.question->words.find("The body moved."), std::string::npos);
  EXPECT_NE(viewer.question->words.find("with \"may leave the dots\"."), std::string::npos) << "the window's name";
  EXPECT_FALSE(fs::exists(folder / "keys.csv"));
  ASSERT_EQ(viewer.question->answers, (std::vector<std::string>{"Accept", "Cancel"}));
  const Question question = *viewer.question;
  EXPECT_TRUE(mode.answer(question, "Cancel", viewer));
  EXPECT_FALSE(fs::exists(folder / "keys.csv"));
  EXPECT_FALSE(mode.answer(question, "Accept", viewer)) << "it had its answer";
  ASSERT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::asked);
  EXPECT_TRUE(mode.answer(question, "Accept", viewer)) << "whatever speaks against it";
  EXPECT_TRUE(fs::exists(folder / "keys.csv"));

  mode.view().measured = madeUpMeasurement();
  EXPECT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::asked) << "a row of that name is there";
  mode.view().form.table = "letter.txt";
  writeFile(folder / "letter.txt", "Dear friend,\n");
  EXPECT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::asked);
  EXPECT_EQ(readFile(folder / "letter.txt", 100), "Dear friend,\n");
}

/// What a fresh clone has no folder for; the error of an earlier try goes away with it.
TEST(MeasuringMode, MakesTheFolderOfItsTableAndSaysThatTheRowIsThere) {
  const support::TemporaryFolder folder;
  ViewerState viewer;
  MeasuringMode mode;
  fillIn(mode, viewer, folder.path());
  const fs::path table = folder / "results/today/keys.csv";
  mode.view().form.table = table.string();
  viewer.report(Severity::error, table.string() + ": cannot be written: No space left on device");
  EXPECT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::done);
  EXPECT_TRUE(fs::exists(table));
  const Message* shown = viewer.messages.toast(viewer.now_s);
  ASSERT_NE(shown, nullptr);
  EXPECT_EQ(shown->severity, Severity::info);
  EXPECT_TRUE(shown->text.starts_with("Row added: ")) << shown->text;
}

TEST(MeasuringMode, SaysWhatIsMissingAndWhatCannotBeWritten) {
  const support::TemporaryFolder folder;
  ViewerState viewer;
  MeasuringMode mode;
  const auto last_words = [&] { return viewer.messages.all().empty() ? "" : viewer.messages.all().back().text; };
  EXPECT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::failed);
  EXPECT_EQ(last_words(), "No ellipse to accept");
  fillIn(mode, viewer, folder.path());
  mode.view().form.at_mm.reset();
  mode.accept(viewer, false);
  EXPECT_EQ(last_words(), "Set the place on the body first");
  fillIn(mode, viewer, folder.path());
  mode.view().form.name = "T6, left";
  mode.accept(viewer, false);
  EXPECT_NE(last_words().find("The name has a comma"), std::string::npos) << last_words();
  fillIn(mode, viewer, folder.path());
  mode.view().form.table = "/dev/null/keys.csv";
  EXPECT_EQ(mode.accept(viewer, false), MeasuringMode::Accepting::failed);
  EXPECT_NE(last_words().find("keys.csv"), std::string::npos) << last_words();
  ASSERT_NE(viewer.messages.toast(viewer.now_s), nullptr);
  EXPECT_EQ(viewer.messages.toast(viewer.now_s)->severity, Severity::error);
  mode.view().stale = Stale::marks;
  mode.accept(viewer, false);
  EXPECT_EQ(last_words(), "It is still being measured");
}

TEST(MeasuringMode, FindsThePlaceInTheWordsOfTheBodyAtHand) {
  const std::vector<body::SkinLandmark> landmarks = {
      {"spinous_T6", "T6", Vec3(3.0, 70.0, 50.0), Vec3::UnitZ(), Vec3(3.0, 70.0, 20.0)}};
  ViewerState viewer;
  MeasuringMode mode;
  mode.view().open = true;
  AcceptForm& form = mode.view().form;
  form.place = "t6 left 40";
  mode.advance(viewer, landmarks);
  ASSERT_TRUE(form.at_mm) << form.place_words;
  EXPECT_EQ(*form.at_mm, Vec2(-37.0, 70.0));
  EXPECT_EQ(acceptedName(form), "T6 left 40 mm");
  form.place = "12.5, -40";
  mode.advance(viewer, landmarks);
  EXPECT_EQ(form.at_mm.value_or(Vec2::Zero()), Vec2(12.5, -40.0));
  EXPECT_EQ(acceptedName(form), "");
  form.place = "T66";
  mode.advance(viewer, landmarks);
  EXPECT_FALSE(form.at_mm);
  EXPECT_NE(form.place_words.find("did you mean 'T6'?"), std::string::npos) << form.place_words;
}

// ---- the whole window

/// Painted once for all tests.
const measure::SyntheticPair& paintedPair() {
  static const measure::SyntheticPair pair = measure::renderPair(measure::drawCase(7, {.megapixels = 1.0}));
  return pair;
}

struct WrittenPair {
  explicit WrittenPair(const support::TemporaryFolder& folder)
      : before((folder / "before.jpg").string()), after((folder / "after.jpg").string()) {
    const measure::SyntheticPair& pair = paintedPair();
    truth = pair.truth;
    measure::writeJpeg(before, pair.before, 90);
    measure::writeJpeg(after, pair.after, 90);
  }
  std::string before;
  std::string after;
  measure::SyntheticTruth truth;
};

/// Frames with pauses in between: drawn as fast as it goes, they would leave the measuring little of the processor.
template <class Ready>
bool waitUntil(MeasuringStage& stage, const Ready& ready) {
  return stage.until([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return ready();
  });
}

bool measuredIt(MeasuringStage& stage) {
  const MeasuringView& view = stage.measuring().view();
  return waitUntil(stage, [&] { return view.measured != nullptr && view.settled(); });
}

/// The place of the screen where the photograph before shows this.
Vec2 onScreen(MeasuringStage& stage, const Vec2& px) {
  stage.frame();
  const auto [left, top, right, below] = widgetPlaces().at("measuring/before");
  const MeasuringView& view = stage.measuring().view();
  const ShownPhoto& photo = view.photo(Photo::before);
  const PhotoFrame frame{
      {left, top}, {right - left, below - top}, Vec2(photo.width_px, photo.height_px), view.zoom, view.middle};
  return frame.toScreen(px);
}

TEST(MeasuringWindow, DroppedPhotographsAreMeasuredCorrectedAcceptedAndFelt) {
  MeasuringStage stage;
  const WrittenPair pair(stage.folder);
  stage.drop(pair.before);
  stage.drop(pair.after);
  MeasuringView& view = stage.measuring().view();
  ASSERT_TRUE(view.open);
  ASSERT_TRUE(measuredIt(stage)) << view.failure;
  ASSERT_TRUE(view.measured->fit);
  EXPECT_TRUE(view.measured->accepted()) << view.overlay.verdict;
  const double true_major = pair.truth.at_2_mm.half_major_mm.value;
  EXPECT_NEAR(view.measured->fit->at_2_mm.half_major_mm.value, true_major, 0.1 * true_major);
  EXPECT_EQ(view.tab, MeasuringTab::result);

  stage.click("measuring/dots");
  EXPECT_EQ(view.tab, MeasuringTab::before) << "marks are not corrected on the result";
  const std::size_t marks = view.marks.before.size();
  const std::size_t matched = view.measured->matched;
  const measure::MeasuredDot* dot = nullptr;
  for (const measure::MeasuredDot& candidate : view.measured->dots) dot = candidate.after_px ? &candidate : dot;
  stage.move(onScreen(stage, dot->before_px));
  stage.button(true);
  stage.button(false);
  ASSERT_EQ(view.marks.before.size(), marks - 1);
  ASSERT_TRUE(measuredIt(stage));
  EXPECT_LT(view.measured->matched, matched);
  stage.key(window::key('Z'), kCtrl);
  EXPECT_EQ(stage.lastMessage(), "Undo: remove a dot");
  ASSERT_TRUE(measuredIt(stage));
  EXPECT_EQ(view.measured->matched, matched);

  const auto accept = widgetPlaces().at("measuring/accept");
  view.form.place = "10, 20";
  stage.frame();
  EXPECT_EQ(widgetPlaces().at("measuring/accept"), accept) << "nothing moves while a place is typed";
  view.form.place = "a place with so long a name that what is said of it takes several lines";
  stage.frame();
  EXPECT_EQ(widgetPlaces().at("measuring/accept"), accept);
  view.form.place = "10, 20";
  view.form.name = "here";
  stage.frame();
  stage.key(window::Key::enter);
  const fs::path table = stage.folder / "key_points.csv";
  ASSERT_TRUE(fs::exists(table)) << stage.lastMessage();
  EXPECT_TRUE(stage.until([&] { return stage.viewer->world().ellipses.keys().size() == 1; }));
  EXPECT_EQ(stage.viewer->world().ellipses.keys().front().name, "here");
  EXPECT_TRUE(stage.state().history.changed()) << "the scene has to be saved";
}

TEST(MeasuringWindow, APairThatLiesInTheFolderIsTakenByOneClick) {
  MeasuringStage stage;
  const WrittenPair pair(stage.folder);
  showFolder(stage.folder.path());
  stage.key(window::key('M'), kCtrl);
  stage.click("measuring/here");
  const MeasuringView& view = stage.measuring().view();
  EXPECT_EQ(view.photo(Photo::before).file, pair.before);
  EXPECT_EQ(view.photo(Photo::after).file, pair.after);
  EXPECT_TRUE(measuredIt(stage)) << view.failure;
}

TEST(MeasuringWindow, TheContactIsClickedAndThePhotographsCanBeSwapped) {
  MeasuringStage stage;
  const WrittenPair pair(stage.folder);
  stage.measuring().request(ShowPhoto{Photo::before, pair.after});
  stage.measuring().request(ShowPhoto{Photo::after, pair.before});
  MeasuringView& view = stage.measuring().view();
  stage.frame();
  ASSERT_TRUE(measuredIt(stage)) << view.failure;
  stage.click("measuring/swap");
  ASSERT_TRUE(measuredIt(stage)) << view.failure;
  EXPECT_EQ(view.photo(Photo::before).file, pair.before);
  stage.click("measuring/tab/before");
  stage.click("measuring/contact");
  const Vec2 contact = pair.truth.contact_px;
  stage.move(onScreen(stage, contact));
  stage.scroll(3.0);
  EXPECT_GT(view.zoom, 1.5);
  stage.move(onScreen(stage, contact));
  stage.button(true);
  stage.button(false);
  ASSERT_TRUE(view.settings.contact_px);
  EXPECT_LT((*view.settings.contact_px - contact).norm(), 1.0);
  ASSERT_TRUE(measuredIt(stage));
  EXPECT_TRUE(view.measured->settings.contact_px);
}

TEST(MeasuringWindow, AWrongFileIsToldAndTheOtherPhotographIsShown) {
  MeasuringStage stage;
  const WrittenPair pair(stage.folder);
  writeFile(stage.folder / "notes.jpg", "these are words\n");
  stage.drop(pair.before);
  stage.drop(stage.folder / "notes.jpg");
  MeasuringView& view = stage.measuring().view();
  ASSERT_TRUE(waitUntil(stage, [&] { return view.settled() && !view.failure.empty(); }));
  EXPECT_NE(view.failure.find("notes.jpg"), std::string::npos);
  EXPECT_EQ(stage.lastMessage(), view.failure);
  EXPECT_NE(view.photo(Photo::before).texture, 0u);
  stage.drop(pair.after);
  EXPECT_TRUE(measuredIt(stage));
  EXPECT_TRUE(view.failure.empty());
}

TEST(MeasuringWindow, OpensAndClosesByItsKeyAndKeepsTheBodysKeysOut) {
  MeasuringStage stage;
  stage.key(window::key('M'), kCtrl);
  EXPECT_TRUE(stage.measuring().view().open);
  stage.key(window::key('W'));
  EXPECT_FALSE(stage.state().state.look.shows(view::Overlay::wireframe));
  stage.move(stage.middle());
  stage.button(true);
  stage.button(false);
  EXPECT_FALSE(stage.viewer->pointer().pressed(0)) << "there is no body under the photographs";
  stage.key(window::key('O'), kCtrl);
  stage.frame();
  EXPECT_TRUE(widgetPlaces().contains("photograph/open"));
  stage.key(window::Key::escape);
  stage.frame();
  EXPECT_FALSE(widgetPlaces().contains("photograph/open"));
  stage.key(window::Key::escape);
  EXPECT_FALSE(stage.measuring().view().open);
  stage.key(window::key('W'));
  EXPECT_TRUE(stage.state().state.look.shows(view::Overlay::wireframe));
}

TEST(MeasuringWindow, QuittingAsksForWhatWasCorrectedAndThenForTheScene) {
  MeasuringStage stage;
  ViewerState& viewer = stage.state();
  stage.measuring().view().measured = madeUpMeasurement();
  stage.measuring().view().marks.before = {{Vec2(1.0, 2.0), 3.0}};
  stage.measuring().view().selected = ChosenMark{Photo::before, 0};
  removeSelected(stage.measuring().view());
  stage.measuring().view().stale = Stale::nothing;
  viewer.scene.contact.finger.mu_static = 0.8;
  viewer.output.changed |= kFingerChange;
  stage.frame();
  viewer.request(Quit{});
  stage.frame();
  ASSERT_TRUE(viewer.question);
  EXPECT_EQ(viewer.question->kind, Question::Kind::of_mode);
  stage.frame();  // a dialog knows its height after one
  stage.click("question/Stay");
  EXPECT_FALSE(viewer.question || stage.viewer->wantsToQuit());
  viewer.request(Quit{});
  stage.frame();
  stage.frame();
  stage.click("question/Discard");
  stage.frame();
  ASSERT_TRUE(viewer.question) << "the scene was changed, too";
  EXPECT_EQ(viewer.question->kind, Question::Kind::leave);
  stage.frame();
  stage.click("question/Discard");
  EXPECT_TRUE(stage.viewer->wantsToQuit());
}

}  // namespace
}  // namespace palpate::viewer
