#include "view/viewer/class_run.h"

#include <fmt/format.h>

#include <system_error>

#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr double kLooksEveryS = 0.5;

/// Absolute, so that it means the same to the started programs.
std::string wholePath(const std::string& folder) { return fs::absolute(pathOf(folder)).lexically_normal().string(); }

bool has(const std::string& folder, const char* file) {
  std::error_code ignored;
  return fs::exists(pathOf(folder) / file, ignored);
}

/// The last line that is not empty, without the name of the program.
std::string lastOutputLine(std::string_view words) {
  constexpr std::string_view kProgram = "palpate: ";
  std::string last;
  for (const std::string_view line : split(words, '\n')) {
    if (!trimmed(line).empty()) last = trimmed(line);
  }
  return last.starts_with(kProgram) ? last.substr(kProgram.size()) : last;
}

/// They use this window's language.
std::string languageCode() { return std::string(language().code); }

void endInOrder(std::unique_ptr<system::FedProgram>& program) {
  if (!program) return;
  program->sendInterrupt();
  program->finish();
  program.reset();
}

/// True once, when it has ended; `trouble` has the reason of a failure.
bool hasJustEnded(std::unique_ptr<system::FedProgram>& program, const char* what, std::string& trouble) {
  if (!program || !program->hasEnded()) return false;
  const std::string words = lastOutputLine(program->said());
  const system::FedProgram::Ending ending = program->finish();
  program.reset();
  if (!ending.well) {
    trouble = fmt::format("{}{}{}", trf("{} ended ({})", tr(what), ending.how), words.empty() ? "" : ": ", words);
  }
  return true;
}

}  // namespace

ClassRun::~ClassRun() {
  for (Program* program : {&init_, &join_, &watch_, &serve_}) endInOrder(*program);
}

ClassRun::Program ClassRun::started(std::vector<std::string> words, ClassShown& shown) const {
  words.insert(words.begin(), "palpate");
  auto program = std::make_unique<system::FedProgram>(classes_, words);
  if (program->reason() == 0) return program;
  shown.trouble = fmt::format("{}: {}", classes_.string(), std::generic_category().message(program->reason()));
  return nullptr;
}

void ClassRun::start(const StartClass& request, ClassShown& shown) {
  if (init_ || serve_) return;
  shown = {.offered = offered(), .folder = wholePath(request.folder), .watched = shown.watched, .joined = shown.joined};
  if (has(shown.folder, "class.toml")) return serve(shown);
  init_ = started({"class", "init", shown.folder, "--class", request.name, "--stations",
                   std::to_string(request.stations), "--host", request.computer},
                  shown);
}

void ClassRun::serve(ClassShown& shown) {
  serve_ = started({"class", "serve", shown.folder, "--broker", "--language", languageCode()}, shown);
  shown.runs = bool(serve_);
}

void ClassRun::watch(const std::string& folder, ClassShown& shown) {
  if (watch_) return;
  const std::string whole = wholePath(folder);
  shown.trouble.clear();
  if (!has(whole, "class.toml") && !has(whole, "instructor.toml")) {
    shown.trouble = trf("{} has no class.toml or instructor.toml", whole);
    return;
  }
  watch_ = started({"class", "watch", whole, "--language", languageCode()}, shown);
  shown.watched = bool(watch_);
}

void ClassRun::join(const std::string& folder, ClassShown& shown) {
  if (join_) return;
  const std::string whole = wholePath(folder);
  shown.trouble.clear();
  if (!has(whole, "station.toml")) {
    shown.trouble = trf("{} has no station.toml; name a station's folder, such as stations/s01", whole);
    return;
  }
  join_ = started({"train", "--class", whole, "--language", languageCode()}, shown);
  shown.joined = bool(join_);
}

void ClassRun::end(ClassShown& shown) {
  for (Program* program : {&init_, &join_, &watch_, &serve_}) endInOrder(*program);
  shown = {.offered = offered()};
}

void ClassRun::advance(double now_s, ClassShown& shown) {
  if (now_s - looked_s_ < kLooksEveryS) return;
  looked_s_ = now_s;
  if (init_ && hasJustEnded(init_, toTranslate("Making the class"), shown.trouble) && shown.trouble.empty())
    serve(shown);
  pollPrograms(shown);
}

void ClassRun::pollPrograms(ClassShown& shown) {
  if (serve_ && !serve_->hasEnded()) {
    shown.words = lastOutputLine(serve_->said());
    // Its first output means that broker and collector are running.
    if (!shown.words.empty() && !shown.opened_watch) {
      shown.opened_watch = true;
      watch(shown.folder, shown);
    }
  }
  if (hasJustEnded(serve_, toTranslate("The class"), shown.trouble)) shown.runs = false;
  if (hasJustEnded(watch_, toTranslate("The teacher's window"), shown.trouble)) shown.watched = false;
  if (hasJustEnded(join_, toTranslate("The training"), shown.trouble)) shown.joined = false;
}

}  // namespace palpate::viewer
