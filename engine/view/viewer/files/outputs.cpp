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
bool attempt(ViewerState& viewer, const fs::path& file, const Action& action) {
  try {
    action();
    viewer.messages.clearErrors(file.string());
  } catch (const std::exception& error) {
    viewer.report(Severity::error, error.what());
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

void Outputs::addSample(ViewerState& viewer, const trace::Sample& sample) {
  try {
    forces_.add(sample);
  } catch (const std::exception& error) {
    endBrokenForces(viewer, error.what());
  }
}

/// The window continues, and names the remaining file.
void Outputs::endBrokenForces(ViewerState& viewer, const std::string& why) {
  viewer.recording.forces = false;
  const std::string kept = forces_.abandon();
  const std::string rest =
      kept.empty() ? std::string(tr("nothing of it could be saved")) : trf("what was written is kept in {}", kept);
  viewer.report(Severity::error, trf("The recording ended: {}; {}", why, rest));
}

void Outputs::toggleForces(ViewerState& viewer) {
  Recording& recording = viewer.recording;
  if (recording.forces) {
    recording.forces = false;
    try {
      forces_.stop();
      viewer.report(Severity::info, trf("Forces saved in {}", recording.forces_file));
    } catch (const std::exception& error) {
      endBrokenForces(viewer, error.what());
    }
    return;
  }
  const fs::path file = freshFile(folder_, "forces", ".csv");
  if (!attempt(viewer, file, [&] { forces_.start(file, viewer.ticks_per_s); })) return;
  recording.forces = true;
  recording.forces_file = file.string();
  recording.since_s = viewer.now_s;
  viewer.report(Severity::info, trf("Recording forces to {}; press R to stop", recording.forces_file));
}

void Outputs::toggleSequence(ViewerState& viewer) {
  Recording& recording = viewer.recording;
  if (recording.sequence) {
    recording.sequence = false;
    viewer.report(Severity::info, trf("{} pictures saved in {}", recording.pictures, recording.sequence_folder));
    return;
  }
  const fs::path folder = freshFile(folder_, "pictures", "");
  if (!attempt(viewer, folder, [&] { fs::create_directories(folder); })) return;
  recording.sequence = true;
  recording.sequence_folder = folder.string();
  recording.pictures = 0;
  viewer.report(Severity::info, trf("Recording pictures to {}", recording.sequence_folder));
}

void Outputs::savePlots(ViewerState& viewer) {
  const Plots& plots = viewer.plots;
  const fs::path file = freshFile(folder_, "plots", ".csv");
  const auto write = [&] { writeFile(file, historyAsCsv(plots.fingers, plots.shownEnd(), plots.window_s)); };
  if (attempt(viewer, file, write)) viewer.report(Severity::info, trf("Plots saved in {}", file.string()));
}

Outputs::Saving Outputs::saveScene(ViewerState& viewer, const SaveScene& request) {
  fs::path target = !request.file.empty() ? pathOf(request.file) : viewer.document.file;
  if (target.empty()) target = freshFile(folder_, "scene", ".toml");
  if (!request.sure && wouldOverwrite(viewer.document, target)) {
    const bool known = fs::absolute(target).lexically_normal() == viewer.document.file;
    viewer.ask({.kind = Question::Kind::overwrite,
                .words = known ? trf("{} has changed on disk since it was opened. Overwrite it?", target.string())
                               : trf("{} already exists. Overwrite it?", target.string()),
                .answers = {toTranslate("Overwrite"), toTranslate("Cancel")},
                .file = target.string()});
    return Saving::asked;
  }
  const scene::Scene scene = sceneToSave(viewer);
  SceneWriting written;
  if (!attempt(viewer, target, [&] { written = writeScene(scene, viewer.document, target); })) return Saving::failed;
  viewer.document = std::move(written.document);
  viewer.scene.view = scene.view;
  viewer.scene.strain = scene.strain;
  viewer.opened = {.look = viewer.state.look, .stereo = viewer.state.stereo};
  viewer.history.saved(viewer);
  std::string words = written.as_it_was ? trf("Nothing to save: {} is up to date", viewer.document.file.string())
                                        : trf("The scene is saved as {}", viewer.document.file.string());
  if (!written.kept.empty()) words += trf("; its comments could not be kept and are in {}", written.kept.string());
  viewer.report(Severity::info, words);
  return Saving::done;
}

void Outputs::useProfile(ViewerState& viewer) {
  fs::path& file = viewer.scene.deformation.profile_file;
  const bool ours = file.filename().string().starts_with(kProfileStem) && file.parent_path() == folder_;
  const fs::path target = ours ? file : freshFile(folder_, kProfileStem, ".csv");
  std::string table = "q,value\n";
  for (const tissue::ProfileKnot& knot : viewer.profile.knots) table += fmt::format("{},{}\n", knot.q, knot.value);
  if (!attempt(viewer, target, [&] { writeFile(target, table); })) return;
  file = target;
  viewer.profile.drawn = viewer.profile.knots;
  viewer.scene.deformation.forms.normal_profile.kind = tissue::ProfileKind::user;
  viewer.output.changed |= kMapChange;
}

void Outputs::saveFrame(ViewerState& viewer, view::Image image) {
  Recording& recording = viewer.recording;
  if (screenshot_) {
    const TakeScreenshot request = *std::exchange(screenshot_, std::nullopt);
    const fs::path file = request.file.empty() ? freshFile(folder_, "palpate", ".png") : pathOf(request.file);
    pictures_.write(file, image);
    // The next fresh name must not be the same one.
    pictures_.finish();
    reportErrors(viewer);
    if (fs::exists(file)) {
      viewer.report(Severity::info, trf("The picture is saved as {}", file.string()));
      saved_picture_ = file;
    }
  }
  if (film_.wants(viewer.now_s)) film_.add(image, viewer.now_s);
  if (!recording.sequence) return;
  const fs::path file =
      pathOf(recording.sequence_folder) / pathOf(fmt::format("frame_{:05d}.png", recording.pictures++));
  pictures_.write(file, std::move(image));
}

void Outputs::saveClearPicture(ViewerState& viewer, const view::CutOut& picture) {
  const fs::path file = freshFile(folder_, "palpate", ".png");
  if (!attempt(viewer, file, [&] { view::writePng(file, picture); })) return;
  viewer.report(Severity::info, trf("The picture without background is saved as {}", file.string()));
}

void Outputs::startFilm(ViewerState& viewer, const std::string& file) {
  stopFilm(viewer);
  film_.start(pathOf(file));
  viewer.recording.film = true;
  viewer.recording.film_since_s = viewer.now_s;
  viewer.report(Severity::info, trf("Filming to {}; stop with File > Stop the film", file));
}

void Outputs::stopFilm(ViewerState& viewer) {
  if (!viewer.recording.film) return;
  viewer.recording.film = false;
  film_.stop();
}

/// Reported when it is complete, which is some pictures after its end.
void Outputs::followFilm(ViewerState& viewer) {
  const std::optional<FilmRecorder::Ending> ending = film_.popEnding();
  if (!ending) return;
  viewer.recording.film = false;
  viewer.report(ending->trouble.empty() ? Severity::info : Severity::error,
                ending->trouble.empty() ? trf("The film is saved as {}", ending->file.string())
                                        : trf("The film ended: {}", ending->trouble));
}

void Outputs::reportErrors(ViewerState& viewer) {
  const std::string error = pictures_.popError();
  if (error.empty()) return;
  viewer.recording.sequence = false;
  viewer.report(Severity::error, error);
}

fs::path Outputs::saveBackup(const ViewerState& viewer) const {
  if (!viewer.history.changed()) return {};
  const fs::path& from = viewer.document.file;
  const fs::path target = from.empty() ? freshFile(folder_, "scene-backup", ".toml")
                                       : freshFile(from.parent_path(), from.stem().string() + "-backup", ".toml");
  scene::save(sceneToSave(viewer), target);
  return target;
}

void Outputs::finish(ViewerState& viewer) {
  if (viewer.recording.forces) toggleForces(viewer);
  if (viewer.recording.sequence) toggleSequence(viewer);
  pictures_.finish();
  reportErrors(viewer);
  stopFilm(viewer);
  film_.wait();
  followFilm(viewer);
}

}  // namespace palpate::viewer
