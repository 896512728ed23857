// The loop around a library's queries: the clock before and after each, within a budget of time.
#pragma once

#include <algorithm>
#include <ctime>

#include "lab/peers/peer.h"
#include "lab/runs/timed_run.h"
#include "palpate/base/stopwatch.h"

namespace palpate::bench {

/// Which of `count` queries to ask when one takes about `query_us`: all in their order when they fit into `seconds`,
/// otherwise blocks of consecutive ones, spread evenly; a few at least.
std::vector<std::uint32_t> affordableQueries(std::size_t count, double query_us, double seconds);

/// Bytes that the heap has handed out; nothing if the C library cannot tell.
std::optional<double> heapBytes();

/// Builds by `build()` and notes its time and its heap memory.
template <class Answer, class Build>
auto timedBuild(std::size_t triangles, PeerRun<Answer>& run, Build&& build) {
  const std::optional<double> before = heapBytes();
  const std::clock_t start = std::clock();  // processor time, so that other load does not count
  auto built = build();
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  run.build_ns_per_triangle = 1e9 * seconds / static_cast<double>(triangles);
  if (before) run.bytes_per_triangle = (*heapBytes() - *before) / static_cast<double>(triangles);
  return built;
}

/// `ask(i)` answers query i and is timed; `note(i)` gives its answer for the record and is not.
template <class Answer, class Ask, class Note>
void timeAnswers(std::size_t count, double seconds, PeerRun<Answer>& run, Ask&& ask, Note&& note) {
  const double empty_us = detail::emptyTimerMicroseconds();
  const auto microseconds_for = [&](std::size_t query) {
    const Clock::time_point start = Clock::now();
    ask(query);
    return std::max(0.0, microsecondsSince(start) - empty_us);
  };
  std::vector<double> trials;
  for (std::size_t i = count / 2; i < std::min(count, count / 2 + 5); ++i) trials.push_back(microseconds_for(i));
  run.asked = affordableQueries(count, lab::computePercentiles(trials).p50, seconds);
  run.answers.resize(run.asked.size());
  run.query_us.resize(run.asked.size());
  for (std::size_t k = 0; k < run.asked.size(); ++k) {
    // A block begins as if the queries before it had been asked: with caches and hints of the place.
    const bool begins_block = k == 0 || run.asked[k] != run.asked[k - 1] + 1;
    if (begins_block) ask(run.asked[k] > 0 ? run.asked[k] - 1 : 0);
    run.query_us[k] = microseconds_for(run.asked[k]);
    run.answers[k] = note(run.asked[k]);
  }
}

/// Answers to a finger: nearest(query) gives a distance, for queries that ask for one, and
/// crosses(query) whether the segment does.
template <class Nearest, class Crosses>
void timeContactAnswers(std::span<const ContactQuery> queries, double seconds, PeerRun<ContactAnswer>& run,
                        Nearest&& nearest, Crosses&& crosses) {
  ContactAnswer answer;
  const auto ask = [&](std::size_t i) {
    const ContactQuery& query = queries[i];
    answer = {};
    if (query.reach > 0.0) answer.distance = nearest(query);
    answer.crosses = crosses(query);
  };
  timeAnswers(queries.size(), seconds, run, ask, [&](std::size_t) { return answer; });
}

}  // namespace palpate::bench
