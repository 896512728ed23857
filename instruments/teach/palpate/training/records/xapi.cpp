// Statements for a learning record store: who (an account under a pseudonym), did what, to which activity, with what
// result. A session is a registration; its blocks and trials are its activities.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <map>

#include "palpate/base/json.h"
#include "palpate/training/psychometric.h"
#include "palpate/training/records/export.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/records/verify.h"

namespace palpate::training {

namespace {

/// "2026-11-22T10:00:00.125Z"
std::string isoTime(std::int64_t ms) {
  const std::time_t seconds = static_cast<std::time_t>(ms / 1000);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(seconds), ms % 1000);
}

/// ISO 8601, in hundredths of a second as the specification wants it.
std::string isoDuration(double seconds) { return fmt::format("PT{:.2f}S", seconds); }

/// The same rows, the same ids.
Uuid statementId(std::string_view verb, const Uuid& of) { return uuidOfText(fmt::format("xapi {} {}", verb, of)); }

class XapiStatements {
 public:
  XapiStatements(RowTables& rows, const XapiSettings& settings) : rows_(rows), home_(settings.home_page) {
    while (home_.ends_with('/')) home_.pop_back();
  }

  std::string text() {
    for (const TraineeRow& trainee : rows_.trainees()) {
      for (const SessionRow& session : rows_.sessions(trainee.id)) addStatements(session);
    }
    Json list = Json::array();
    for (const auto& [when, statement] : statements_) list.push_back(statement);
    return jsonDump(list, 1) + "\n";
  }

 private:
  std::string iri(std::string_view what, std::string_view id) const { return fmt::format("{}/{}/{}", home_, what, id); }
  std::string extension(std::string_view name) const { return iri("extension", name); }

  Json activity(std::string_view what, const Uuid& id, const std::string& name, std::string_view type) const {
    return {{"objectType", "Activity"},
            {"id", iri(what, id)},
            {"definition",
             {{"name", {{"en", name}}}, {"type", fmt::format("http://adlnet.gov/expapi/activities/{}", type)}}}};
  }
  Json sessionActivity(const SessionRow& session) const {
    const std::string name = fmt::format("Palpation: {}", wordFor(session.kind));
    return activity("session", session.id, name, session.kind == SessionKind::exam ? "assessment" : "lesson");
  }

  Json& add(const SessionRow& session, std::string_view verb, const Uuid& of, std::int64_t at_ms, Json object) {
    const Json statement = {
        {"id", statementId(verb, of)},
        {"actor", {{"objectType", "Agent"}, {"account", {{"homePage", home_}, {"name", session.trainee_id}}}}},
        {"verb",
         {{"id", fmt::format("http://adlnet.gov/expapi/verbs/{}", verb)}, {"display", {{"en", std::string(verb)}}}}},
        {"object", std::move(object)},
        {"context",
         {{"registration", session.id},
          {"platform", session.device},
          {"contextActivities", {{"parent", Json::array({sessionActivity(session)})}}}}},
        {"timestamp", isoTime(at_ms)},
        {"version", "1.0.3"}};
    return statements_.emplace(at_ms, statement)->second;
  }

  void addStatements(const SessionRow& session) {
    add(session, "initialized", session.id, session.start_ms, sessionActivity(session));
    for (const BlockRow& block : rows_.blocks(session.id)) {
      std::int64_t end = session.start_ms;
      for (const TrialRow& trial : rows_.trials(block.id)) {
        addStatements(session, trial);
        end = std::max(end, trial.end_ms);
      }
      if (block.finished) addStatements(session, block, end);
    }
  }

  void addStatements(const SessionRow& session, const TrialRow& trial) {
    Json object = activity("trial", trial.id, fmt::format("Trial {}", trial.number), "cmi.interaction");
    object["definition"]["interactionType"] = "numeric";
    Json& statement = add(session, "answered", trial.id, trial.end_ms, std::move(object));
    statement["result"] = {{"success", trial.correct},
                           {"response", trial.site_answer == 0 ? "" : std::to_string(trial.site_answer)},
                           {"duration", isoDuration(trial.seconds)},
                           {"extensions",
                            {{extension("kind"), wordFor(trial.kind)},
                             {extension("change"), trial.change},
                             {extension("site_true"), trial.site_true},
                             {extension("timed_out"), trial.timed_out},
                             {extension("sites_felt"), trial.sites_felt},
                             {extension("counts"), trial.excluded.empty() && trial.kind != TrialKind::warm_up}}}};
  }

  void addStatements(const SessionRow& session, const BlockRow& block, std::int64_t end_ms) {
    const Json object = activity("block", block.id, fmt::format("Block {}", block.number), "assessment");
    Json result = {{"completion", true}, {"extensions", {{extension("trials"), block.trials}}}};
    Json& more = result["extensions"];
    if (block.mastered_change) more[extension("mastered_change")] = *block.mastered_change;
    if (block.method != Method::mastery && block.threshold > 0.0) {
      more[extension("threshold")] = block.threshold;
      more[extension("threshold_low")] = block.threshold_low;
      more[extension("threshold_high")] = block.threshold_high;
      if (!hidesLumps(session.kind)) more[extension("threshold_definition")] = kThresholdDefinition;
      more[extension("change_meaning")] = wordFor(block.change_meaning);
    }
    add(session, "completed", block.id, end_ms, object)["result"] = result;
    if (session.kind != SessionKind::exam && session.kind != SessionKind::lump_exam) return;
    if (block.verdict != Verdict::pass && block.verdict != Verdict::not_yet) return;
    const bool passed = block.verdict == Verdict::pass;
    result["success"] = passed;
    result["score"] = {{"scaled", computeScore(session, block).value_or(passed ? 1.0 : 0.0)}};
    add(session, passed ? "passed" : "failed", block.id, end_ms, object)["result"] = result;
  }

  /// 0 to 1; of an examination with lumps the share that was found.
  std::optional<double> computeScore(const SessionRow& session, const BlockRow& block) {
    if (session.kind == SessionKind::lump_exam) {
      const auto counts = recomputedLumps(rows_, block);
      if (!counts || counts->lumps == 0) return std::nullopt;
      return static_cast<double>(counts->found) / counts->lumps;
    }
    const auto again = recomputed(rows_, block, session.kind);
    return again ? std::optional(again->probability_below_mark) : std::nullopt;
  }

  RowTables& rows_;
  std::string home_;
  std::multimap<std::int64_t, Json> statements_;  // by their times
};

}  // namespace

std::string xapiText(RowTables& rows, const XapiSettings& settings) { return XapiStatements(rows, settings).text(); }

}  // namespace palpate::training
