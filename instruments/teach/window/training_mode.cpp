#include "teach/window/training_mode.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/session/trial_scene.h"
#include "palpate/view/overlays/sink_rings.h"
#include "teach/window/training_painting.h"

namespace palpate::viewer {

namespace {

using training::Screen;

/// A finger of the mouse presses as hard as this everywhere, so that what differs is how far the skin gives way.
constexpr double kMousePressN = 2.0;
/// The window stands still for so long where another program holds the record; its rows are written in milliseconds, and
/// what could not be written is tried again at the trainee's next key.
constexpr std::chrono::milliseconds kMaxRecordWait{500};
/// "Answer saved." stays this long over the next trial, s.
constexpr double kAnswerSavedS = 3.0;
/// Digits that follow each other faster belong to one number, ms.
constexpr std::int64_t kSameNumberMs = 1500;
/// Margin of the body around the sites that shows where on it they are, mm.
constexpr double kRoomAsideMm = 110.0;
/// Bodies of familiarisation have numbers below those of trials and below TrialWorld's "none".
constexpr int kFamiliarBodies = -2;
/// A step of the keyboard's finger over the skin, points: about 5 mm where the whole back is seen.
constexpr double kStepPoints = 6.0;
/// Farther from its site than this, the visible skin is another side of the body, mm.
constexpr double kSameSideMm = 25.0;

bool sameHidden(const scene::Scene& a, const scene::Scene& b) {
  return std::ranges::equal(a.dysfunctions, b.dysfunctions, [](const auto& x, const auto& y) {
    return x.x_mm == y.x_mm && x.y_mm == y.y_mm && x.change_percent == y.change_percent;
  });
}

bool sameLumps(const scene::Scene& a, const scene::Scene& b) {
  return std::ranges::equal(a.lumps, b.lumps, [](const scene::LumpSettings& x, const scene::LumpSettings& y) {
    return x.x_mm == y.x_mm && x.y_mm == y.y_mm && x.diameter_mm == y.diameter_mm && x.depth_mm == y.depth_mm &&
           x.stiffness_ratio == y.stiffness_ratio && x.mobility_mm_per_n == y.mobility_mm_per_n;
  });
}

/// The member's own, or the one that this record has always had.
training::StationRow findStation(training::Store& store, const std::optional<classroom::Member>& member) {
  const std::vector<training::StationRow> known = store.stations();
  training::StationRow station;
  if (member) {
    station.id = member->station_id;
    station.name = member->name;
  } else if (!known.empty()) {
    station = known.front();
  } else {
    station.id = training::makeUuidV7(training::utcMs(), training::systemRandom());
    station.name = "station";
  }
  return station;
}

}  // namespace

TrainingMode::TrainingMode(TrainingSettings settings)
    : settings_(std::move(settings)),
      store_(settings_.records, training::Store::Open::create_too, kMaxRecordWait),
      sign_in_(store_, settings_.protocol, settings_.sign_in),
      voice_(settings_.speech),
      thimble_(settings_.thimble) {
  tidying_.start([records = settings_.records] {
    training::Store store(records, training::Store::Open::existing);
    return training::RecordingFiles(store).lockLeftBehind();
  });
  compose();
}

TrainingMode::~TrainingMode() { TrainingMode::finish("interrupted"); }

void TrainingMode::begin(ViewerState& viewer, const scene::World& world, window::Gui& gui) {
  const auto& landmarks = world.body->anatomy.landmarks;
  sites_ = settings_.protocol.sites.empty() ? training::twelveSites(landmarks)
                                            : training::sitesNamed(landmarks, settings_.protocol.sites);
  base_ = viewer.scene;
  body_ = std::make_shared<const scene::World>(world);
  if (settings_.member) {
    const std::string app = engine::recordingHeader(viewer.ticks_per_s).software;
    class_ = std::make_unique<ClassLine>(*settings_.member, store_, classroom::StationInfo{app, viewer.held_by});
  }
  ViewState& state = viewer.state;
  state.shown = {.panel = true, .panel_right = true, .plots = false, .numbers = false, .reach = false};
  state.hints = false;
  const view::Shading shading = state.look.shading;
  state.look = {};
  state.look.shading = shading;
  state.touch = {.by = device::PressBy::force, .force_n = kMousePressN};
  viewer.mark_vertex = false;
  gui.useLargeLetters();
}

training::Moment TrainingMode::now() const { return {clock_s_, training::utcMs(), tick_}; }

bool TrainingMode::paused() const {
  return (run_ && run_->session().paused()) || (lumps_ && lumps_->session().paused());
}

bool TrainingMode::clockRuns() const { return (run_ || lumps_) && !world_.waiting() && state_ == State::going_on; }

// --- the body

TrialWorld::Body TrainingMode::wanted() const {
  // Nothing can be felt while a question is open: no searching while the clock is stopped.
  if (lumps_ && state_ == State::going_on) return lumps_->wanted();
  if (!run_ || state_ != State::going_on || run_->session().paused()) return {};
  const training::Session& session = run_->session();
  const bool of_trial = session.screen() == Screen::trial || session.screen() == Screen::feedback;
  int trial = of_trial ? session.trialNumber() : 0;
  if (session.screen() == Screen::feedback) trial = static_cast<int>(session.trials().back().number);
  // Each request of familiarisation is another body too; trials count from 1.
  if (const auto pair = session.familiarPlaces()) trial = kFamiliarBodies - pair->round;
  return {session.hidden(), trial};
}

void TrainingMode::requestTrialBody(EditedScene& edited, WorldSwap& world_swap) {
  if (!run_ && !lumps_) return;
  if (world_.waiting() && !world_swap.failure().empty()) {
    state_ = State::trouble;
    trouble_ = world_swap.failure();
  }
  const TrialWorld::Body body = wanted();
  if (!world_.request(body)) return;
  if (lumps_) {
    scene::Scene scene = lumps_->makeScene(base_);
    if (!body.hidden) scene.lumps.clear();
    world_swap.showTemporarily(scene, edited);
    return compose();
  }
  const training::SessionPlan& plan = run_->session().plan();
  world_swap.showTemporarily(training::trialScene(base_, plan.protocol, plan.kind, plan.sites, body.hidden), edited);
  compose();
}

void TrainingMode::handleNewWorld(const scene::World& world) {
  if (lumps_ && world_.waiting()) {
    scene::Scene wanted = lumps_->makeScene(base_);
    if (!world_.requested() || !world_.requested()->hidden) wanted.lumps.clear();
    world_.taken(sameLumps(world.scene, wanted));
    return lumps_->handleNewWorld(world);
  }
  if (!run_ || !world_.waiting()) return;
  const training::SessionPlan& plan = run_->session().plan();
  const auto hidden = world_.requested() ? world_.requested()->hidden : std::nullopt;
  world_.taken(sameHidden(world.scene, training::trialScene(base_, plan.protocol, plan.kind, plan.sites, hidden)));
}

void TrainingMode::feel(const trace::Sample& sample) {
  tick_ = std::max(tick_, sample.tick);
  handleButtons(sample.buttons);
  if (class_) class_->felt(sample);
  const bool came = world_.feel(sample.world);
  if (lumps_ && !world_.waiting() && state_ == State::going_on) {
    const bool of_trial = lumps_->session().screen() == training::LumpScreen::trial;
    if (came && of_trial && !paused() && world_.begins()) lumps_->ready(now());
    return lumps_->feel(sample, now());
  }
  if (!run_ || world_.waiting() || state_ != State::going_on) return;
  if (came && run_->session().screen() == Screen::trial && !paused() && world_.begins()) run_->session().ready(now());
  run_->session().feel(sample, now());
}

void TrainingMode::handleButtons(std::uint32_t buttons) {
  const std::uint32_t down = buttons & ~holder_.ignored_buttons;
  const bool pressed = down != 0 && buttons_ == 0;
  buttons_ = down;
  if (pressed && lumps_ && state_ == State::going_on && !world_.waiting() && lumps_->deviceButton(now())) endSession();
  if (!pressed || !run_ || state_ != State::going_on || world_.waiting()) return;
  if (!run_->session().asks()) return clicks_.push_back({TrainingAct::next, 0});
  if (const int site = run_->session().touchedSite(); site != 0) {
    clicks_.push_back({TrainingAct::pick_site, site});
    clicks_.push_back({TrainingAct::answer, 0});
  } else {
    sign_in_.setNotice(tr("Touch the place that you mean, then press the button."));
  }
}

// --- drawing

void TrainingMode::look(const Sight& sight, const ViewerState& viewer) {
  seen_.clear();
  if (lumps_) return lookAtLumps(sight, viewer.active_finger);
  for (const training::Site& site : sites_.sites) {
    SeenSite seen;
    const Vec2 share = view::seenAt(sight.frustum, site.point_mm);
    if (share.allFinite()) {
      const Vec2 at = share.cwiseProduct(sight.size_points);
      const auto place = sight.pointer.skinAt(at * sight.pixels_per_point);
      if (place && (place->point - site.point_mm).norm() < kSameSideMm) seen.at = at;
      if (place && site.number == picked_ && keyboard_.moved) keyboard_.place = place;
    }
    const double middle = view::seenAt(sight.frustum, Vec3(0.0, site.point_mm.y(), site.point_mm.z())).x();
    seen.tag_left = site.side == training::Side::left ? share.x() <= middle : share.x() < middle;
    seen_.push_back(seen);
  }
  if (std::exchange(keyboard_.moved, false) && keyboard_.place) {
    sight.pointer.demonstrate(viewer.active_finger, *keyboard_.place, keyboard_.presses);
  }
}

/// Where the marks are, and the keyboard's finger: from the middle of the sites it moves over the visible skin.
void TrainingMode::lookAtLumps(const Sight& sight, std::size_t active_finger) {
  const auto seen_at = [&](const Vec3& point) -> std::optional<Vec2> {
    const Vec2 share = view::seenAt(sight.frustum, point);
    if (!share.allFinite()) return std::nullopt;
    return Vec2(share.cwiseProduct(sight.size_points));
  };
  for (const Vec3& place : lumps_->places()) seen_.push_back({.at = seen_at(place), .tag_left = place.x() < 0.0});
  if (!std::exchange(keyboard_.moved, false) || lumps_->session().paused()) return;
  const Vec3 from = keyboard_.place ? keyboard_.place->point : homeBox()->center();
  const Vec2 step = std::exchange(keyboard_.step, Vec2::Zero());
  if (const auto at = seen_at(from)) {
    const auto place = sight.pointer.skinAt((*at + Vec2(step.x(), -step.y())) * sight.pixels_per_point);
    if (place) keyboard_.place = place;
  }
  if (keyboard_.place) sight.pointer.demonstrate(active_finger, *keyboard_.place, keyboard_.presses);
}

std::optional<Eigen::AlignedBox3d> TrainingMode::homeBox() const {
  Eigen::AlignedBox3d box;
  for (const training::Site& site : sites_.sites) box.extend(site.point_mm);
  const Vec3 room(kRoomAsideMm, kRoomAsideMm, 0.0);
  return Eigen::AlignedBox3d(box.min() - room, box.max() + room);
}

void TrainingMode::adjust(view::PictureSettings& picture) const {
  picture.look.colouring = view::Colouring::plain;
  picture.look.overlays.reset();
  picture.look.skin_opacity = 1.0;
  picture.look.lens = screen_.shows_sink;
  picture.labels = view::LabelSettings::none();
  // The fingertip's pressures, where practice shows them: never what lies below.
  if (!lumps_ || state_ != State::going_on || !lumps_->session().padShown()) return;
  picture.look.show(view::Overlay::pressure);
  picture.labels.beneath = true;
}

std::vector<view::Lines> TrainingMode::marks(const scene::World& world, const ViewerState& viewer) const {
  if (!screen_.shows_sink || world_.waiting()) return {};
  return view::sinkRings(world, viewer.fingers[viewer.active_finger]);
}

TrainingOver TrainingMode::over() const {
  switch (state_) {
    case State::going_on:
      return paused() ? TrainingOver::paused : TrainingOver::none;
    case State::leaving:
    case State::quitting:
      return TrainingOver::leaving;
    case State::trouble:
      return TrainingOver::trouble;
    case State::message:
      break;
  }
  return TrainingOver::message;
}

TrainingView TrainingMode::view() const {
  TrainingView view;
  sign_in_.describe(view);
  if (kind_) view.stage = TrainingStage::thimble;
  view.leads_back = settings_.leads_back;
  view.over = over();
  view.trouble = trouble_;
  view.message = message_;
  view.device = holder_.words;
  view.by_mouse = holder_.mouse;
  view.force_share = holder_.force_share;
  view.ratios_kept_to_n = holder_.ratios_kept_to_n;
  view.focus = focus_;
  view.session = session();
  view.now = now();
  view.waiting = world_.waiting();
  view.picked = picked_;
  view.said_long_ago = clock_s_ - said_s_ > kAnswerSavedS;
  return view;
}

/// A session that has not begun shows the door it came through.
void TrainingMode::compose() {
  TrainingView shown = view();
  if (shown.stage == TrainingStage::session && !run_) shown.stage = TrainingStage::choice;
  const bool of_lumps = lumps_ && shown.over == TrainingOver::none;
  screen_ = of_lumps ? lumps_->screen(shown.code, world_.waiting(), holder_.mouse) : makeTrainingScreen(shown);
  if (of_lumps) screen_.focus = screen_.buttons.empty() ? 0 : std::min(focus_, screen_.buttons.size() - 1);
  if (std::exchange(screen_title_, screen_.title) != screen_.title) {
    focus_ = 0;
    const auto suggested = std::ranges::find_if(screen_.buttons, [](const auto& b) { return !b.badge.empty(); });
    if (suggested != screen_.buttons.end()) focus_ = static_cast<std::size_t>(suggested - screen_.buttons.begin());
    screen_.focus = focus_;
  }
}

void TrainingMode::draw(const FreeArea& /*area*/) {
  const TrainingClick clicked = paintTraining(screen_, seen_);
  if (clicked.act != TrainingAct::none) clicks_.push_back(clicked);
}

void TrainingMode::speak() {
  voice_.advance();
  if (!voice_.can()) return;
  if ((run_ || lumps_) && state_ == State::going_on) {
    const training::Said said = run_ ? run_->session().said() : lumps_->session().said();
    if (std::exchange(spoken_, said.number) != said.number) voice_.say(said.text);
    spoken_title_ = screen_.title;
  } else if (std::exchange(spoken_title_, screen_.title) != screen_.title) {
    voice_.say(screen_.title);
  }
}

// --- requests

bool TrainingMode::handle(const window::InputEvent& event, ViewerState& /*viewer*/, bool /*typing*/) {
  const TrainingStroke stroke = interpretInput(event, screen_);
  using Kind = TrainingStroke::Kind;
  switch (stroke.kind) {
    case Kind::pass:
      return event.kind == window::InputEvent::Kind::drop;
    case Kind::nothing:
      break;
    case Kind::press_button:
      clicks_.push_back(stroke.click);
      break;
    case Kind::focus:
      focus_ = stroke.index;
      break;
    case Kind::letters:
      typed(stroke.text);
      break;
    case Kind::erase:
      if (!lumps_) run_ ? (digits_.clear(), picked_ = 0, void()) : sign_in_.erase();
      break;
    case Kind::walk:
      walk(stroke.by);
      break;
    case Kind::touch:
      keyboard_.press(!keyboard_.presses && (picked_ != 0 || lumps_));
      digits_.clear();
      break;
  }
  return true;
}

/// A number that is typed picks its site: the digits together where there is such a site, else the last one alone.
void TrainingMode::typed(const std::string& letters) {
  if (lumps_) return;
  if (!run_) return sign_in_.type(letters);
  if (screen_.place != TrainingPlace::body) return;
  const std::int64_t now_ms = training::utcMs();
  if (now_ms - std::exchange(digits_ms_, now_ms) > kSameNumberMs) digits_.clear();
  for (const char letter : letters) {
    if (letter < '0' || letter > '9') continue;
    for (const std::string& candidate : {digits_ + letter, std::string(1, letter)}) {
      int number = 0;
      std::from_chars(candidate.data(), candidate.data() + candidate.size(), number);
      if (sites_.numbered(number) == nullptr) continue;
      digits_ = candidate;
      if (canPick(number)) picked_ = number;
      break;
    }
  }
}

/// Familiarisation knows two places alone.
bool TrainingMode::canPick(int site) const {
  const auto pair = run_ ? run_->session().familiarPlaces() : std::nullopt;
  return pair ? site == pair->first || site == pair->second : sites_.numbered(site) != nullptr;
}

void TrainingMode::walk(const Vec2& by) {
  if (lumps_) {
    keyboard_.step += kStepPoints * by;
    keyboard_.moved = true;
    return;
  }
  const auto pair = run_ ? run_->session().familiarPlaces() : std::nullopt;
  picked_ = !pair ? siteTowards(sites_, picked_, by) : picked_ == pair->first ? pair->second : pair->first;
  digits_.clear();
  keyboard_.press(false);
}

bool TrainingMode::handle(const window::Command& command, ViewerState& /*viewer*/) {
  using CommandKind = window::Command::Kind;
  switch (command.kind) {
    case CommandKind::act: {
      using window::Action;
      static constexpr std::array kAllowed = {Action::deeper, Action::lighter,     Action::home,
                                              Action::clutch, Action::full_screen, Action::screenshot};
      return std::ranges::find(kAllowed, command.action) == kAllowed.end();
    }
    case CommandKind::edit_grab:
    case CommandKind::edit_move:
    case CommandKind::edit_drop:
    case CommandKind::edit_size:
    case CommandKind::edit_strength:
      return true;
    default:
      return false;
  }
}

bool TrainingMode::handleOver(TrainingAct act) {
  if (state_ == State::going_on) return false;
  if (state_ == State::trouble) {
    if (act != TrainingAct::retry) return true;
    state_ = State::going_on;
    if (trouble_.empty() || (run_ && !run_->trouble().empty()) || (lumps_ && !lumps_->trouble().empty())) return true;
    world_.fail();
  } else if (act == TrainingAct::yes || act == TrainingAct::no) {
    const State asked = std::exchange(state_, State::going_on);
    if (act == TrainingAct::yes && asked != State::message) leaveNow(asked == State::quitting);
  }
  return true;
}

void TrainingMode::leaveNow(bool quits) {
  if (run_) run_->session().leave(now());
  if (run_ || lumps_) endSession();
  quit_ = quit_ || quits;
}

void TrainingMode::actOnSession(TrainingAct act, int value) {
  training::Session& session = run_->session();
  switch (act) {
    case TrainingAct::next:
      if (session.screen() == Screen::finished) return endSession();
      if (world_.waiting() && session.screen() == Screen::feedback) return;
      session.next(now());
      picked_ = session.screen() == Screen::feedback ? picked_ : 0;
      break;
    case TrainingAct::pick_site:
      if (canPick(value)) picked_ = value;
      digits_.clear();
      return;
    case TrainingAct::answer:
      if (picked_ == 0 || world_.waiting()) return;
      if (session.answer(picked_, now())) {
        picked_ = session.screen() == Screen::feedback && session.hidden() ? session.hidden()->site : 0;
        digits_.clear();
      }
      break;
    case TrainingAct::pause:
      session.pause(now());
      break;
    case TrainingAct::go_on:
      session.goOn(now());
      break;
    case TrainingAct::leave:
      // A finished session needs no question.
      if (session.screen() == Screen::block_summary || session.screen() == Screen::finished) return leaveNow(false);
      state_ = State::leaving;
      return;
    default:
      return;
  }
  if (keyboard_.presses) keyboard_.press(false);
}

void TrainingMode::handle(const TrainingClick& click, const FingerHolders& holders, LiveServo& servo) {
  if (click.act == TrainingAct::quit) {
    quit_ = quit_ || mayQuit();
  } else if (handleOver(click.act)) {
    return;
  } else if (lumps_) {
    actOnLumps(click.act, click.value);
  } else if (run_) {
    actOnSession(click.act, click.value);
  } else if (kind_) {
    if (click.act == TrainingAct::choose && static_cast<std::size_t>(click.value) < kThimbles.size()) {
      thimble_ = kThimbles[static_cast<std::size_t>(click.value)].word;
      beginSession(holders, servo);
    } else if (click.act == TrainingAct::no) {
      kind_.reset();
      sign_in_.returnToChoice();
    }
  } else if (settings_.leads_back && click.act == TrainingAct::no && sign_in_.asksForCode()) {
    quit_ = goes_back_ = true;
  } else {
    try {
      sign_in_.act(click.act, click.value);
    } catch (const Error& error) {
      sign_in_.setNotice(error.what());
    }
  }
}

bool TrainingMode::handle(const Request& request, ViewerState& /*viewer*/) {
  return std::holds_alternative<Quit>(request) && !mayQuit();
}

void TrainingMode::actOnLumps(TrainingAct act, int value) {
  if (act == TrainingAct::leave) {
    state_ = asksBeforeLeaving() ? State::leaving : state_;
    if (state_ != State::leaving) leaveNow(false);
  } else if (world_.waiting() && act != TrainingAct::next && act != TrainingAct::pause && act != TrainingAct::go_on) {
    return;
  } else if (lumps_->act(act, value, now())) {
    return endSession();
  }
  if (keyboard_.presses) keyboard_.press(false);
  storeNewRows();
}

/// A finished session needs no question.
bool TrainingMode::asksBeforeLeaving() const {
  const training::LumpScreen screen = lumps_->session().screen();
  return screen != training::LumpScreen::summary && screen != training::LumpScreen::finished;
}

bool TrainingMode::mayQuit() {
  if (lumps_) {
    if (asksBeforeLeaving()) state_ = State::quitting;
    return !asksBeforeLeaving();
  }
  if (!run_ || run_->session().screen() == Screen::finished || run_->session().screen() == Screen::block_summary) {
    return true;
  }
  state_ = State::quitting;
  return false;
}

// --- a session

training::SessionPlan TrainingMode::makeSessionPlan(training::SessionKind kind, const FingerHolders& holders) {
  training::SessionPlan plan;
  plan.protocol = settings_.protocol;
  if (!holders.held.empty()) {
    plan.protocol.base_n_per_mm =
        training::renderableBase(plan.protocol, base_, device::profileOf(base_.safety.device, holders.held));
  }
  plan.kind = kind;
  plan.sites = sites_;
  plan.seed = settings_.seed.value_or(training::systemRandom()[0] >> 1);
  plan.tick_s = 1.0 / holders.ticks_per_s;
  const training::TraineeRow& trainee = sign_in_.trainee();
  training::SessionRow& row = plan.row;
  row.id = training::makeUuidV7(training::utcMs(), training::systemRandom());
  row.trainee_id = trainee.id;
  row.app_version = engine::recordingHeader(holders.ticks_per_s).software;
  row.device = holder_.mouse ? "mouse" : fmt::format("{}, {}", holder_.words, thimble_);
  if (settings_.recording_files) row.file = training::RecordingFiles::nameFor(row.id);
  if (const auto interrupted = store_.interrupted(trainee.id, kind)) plan.resumed = interrupted->block;
  if (const auto before = store_.lastMeasured(trainee.id); before && before->threshold > 0.0) {
    plan.before = training::ShownThreshold{before->threshold, before->threshold_low, before->threshold_high};
  }
  plan.familiar = familiar_ == trainee.id + row.device;
  return plan;
}

training::LumpSessionPlan TrainingMode::makeLumpSessionPlan(const training::SessionPlan& plan) {
  if (!lump_bodies_) lump_bodies_ = std::make_shared<const training::LumpBodies>(body_, settings_.protocol, sites_);
  return {.protocol = settings_.protocol,
          .kind = plan.kind,
          .bodies = lump_bodies_,
          .sites = sites_,
          .seed = plan.seed,
          .tick_s = plan.tick_s,
          .row = plan.row,
          .resumed = plan.resumed};
}

void TrainingMode::beginSession(const FingerHolders& holders, LiveServo& servo) {
  const training::SessionKind kind = *std::exchange(kind_, std::nullopt);
  try {
    training::StationRow station = findStation(store_, settings_.member);
    station.device = holder_.words;
    store_.save(station);
    if (const auto& member = settings_.member) {
      store_.save(training::ClassRow{member->class_id, member->class_id, member->retention.days,
                                     member->retention.samples_days});
    }
    // Stored again for the class, which may have forgotten a trainee who was away for long.
    if (const auto trainee = store_.trainee(sign_in_.trainee().id)) store_.save(*trainee);
    store_.save(training::makeProtocolRow(settings_.protocol));
    training::SessionPlan plan = makeSessionPlan(kind, holders);
    plan.row.station_id = station.id;
    if (training::hidesLumps(kind)) {
      lumps_ = std::make_unique<LumpSessionRun>(store_, servo, makeLumpSessionPlan(plan), now());
    } else {
      run_ = std::make_unique<SessionRun>(store_, servo, std::move(plan), now());
    }
  } catch (const Error& error) {
    return sign_in_.returnToChoice(error.what());
  }
  spoken_ = 0;
  picked_ = 0;
  keyboard_ = {};
  storeNewRows();
}

void TrainingMode::endSession() {
  const std::string words = lumps_ ? lumps_->finish("done", now()) : run_->finish("done", now());
  run_.reset();
  lumps_.reset();
  if (keyboard_.presses) keyboard_.press(false);
  world_.clear();
  state_ = State::going_on;
  sign_in_.returnToChoice(words.empty() ? tr("Saved.") : words);
}

void TrainingMode::storeNewRows() {
  if (lumps_ && !lumps_->save()) {
    state_ = State::trouble;
    trouble_ = lumps_->trouble();
  }
  if (!run_ || run_->save()) return;
  state_ = State::trouble;
  trouble_ = run_->trouble();
}

/// Marks the record: a force that was cut off is not the trainee's.
void TrainingMode::followSafety(const DevicesShown& devices) {
  if (std::exchange(stopped_, devices.stopped) == devices.stopped) return;
  if (class_) class_->safety(stopped_ ? "emergency stop" : "ok");
  if (!run_) return;
  run_->session().safety(stopped_ ? "emergency stop" : "emergency stop released", now());
}

/// Follows an instructor's commands: none affects device or force.
void TrainingMode::followClass() {
  if (!class_) return;
  class_->follow(session());
  while (const auto command = class_->popCommand()) {
    using Kind = classroom::CommandKind;
    if (command->kind == Kind::message) {
      message_ = command->text;
      if (state_ == State::going_on) state_ = State::message;
    } else if (command->kind == Kind::pause || command->kind == Kind::go_on) {
      const bool pauses = command->kind == Kind::pause;
      if (run_) pauses ? run_->session().pause(now()) : run_->session().goOn(now());
      if (lumps_) lumps_->act(pauses ? TrainingAct::pause : TrainingAct::go_on, 0, now());
    } else if (run_ && command->kind == Kind::next_block) {
      leaveNow(state_ == State::quitting);
    }
  }
}

TrainingMode::Holder TrainingMode::makeHolder(const FingerHolders& holders, LiveServo& servo) {
  Holder holder;
  holder.mouse = !holders.devices.anyHeld();
  if (!holder.mouse) holder.words = holders.held_by;
  holder.force_share = holders.devices.stiffness_factor;
  holder.ratios_kept_to_n = holders.devices.ratios_kept_to_n;
  for (std::size_t i = 0; i < kFingers; ++i) {
    if (!servo.isHeld(i)) continue;
    const device::Workspace& workspace = servo.opened(i).workspace;
    holder.ignored_buttons |= workspace.clutch_buttons | workspace.stop_buttons;
  }
  return holder;
}

void TrainingMode::advance(const ModeWork& work) {
  ViewerState& viewer = work.viewer;
  LiveServo& servo = work.servo;
  holder_ = makeHolder(viewer, servo);
  for (const TrainingClick& click : std::exchange(clicks_, {})) handle(click, viewer, servo);
  if (const auto chosen = sign_in_.consumeChoice()) {
    kind_ = chosen;
    if (holder_.mouse || !thimble_.empty()) beginSession(viewer, servo);
  }
  if (clockRuns()) {
    clock_s_ += work.elapsed_s;
    if (run_) run_->session().tick(now());
  }
  if (run_) {
    const Screen screen = run_->session().screen();
    const training::Said said = run_->session().said();
    if (std::exchange(said_, said.number) != said.number) said_s_ = clock_s_;
    if (screen == Screen::instruction || screen == Screen::trial) {
      familiar_ = sign_in_.trainee().id + run_->session().plan().row.device;
    }
  }
  followSafety(viewer.devices);
  followClass();
  storeNewRows();
  requestTrialBody(viewer, work.world_swap);
  speak();
  compose();
}

std::string TrainingMode::finish(std::string_view ended_by) {
  voice_.stopSpeaking();
  if (lumps_) {
    const std::string words = lumps_->finish(ended_by, now());
    lumps_.reset();
    return words;
  }
  if (!run_) return {};
  std::string words = run_->finish(ended_by, now());
  run_.reset();
  return words;
}

}  // namespace palpate::viewer
