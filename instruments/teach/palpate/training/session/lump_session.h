// A session with lumps, from the instruction to the summary, as a machine of screens (sitting.h): practice asks
// whether there is a lump, where, and of which kind; an examination has every lump of six bodies named.
//
//   answers, places, samples ─► LumpSession ─► screen, question, words, what is hidden now (lump_bodies.h), rows to
//   keep
//
// Knows no clock, no window, no file. Every answer is in the rows (`drainRows`) at once, so that an interrupted session
// continues with the last question. One thread.
#pragma once

#include <string>
#include <vector>

#include "palpate/lumps/lump_block.h"
#include "palpate/training/session/lump_bodies.h"
#include "palpate/training/session/sitting.h"

namespace palpate::training {

/// Session of the kind lump or lump_exam; its plan has `bodies`. Its screens are instruction, trial (asks a question),
/// feedback (shows what there was, to be felt as well), block_summary and finished.
class LumpSession final : public Sitting {
 public:
  /// Throws Error where a resumed block does not fit.
  LumpSession(const SessionPlan& plan, const Moment& now);

  lumps::LumpQuestion question() const;
  /// Lumps of the current body. Never to be shown: `shown` is.
  std::vector<lumps::HiddenLump> hidden() const;
  /// Feedback of practice alone: the lumps as they are. Nothing on every other screen, and never in an examination.
  std::vector<lumps::HiddenLump> shown() const;
  /// Places that the trainee has named in this body so far.
  std::vector<lumps::LumpFinding> named() const;
  /// Whether the pressures under the finger may be shown now: in practice alone, before the answer if the protocol
  /// says so.
  bool padShown() const;
  int bodyNumber() const;  ///< from 1
  int bodiesAtMost() const;
  bool isExam() const;

  // Events.
  void ready(const Moment& now) override;
  void feel(const trace::Sample& sample, const Moment& now) override;
  void next(const Moment& now) override;
  // True: it was taken.
  bool answer(int choice, const Moment& now);
  bool answer(const Vec2& place_mm, const Moment& now);
  bool noMore(const Moment& now);
  /// While a body is asked about: stops the clock, hides nothing and accepts no answer.
  void pause(const Moment& now) override;

  lumps::LumpCounts counts() const;  ///< over the whole block

 private:
  struct Impl;
  std::string screenWord() const override;
  Impl& impl_;
};

// Texts (lump_words.cpp).

std::string lumpInstruction(bool exam);
std::string lumpQuestionText(lumps::LumpQuestion question, bool exam, std::size_t named);
/// The choices, in order: "no", "yes"; "small", "middle", "large"; ...
std::vector<std::string> lumpChoices(lumps::LumpQuestion question);
/// After a body of practice: right or not, where it lies, and of which kind it is.
std::string lumpFeedback(const lumps::LumpTrial& trial, const lumps::LumpTask& task, const SiteSet& sites);
std::string lumpSummary(const lumps::LumpCounts& counts, bool exam);

}  // namespace palpate::training
