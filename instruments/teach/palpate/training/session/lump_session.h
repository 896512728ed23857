// A session with lumps, from the instruction to the summary, as a machine of screens like session.h: practice asks
// whether there is a lump, where, and of which kind; an examination has every lump of six bodies named.
//
//   answers, places, samples ─► LumpSession ─► screen, question, words, what is hidden now (lump_bodies.h), rows to
//   keep
//
// Knows no clock, no window, no file. Every answer is in the rows (`drainRows`) at once, so that an interrupted session
// continues with the last question. One thread.
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
  trial,     ///< asks a question
  feedback,  ///< practice: what there was is shown, and can be felt
  summary,
  finished,
};

struct LumpSessionPlan {
  Protocol protocol;
  SessionKind kind = SessionKind::lump;  ///< or lump_exam
  std::shared_ptr<const LumpBodies> bodies;
  SiteSet sites;  ///< names of places
  std::uint64_t seed = 1;
  double tick_s = 0.001;
  SessionRow row = {};                   ///< ids, station, device and file filled in
  std::optional<BlockRow> resumed = {};  ///< an interrupted block, which continues where it stopped
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
  /// The world at work holds `hidden` since now: the clock of the body starts.
  void ready(const Moment& now);
  void feel(const trace::Sample& sample, const Moment& now);
  void next(const Moment& now);  ///< "Next", "Start"
  // True: it was taken.
  bool answer(int choice, const Moment& now);
  bool answer(const Vec2& place_mm, const Moment& now);
  bool noMore(const Moment& now);
  /// While a body is asked about: stops the clock, hides nothing and accepts no answer.
  void pause(const Moment& now);
  void goOn(const Moment& now);
  bool paused() const;
  void leave(const Moment& now);

  const LumpSessionPlan& plan() const;
  const std::vector<TrialRow>& trials() const;  ///< bodies finished in this session
  lumps::LumpCounts counts() const;             ///< over the whole block
  std::vector<Row> drainRows();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
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

template <>
struct palpate::WordsOf<palpate::training::LumpScreen> {
  using V = palpate::training::LumpScreen;
  static constexpr std::array kAll = {Word{"instruction", V::instruction}, Word{"trial", V::trial},
                                      Word{"feedback", V::feedback}, Word{"summary", V::summary},
                                      Word{"finished", V::finished}};
};
