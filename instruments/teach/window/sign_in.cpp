#include "teach/window/sign_in.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::viewer {

namespace {

/// A code has eleven letters with its hyphen; some more for blanks.
constexpr std::size_t kMaxTyped = 16;
constexpr std::array<const char*, 3> kHands = {"left", "right", ""};

}  // namespace

SignIn::SignIn(training::Store& store, training::Protocol protocol, SignInSettings settings)
    : store_(store), protocol_(std::move(protocol)), settings_(std::move(settings)) {
  if (settings_.code.empty()) return;
  typed_ = settings_.code;
  signIn();
}

void SignIn::type(std::string_view letters) {
  if (stage_ != TrainingStage::sign_in) return;
  for (const char letter : letters) {
    const bool fits = std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == ' ';
    if (!fits || typed_.size() >= kMaxTyped) continue;
    typed_ += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    notice_.clear();
  }
}

void SignIn::erase() {
  if (stage_ == TrainingStage::sign_in && !typed_.empty()) typed_.pop_back();
}

void SignIn::signIn() {
  const auto code = training::codeTyped(typed_);
  if (!code) {
    notice_ =
        typed_.empty() ? tr("Type your code first.") : tr("This is not a code. Check each letter, then try again.");
    return;
  }
  code_ = *code;
  notice_.clear();
  const training::Uuid id = training::derivePseudonym(settings_.class_id, code_, settings_.trainee_key);
  auto known = store_.trainee(id);
  // Trainees from before the class had a secret keep their id.
  if (!known) known = store_.trainee(training::derivePseudonym(settings_.class_id, code_));
  trainee_ = known.value_or(training::TraineeRow{.id = id, .class_id = settings_.class_id});
  if (!known) {
    stage_ = TrainingStage::new_code;
  } else if (!known->consent) {
    stage_ = TrainingStage::consent;
  } else {
    enter();
  }
}

/// Enters a known trainee who has agreed.
void SignIn::enter() {
  if (settings_.kind) {
    chosen_ = settings_.kind;
    stage_ = TrainingStage::session;
    return;
  }
  choices();
}

void SignIn::choices() {
  offers_ = offersFor(loadTrainingPast(store_, trainee_.id), protocol_, training::utcMs());
  stage_ = TrainingStage::choice;
}

void SignIn::returnToChoice(std::string notice) {
  settings_.kind.reset();
  choices();
  notice_ = std::move(notice);
}

void SignIn::signOut() {
  trainee_ = {};
  code_.clear();
  typed_.clear();
  notice_.clear();
  offers_.clear();
  stage_ = TrainingStage::sign_in;
}

bool SignIn::choose(int value) {
  const auto index = static_cast<std::size_t>(value);
  if (stage_ == TrainingStage::hand && index < kHands.size()) {
    trainee_.dominant_hand = kHands[index];
    trainee_.consent = true;
    if (trainee_.created_ms == 0) trainee_.created_ms = training::utcMs();
    store_.save(trainee_);
    enter();
    return true;
  }
  if (stage_ == TrainingStage::thimble && index < kThimbles.size()) {
    settings_.thimble = kThimbles[index].word;
    stage_ = TrainingStage::session;
    return true;
  }
  if (stage_ != TrainingStage::choice || index >= offers_.size() || !offers_[index].enabled) return false;
  chosen_ = offers_[index].kind;
  notice_.clear();
  stage_ = TrainingStage::session;
  return true;
}

bool SignIn::act(TrainingAct act, int value) {
  if (act == TrainingAct::choose) return choose(value);
  if (act == TrainingAct::sign_out) return signOut(), true;
  switch (stage_) {
    case TrainingStage::sign_in:
      if (act == TrainingAct::sign_in) return signIn(), true;
      if (act != TrainingAct::make_code) return false;
      code_ = training::makeTraineeCode(training::systemRandom()[0]);
      stage_ = TrainingStage::own_code;
      notice_.clear();
      return true;
    case TrainingStage::own_code:
      if (act == TrainingAct::no) return signOut(), true;
      if (act != TrainingAct::yes) return false;
      typed_ = code_;
      signIn();
      if (stage_ == TrainingStage::new_code) stage_ = TrainingStage::consent;
      return true;
    case TrainingStage::new_code:
      if (act == TrainingAct::yes) return stage_ = TrainingStage::consent, true;
      if (act != TrainingAct::no) return false;
      stage_ = TrainingStage::sign_in;
      return true;
    case TrainingStage::consent:
      if (act == TrainingAct::yes) return stage_ = TrainingStage::hand, true;
      if (act != TrainingAct::no) return false;
      signOut();
      notice_ = tr("Nothing was kept.");
      return true;
    case TrainingStage::hand:
      if (act == TrainingAct::no) return stage_ = TrainingStage::consent, true;
      return false;
    case TrainingStage::choice:
      if (act == TrainingAct::no) return signOut(), true;
      return false;
    case TrainingStage::thimble:
      if (act != TrainingAct::no) return false;
      chosen_.reset();
      return returnToChoice(), true;
    case TrainingStage::session:
      return false;
  }
  return false;
}

std::optional<training::SessionKind> SignIn::consumeChoice(bool has_device) {
  if (!chosen_ || !has_device || !settings_.thimble.empty()) return std::exchange(chosen_, std::nullopt);
  stage_ = TrainingStage::thimble;
  return std::nullopt;
}

void SignIn::describe(TrainingView& view) const {
  view.stage = stage_;
  view.typed = typed_;
  view.code = code_;
  view.notice = notice_;
  view.offers = offers_;
}

}  // namespace palpate::viewer
