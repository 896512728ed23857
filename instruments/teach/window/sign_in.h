// From the code at the door to the chosen session: sign in, consent once, a choice; and who is there afterwards.
//
//   letters, acts ─► SignIn ─► stage and words (training_words.h), TraineeRow to keep, the kind that was chosen
//
// Looks into the record and writes the trainee's row; knows no window.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/training/records/store.h"
#include "teach/window/training_words.h"

namespace palpate::viewer {

struct SignInSettings {
  std::string class_id = {};
  std::string trainee_key = {};  ///< the class's secret, from which ids are made; empty: it has none
  /// Signs in at once; a typing error is reported as if it had been typed.
  std::string code = {};
  /// Done at once after signing in, in place of the choice.
  std::optional<training::SessionKind> kind = {};
  std::string thimble = {};  ///< worn with a device; empty: the trainee is asked
};

class SignIn {
 public:
  /// The store must outlive it.
  SignIn(training::Store& store, training::Protocol protocol, SignInSettings settings);

  /// No trainee has signed in or begun to.
  bool asksForCode() const { return stage_ == TrainingStage::sign_in; }

  // Typing, while the screen asks for a code.
  void type(std::string_view letters);
  void erase();

  /// True if the act meant something here. Throws Error where the record cannot be written.
  bool act(TrainingAct act, int value);
  /// Returns to the choice after a session that is over or could not begin.
  void returnToChoice(std::string notice = {});
  void setNotice(std::string notice) { notice_ = std::move(notice); }

  TrainingStage stage() const { return stage_; }
  const training::TraineeRow& trainee() const { return trainee_; }
  const std::string& thimble() const { return settings_.thimble; }
  /// Once, when the choice was made. Who has a device is asked for the thimble first.
  std::optional<training::SessionKind> consumeChoice(bool has_device);
  void describe(TrainingView& view) const;

 private:
  void signIn();
  void enter();
  void choices();
  void signOut();
  bool choose(int value);

  training::Store& store_;
  training::Protocol protocol_;
  SignInSettings settings_;
  TrainingStage stage_ = TrainingStage::sign_in;
  std::string typed_;
  std::string code_;
  std::string notice_;
  training::TraineeRow trainee_;
  std::vector<Offer> offers_;
  std::optional<training::SessionKind> chosen_;
};

}  // namespace palpate::viewer
