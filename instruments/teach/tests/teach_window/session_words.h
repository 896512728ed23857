// A session without a window, and what its screens say.
#pragma once

#include "palpate/training/session/session.h"
#include "teach/tests/training/twelve.h"
#include "teach/window/training_words.h"

namespace palpate::viewer {

/// A session that somebody goes through who presses all and answers right or wrong in turn.
class WordsOfSession {
 public:
  explicit WordsOfSession(training::SessionKind kind, bool familiar = true)
      : session({.protocol = training::builtInProtocol(),
                 .kind = kind,
                 .sites = training::flatTwelve(),
                 .seed = 3,
                 .row = {.id = "018f3c1e-0000-7000-8000-000000000001"},
                 .familiar = familiar},
                {}) {}

  TrainingScreen screen(int picked = 0, double force_share = 1.0, double ratios_kept_to_n = 0.0) const {
    TrainingView view;
    view.force_share = force_share;
    view.ratios_kept_to_n = ratios_kept_to_n;
    view.stage = TrainingStage::session;
    view.by_mouse = by_mouse;
    view.session = &session;
    view.picked = picked;
    view.now = {.s = s};
    return makeTrainingScreen(view);
  }
  void pressAll(int but = 0) {
    for (const training::Site& site : session.plan().sites.sites) {
      for (int i = 0; i < 400 && site.number != but; ++i) {
        s += 0.001;
        session.feel(training::pressAt(site.point_mm, 1.0), {.s = s});
      }
    }
  }
  void answer(bool right) {
    const int truth = session.hidden()->site;
    session.answer(right ? truth : truth % 12 + 1, {.s = s});
  }

  training::Session session;
  double s = 0.0;
  bool by_mouse = true;
};

}  // namespace palpate::viewer
