// A sitting with lumps, from the instruction to the summary, as a machine of screens beside session.h: practice asks
// whether there is a lump, where, and of which kind; an examination has every lump of six bodies named.
//
//   answers, places, samples ─► LumpSession ─► screen, question, words, what is hidden now (lump_bodies.h), rows to
//   keep
//
// Knows no clock, no window, no file. Every single answer is in the rows (`takeRows`) at once, so that a sitting which
// was interrupted goes on with the question that was asked last. One thread.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/lumps/lump_block.h"
#include "palpate/training/session/lump_bodies.h"
#include "palpate/training/session/session.h"

namespace palpate::training {

enum class LumpScreen : std::uint8_t {
  instruction,
  trial,     ///< a question is asked
  feedback,  ///< practice: what there was is shown, and can be felt
  summary,
  finished,
};

struct LumpSessionPlan {
  Protocol protocol;
  SessionKind kind = SessionKind::lump;  ///< or lump_exam
  std::shared_ptr<const LumpBodies> bodies;
  SiteSet sites;  ///< what places are called by
  std::uint64_t seed = 1;
  double tick_s = 0.001;
  SessionRow row = {};                   ///< ids, station, device and file filled in
  std::optional<BlockRow> resumed = {};  ///< a block that was interrupted: goes on where it stopped
};

class LumpSession {
 public:
  /// Throws Error where a resumed block does not fit.
  LumpSession(const LumpSessionPlan& plan, const Moment& now);
  ~LumpSession();
  LumpSession(const LumpSession&) = delete;
  LumpSession& operator=(const LumpSession&) = delete;

  LumpScreen screen() const;
  Said said() const;
  lumps::LumpQuestion question() const;
  /// What the body that is felt now must hold. Never to be shown: `shown` is.
  std::vector<lumps::HiddenLump> hidden() const;
  /// Feedback of practice alone: the lumps as they are. Nothing on every other screen, and never in an examination.
  std::vector<lumps::HiddenLump> shown() const;
  /// What was named in this body so far: the trainee's own places.
  std::vector<lumps::LumpFinding> named() const;
  /// Whether the pressures under the finger may be shown now: in practice alone, before the answer if the protocol
  /// says so.
  bool padShown() const;
  int bodyNumber() const;  ///< from 1
  int bodiesAtMost() const;
  bool isExam() const;

  // Events.
  /// The world at work holds `hidden` since now: the clock of the body starts.
  void ready(const Moment& now);
  void feel(const trace::Sample& sample, const Moment& now);
  void next(const Moment& now);  ///< "Next", "Start"
  // True: it was taken.
  bool answer(int choice, const Moment& now);
  bool answer(const Vec2& place_mm, const Moment& now);
  bool noMore(const Moment& now);
  /// While a body is asked about: the clock stands still, nothing is hidden and nothing can be answered.
  void pause(const Moment& now);
  void goOn(const Moment& now);
  bool paused() const;
  void leave(const Moment& now);

  const LumpSessionPlan& plan() const;
  const std::vector<TrialRow>& trials() const;  ///< bodies that were done in this sitting
  lumps::LumpCounts counts() const;             ///< of the whole block
  std::vector<Row> takeRows();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// What is said (lump_words.cpp).

std::string lumpInstruction(bool exam);
std::string lumpQuestionWords(lumps::LumpQuestion question, bool exam, std::size_t named);
/// What is chosen from, in the order of the choices: "no", "yes"; "small", "middle", "large"; ...
std::vector<std::string> lumpChoices(lumps::LumpQuestion question);
/// After a body of practice: right or not, where it lies, and of which kind it is.
std::string lumpFeedback(const lumps::LumpTrial& trial, const lumps::LumpTask& task, const SiteSet& sites);
std::string lumpSummary(const lumps::LumpCounts& counts, bool exam);

}  // namespace palpate::training

template <>
struct palpate::WordsOf<palpate::training::LumpScreen> {
  using V = palpate::training::LumpScreen;
  static constexpr std::array kAll = {Word{"instruction", V::instruction}, Word{"trial", V::trial},
                                      Word{"feedback", V::feedback}, Word{"summary", V::summary},
                                      Word{"finished", V::finished}};
};
