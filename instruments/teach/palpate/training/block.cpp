#include "palpate/training/block.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/random.h"
#include "palpate/training/block_state.h"
#include "palpate/training/marginal_psi.h"
#include "palpate/training/staircase.h"

namespace palpate::training {

namespace {

/// Random streams of a seed, one per purpose, which do not disturb each other.
enum class DrawnFor : std::uint64_t { sites = 1, easy, order };

Random makeRandomStream(std::uint64_t seed, DrawnFor what) {
  Random mixed(seed ^ (static_cast<std::uint64_t>(what) * 0xd1342543de82ef95ull));
  return Random(mixed.bits());
}

bool walks(Method method) { return method == Method::two_down_one_up || method == Method::mastery; }

std::vector<double> levelsAskedFor(const BlockSettings& settings) {
  if (!settings.levels.empty()) return settings.levels;
  if (settings.method == Method::marginal_psi || settings.method == Method::two_down_one_up) {
    return adaptiveLevels(settings.meaning);
  }
  std::vector<double> rising(kVhbLevels.begin(), kVhbLevels.end());
  std::reverse(rising.begin(), rising.end());
  return rising;
}

void require(bool holds, std::string_view otherwise) {
  if (!holds) throw Error::inFile("block", otherwise);
}

void checkLevels(const BlockSettings& settings) {
  const double most = settings.meaning == ChangeMeaning::compliance ? kMaxComplianceChange : 10.0;
  for (std::size_t i = 0; i < settings.levels.size(); ++i) {
    require(settings.levels[i] > 0.0 && settings.levels[i] <= most,
            fmt::format("levels must be above 0 and at most {}", most));
    require(i == 0 || settings.levels[i] > settings.levels[i - 1], "levels must rise");
  }
}

void checkSettings(const BlockSettings& settings) {
  require(settings.meaning != ChangeMeaning::cue, "a hidden place has no cue; meaning is compliance or stiffness");
  checkLevels(settings);
  require(settings.choices >= 2 && settings.choices <= 1000, "there must be at least two places to choose from");
  require(settings.start > 0.0 && settings.start <= 10.0, "the start must be over 0");
  require(settings.warm_up >= 0 && settings.warm_up <= 1000, "the number of warm-up trials must be 0 to 1000");
  require(settings.easy >= 0, "the number of easy trials must not be negative");
  require(settings.easy_share >= 0.0 && settings.easy_share <= 0.5, "the share of easy trials must be 0 to 0.5");
  require(settings.easy_share == 0.0 || walks(settings.method), "a share of easy trials is for methods that walk");
  const StopRule& stop = settings.stop;
  require(stop.least >= 1 && stop.least <= stop.most, "the least number of trials must be 1 to the most");
  require(stop.most <= 10'000, "the most trials must be 10,000 or fewer");
  require(settings.easy <= stop.most, "there are more easy trials than trials");
  require(stop.half_width >= 0.0, "the half width must not be negative");
  require(stop.mark >= 0.0 && stop.mark < 10.0, "the pass mark must be 0 or over");
  require(stop.sure >= 0.5 && stop.sure < 1.0, "to be sure means 0.5 up to, and not, 1");
  const Prior& prior = settings.prior;
  require(prior.threshold > 0.0 && prior.sd_ln_t > 0.0 && prior.slope >= 0.0 && prior.sd_ln_slope > 0.0,
          "the prior must be of positive numbers");
}

/// Shuffled rounds: everything once before anything comes twice.
class Rounds {
 public:
  Rounds(std::size_t size, Random random) : random_(random), order_(size), at_(size) {
    for (std::size_t i = 0; i < size; ++i) order_[i] = i;
  }
  std::size_t next() {
    if (at_ == order_.size()) shuffle();
    return order_[at_++];
  }

 private:
  void shuffle() {
    for (std::size_t i = order_.size(); i > 1; --i) std::swap(order_[i - 1], order_[random_.below(i)]);
    at_ = 0;
  }
  Random random_;
  std::vector<std::size_t> order_;
  std::size_t at_;
};

/// Which of the measured trials are easy: one at a drawn place of every stretch, so that they cannot be counted off.
class EasyTrials {
 public:
  EasyTrials(const BlockSettings& settings, Random random) : random_(random) {
    if (settings.easy > 0) {
      left_ = settings.easy;
      const double usual_trials = 0.5 * (settings.stop.least + settings.stop.most);
      stretch_ = std::max(1, static_cast<int>(usual_trials / settings.easy));
    } else if (settings.easy_share > 0.0) {
      left_ = settings.stop.most;
      stretch_ = std::max(2, static_cast<int>(std::lround(1.0 / settings.easy_share)));
    }
  }
  /// Asked once for each measured trial, in order.
  bool next() {
    if (left_ == 0) return false;
    if (at_ == 0) drawn_ = static_cast<int>(random_.below(static_cast<std::uint64_t>(stretch_)));
    const bool easy = at_ == drawn_;
    if (easy) --left_;
    at_ = (at_ + 1) % stretch_;
    return easy;
  }

 private:
  Random random_;
  int left_ = 0;
  int stretch_ = 1;
  int at_ = 0;
  int drawn_ = 0;
};

}  // namespace

struct Block::Impl {
  Impl(const BlockSettings& wanted, std::uint64_t from_seed)
      : settings(wanted),
        levels(levelsAskedFor(wanted)),
        posterior(wanted.choices, wanted.prior),
        sites(static_cast<std::size_t>(wanted.choices), makeRandomStream(from_seed, DrawnFor::sites)),
        independent_site(makeRandomStream(from_seed, DrawnFor::sites)),
        easy(wanted, makeRandomStream(from_seed, DrawnFor::easy)),
        order(levels.size(), makeRandomStream(from_seed, DrawnFor::order)) {
    state.seed = from_seed;
    if (settings.method == Method::marginal_psi) psi.emplace(levels, posterior);
    if (settings.method == Method::two_down_one_up) staircase.emplace(levels, settings.start, twoDownOneUp(levels));
    if (settings.method == Method::mastery) mastery.emplace(levels, settings.start);
    plan();
  }

