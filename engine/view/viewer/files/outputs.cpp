#include "view/viewer/files/outputs.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/language.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"
#include "palpate/scene/scene_writer.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr const char* kProfileStem = "profile";

/// Does something with a file; a failure becomes a message, which success removes again.
template <class Action>
bool attempt(Conversation& user, const fs::path& file, const Action& action) {
  try {
    action();
    user.messages.clearErrors(file.string());
  } catch (const std::exception& error) {
    user.report(Severity::error, error.what());
    return false;
  }
  return true;
}

}  // namespace

fs::path freshFile(const fs::path& folder, const std::string& stem, const std::string& kind) {
  fs::path file = folder / pathOf(stem + kind);
  const auto taken = [&] { return fs::exists(file) || fs::exists(withEnding(file, kPartialExtension)); };
  for (int i = 2; taken(); ++i) file = folder / pathOf(fmt::format("{}-{}{}", stem, i, kind));
  return file;
}

Outputs::~Outputs() {
  try {
    forces_.stop();
  } catch (const std::exception&) {
    // No one is left to read a message; `finish` reports it.
  }
}

void Outputs::addSample(const trace::Sample& sample) {
  try {
    forces_.add(sample);
  } catch (const std::exception& error) {
    endBrokenForces(error.what());
  }
}

/// The window continues, and names the remaining file.
void Outputs::endBrokenForces(const std::string& why) {
  user_.recording.forces = false;
  const std::string kept = forces_.abandon();
  const std::string rest =
      kept.empty() ? std::string(tr("nothing of it could be saved")) : trf("what was written is kept in {}", kept);
  user_.report(Severity::error, trf("The recording ended: {}; {}", why, rest));
}

void Outputs::stopForces() {
  user_.recording.forces = false;
  try {
    forces_.stop();
    user_.report(Severity::info, trf("Forces saved in {}", user_.recording.forces_file));
  } catch (const std::exception& error) {
    endBrokenForces(error.what());
  }
}

void Outputs::toggleForces(double ticks_per_s) {
  Recording& recording = user_.recording;
  if (recording.forces) return stopForces();
  const fs::path file = freshFile(folder_, "forces", ".csv");
  if (!attempt(user_, file, [&] { forces_.start(file, ticks_per_s); })) return;
  recording.forces = true;
  recording.forces_file = file.string();
  recording.since_s = user_.now_s;
  user_.report(Severity::info, trf("Recording forces to {}; press R to stop", recording.forces_file));
}

void Outputs::toggleSequence() {
  Recording& recording = user_.recording;
  if (recording.sequence) {
    recording.sequence = false;
    user_.report(Severity::info, trf("{} pictures saved in {}", recording.pictures, recording.sequence_folder));
    return;
  }
  const fs::path folder = freshFile(folder_, "pictures", "");
  if (!attempt(user_, folder, [&] { fs::create_directories(folder); })) return;
  recording.sequence = true;
  recording.sequence_folder = folder.string();
  recording.pictures = 0;
  user_.report(Severity::info, trf("Recording pictures to {}", recording.sequence_folder));
}

void Outputs::savePlots(const Plots& plots) {
  const fs::path file = freshFile(folder_, "plots", ".csv");
  const auto write = [&] { writeFile(file, historyAsCsv(plots.fingers, plots.shownEnd(), plots.window_s)); };
  if (attempt(user_, file, write)) user_.report(Severity::info, trf("Plots saved in {}", file.string()));
}

Outputs::Saving Outputs::saveScene(const SaveScene& request, EditedScene& edited, BodyView& seen) {
  fs::path target = !request.file.empty() ? pathOf(request.file) : edited.document.file;
  if (target.empty()) target = freshFile(folder_, "scene", ".toml");
  if (!request.sure && wouldOverwrite(edited.document, target)) {
    const bool known = fs::absolute(target).lexically_normal() == edited.document.file;
    user_.ask({.kind = Question::Kind::overwrite,
               .words = known ? trf("{} has changed on disk since it was opened. Overwrite it?", target.string())
                              : trf("{} already exists. Overwrite it?", target.string()),
               .answers = {toTranslate("Overwrite"), toTranslate("Cancel")},
               .file = target.string()});
    return Saving::asked;
  }
  const scene::Scene scene = sceneToSave(edited.scene, seen);
  SceneWriting written;
  if (!attempt(user_, target, [&] { written = writeScene(scene, edited.document, target); })) return Saving::failed;
  edited.document = std::move(written.document);
  edited.scene.view = scene.view;
  edited.scene.strain = scene.strain;
  seen.opened = {.look = seen.state.look, .stereo = seen.state.stereo};
  edited.history.saved(edited, seen);
  std::string words = written.as_it_was ? trf("Nothing to save: {} is up to date", edited.document.file.string())
                                        : trf("The scene is saved as {}", edited.document.file.string());
  if (!written.kept.empty()) words += trf("; its comments could not be kept and are in {}", written.kept.string());
  user_.report(Severity::info, words);
  return Saving::done;
}