  int drawSite() {
    if (settings.draw == SiteDraw::balanced) return 1 + static_cast<int>(sites.next());
    return 1 + static_cast<int>(independent_site.below(static_cast<std::uint64_t>(settings.choices)));
  }

  /// It ends when it is sure on which side of the mark T lies, and asks for that instead of T.
  bool decides() const { return settings.stop.mark > 0.0 && settings.stop.least < settings.stop.most; }

  double measuredChange() {
    if (psi) return levels[decides() ? psi->bestAtMark(posterior, settings.stop.mark) : psi->best(posterior)];
    if (staircase) return staircase->change();
    if (mastery) return mastery->change();
    return levels[order.next()];
  }

  void plan() {
    planned.number = static_cast<int>(state.outcomes.size()) + 1;
    planned.site = drawSite();
    if (planned.number <= settings.warm_up) {
      planned.kind = TrialKind::warm_up;
    } else {
      planned.kind = easy.next() ? TrialKind::easy : TrialKind::measured;
    }
    planned.change = planned.kind == TrialKind::measured ? measuredChange() : levels.back();
  }

  /// Only felt places inform: a trainee who felt one place alone had nothing to compare it with.
  static bool counts(const TrialOutcome& outcome) { return outcome.target_visited && outcome.visited >= 2; }

  void addOutcome(const TrialOutcome& outcome) {
    state.outcomes.push_back(outcome);
    if (planned.kind != TrialKind::warm_up) measure(outcome);
    over = isOver();
    if (!over) plan();
  }

  void measure(const TrialOutcome& outcome) {
    ++given;
    if (!counts(outcome)) {
      ++excluded;
      return;
    }
    if (outcome.correct) ++correct;
    posterior.add(
        {.change = planned.change, .correct = outcome.correct, .choices = std::min(outcome.visited, settings.choices)});
    if (planned.kind == TrialKind::easy) return;
    if (staircase) staircase->answer(outcome.correct);
    if (mastery) mastery->answer(outcome.correct);
  }

  /// Excluded trials cost time too: they count towards the most, not towards the least.
  bool isOver() const {
    const StopRule& stop = settings.stop;
    if (given >= stop.most) return true;
    if (given - excluded < stop.least) return false;
    if (mastery && mastery->masteredAll()) return true;
    if (stop.half_width > 0.0 && posterior.summary().halfWidth() < stop.half_width) return true;
    return stop.mark > 0.0 && verdict() != Verdict::repeat;
  }

  /// With a pass mark: the verdict so far.
  Verdict verdict() const {
    const double below = posterior.probabilityBelow(settings.stop.mark);
    if (below > settings.stop.sure) return Verdict::pass;
    return below < 1.0 - settings.stop.sure ? Verdict::not_yet : Verdict::repeat;
  }

  BlockSettings settings;
  std::vector<double> levels;
  BlockState state;
  Posterior posterior;
  std::optional<MarginalPsi> psi;
  std::optional<Staircase> staircase;
  std::optional<Mastery> mastery;
  Rounds sites;             ///< balanced draw
  Random independent_site;  ///< independent draw
  EasyTrials easy;
  Rounds order;  ///< for constant levels
  PlannedTrial planned;
  bool over = false;
  int given = 0;     ///< without warm-up
  int excluded = 0;  ///< given trials that do not count
  int correct = 0;   ///< counted trials that were right
};

Block::Block(const BlockSettings& settings, std::uint64_t seed) {
  checkSettings(settings);
  impl_ = std::make_unique<Impl>(settings, seed);
}
Block::~Block() = default;
Block::Block(Block&&) noexcept = default;
Block& Block::operator=(Block&&) noexcept = default;

bool Block::finished() const { return impl_->over; }

const PlannedTrial& Block::next() const { return impl_->planned; }

void Block::answer(const TrialOutcome& outcome) {
  require(!impl_->over, "it is over, nothing more can be answered");
  impl_->addOutcome(outcome);
}

BlockResult Block::result() const {
  const Impl& course = *impl_;
  BlockResult result;
  result.trials = course.given - course.excluded;
  result.correct = course.correct;
  result.excluded = course.excluded;
  result.threshold = course.posterior.summary();
  if (course.mastery) result.level = course.mastery->mastered();
  if (course.settings.stop.mark > 0.0) {
    result.probability_below_mark = course.posterior.probabilityBelow(course.settings.stop.mark);
    if (course.over) result.verdict = course.verdict();
  }
  return result;
}

const Posterior& Block::posterior() const { return impl_->posterior; }
const BlockSettings& Block::settings() const { return impl_->settings; }
int Block::answered() const { return static_cast<int>(impl_->state.outcomes.size()); }

std::string Block::state() const { return blockStateText(impl_->settings, impl_->state); }

Block Block::resumed(const BlockSettings& settings, std::string_view state) {
  checkSettings(settings);
  const BlockState read = parseBlockState(settings, state);
  Block block(settings, read.seed);
  for (const TrialOutcome& outcome : read.outcomes) {
    if (block.finished()) throw Error::inFile("state of a block", "more outcomes than its settings allow");
    block.answer(outcome);
  }
  return block;
}

}  // namespace palpate::training