void Outputs::useProfile(EditedScene& edited) {
  fs::path& file = edited.scene.deformation.profile_file;
  const bool ours = file.filename().string().starts_with(kProfileStem) && file.parent_path() == folder_;
  const fs::path target = ours ? file : freshFile(folder_, kProfileStem, ".csv");
  std::string table = "q,value\n";
  for (const tissue::ProfileKnot& knot : edited.profile.knots) table += fmt::format("{},{}\n", knot.q, knot.value);
  if (!attempt(user_, target, [&] { writeFile(target, table); })) return;
  file = target;
  edited.profile.drawn = edited.profile.knots;
  edited.scene.deformation.forms.normal_profile.kind = tissue::ProfileKind::user;
  user_.output.changed |= kMapChange;
}

void Outputs::saveFrame(view::Image image) {
  Recording& recording = user_.recording;
  if (screenshot_) {
    const TakeScreenshot request = *std::exchange(screenshot_, std::nullopt);
    const fs::path file = request.file.empty() ? freshFile(folder_, "palpate", ".png") : pathOf(request.file);
    pictures_.write(file, image);
    // The next fresh name must not be the same one.
    pictures_.finish();
    reportErrors();
    if (fs::exists(file)) {
      user_.report(Severity::info, trf("The picture is saved as {}", file.string()));
      saved_picture_ = file;
    }
  }
  if (film_.wants(user_.now_s)) film_.add(image, user_.now_s);
  if (!recording.sequence) return;
  const fs::path file =
      pathOf(recording.sequence_folder) / pathOf(fmt::format("frame_{:05d}.png", recording.pictures++));
  pictures_.write(file, std::move(image));
}

void Outputs::saveClearPicture(const view::CutOut& picture) {
  const fs::path file = freshFile(folder_, "palpate", ".png");
  if (!attempt(user_, file, [&] { view::writePng(file, picture); })) return;
  user_.report(Severity::info, trf("The picture without background is saved as {}", file.string()));
}

void Outputs::startFilm(const std::string& file) {
  stopFilm();
  film_.start(pathOf(file));
  user_.recording.film = true;
  user_.recording.film_since_s = user_.now_s;
  user_.report(Severity::info, trf("Filming to {}; stop with File > Stop the film", file));
}

void Outputs::stopFilm() {
  if (!user_.recording.film) return;
  user_.recording.film = false;
  film_.stop();
}

/// Reported when it is complete, which is some pictures after its end.
void Outputs::followFilm() {
  const std::optional<FilmRecorder::Ending> ending = film_.popEnding();
  if (!ending) return;
  user_.recording.film = false;
  user_.report(ending->trouble.empty() ? Severity::info : Severity::error,
               ending->trouble.empty() ? trf("The film is saved as {}", ending->file.string())
                                       : trf("The film ended: {}", ending->trouble));
}

void Outputs::reportErrors() {
  const std::string error = pictures_.popError();
  if (error.empty()) return;
  user_.recording.sequence = false;
  user_.report(Severity::error, error);
}

fs::path Outputs::saveBackup(const EditedScene& edited, const BodyView& seen) const {
  if (!edited.history.changed()) return {};
  const fs::path& from = edited.document.file;
  const fs::path target = from.empty() ? freshFile(folder_, "scene-backup", ".toml")
                                       : freshFile(from.parent_path(), from.stem().string() + "-backup", ".toml");
  scene::save(sceneToSave(edited.scene, seen), target);
  return target;
}

void Outputs::finish() {
  if (user_.recording.forces) stopForces();
  if (user_.recording.sequence) toggleSequence();
  pictures_.finish();
  reportErrors();
  stopFilm();
  film_.wait();
  followFilm();
}

}  // namespace palpate::viewer
