#include "view/viewer/files/outputs.h"

#include <fmt/format.h>

#include <utility>

#include "palpate/base/output_file.h"
#include "palpate/base/text.h"
#include "palpate/scene/scene_writer.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr const char* kProfileStem = "profile";

/// Does something with files; what goes wrong becomes a message.
template <class Action>
bool attempt(Session& session, const Action& action) {
  try {
    action();
  } catch (const std::exception& error) {
    session.report(Severity::error, error.what());
    return false;
  }
  return true;
}

}  // namespace

fs::path freshFile(const fs::path& folder, const std::string& stem, const std::string& kind) {
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  fs::path file = folder / (stem + kind);
  const auto taken = [&] { return fs::exists(file) || fs::exists(file.string() + std::string(kPartialExtension)); };
  for (int i = 2; taken(); ++i) file = folder / fmt::format("{}-{}{}", stem, i, kind);
  return file;
}

Outputs::~Outputs() {
  try {
    forces_.stop();
  } catch (const std::exception&) {
    // Nobody is left to be told; `finish` tells when somebody is.
  }
}

void Outputs::addSample(Session& session, const trace::Sample& sample) {
  try {
    forces_.add(sample);
  } catch (const std::exception& error) {
    endBrokenForces(session, error.what());
  }
}

/// The window goes on, and says what is left.
void Outputs::endBrokenForces(Session& session, const std::string& why) {
  session.recording.forces = false;
  const std::string kept = forces_.abandon();
  const std::string rest =
      kept.empty() ? std::string("nothing of it could be kept") : fmt::format("what was written is kept in {}", kept);
  session.report(Severity::error, fmt::format("The recording ended: {}; {}", why, rest));
}

void Outputs::toggleForces(Session& session) {
  Recording& recording = session.recording;
  if (recording.forces) {
    recording.forces = false;
    try {
      forces_.stop();
      session.report(Severity::info, fmt::format("Forces are in {}", recording.forces_file));
    } catch (const std::exception& error) {
      endBrokenForces(session, error.what());
    }
    return;
  }
  const fs::path file = freshFile(folder_, "forces", ".csv");
  if (!attempt(session, [&] { forces_.start(file, session.ticks_per_s); })) return;
  recording.forces = true;
  recording.forces_file = file.string();
  recording.since_s = session.now_s;
  session.report(Severity::info, fmt::format("Recording forces into {}; R ends it", recording.forces_file));
}

void Outputs::toggleSequence(Session& session) {
  Recording& recording = session.recording;
  if (recording.sequence) {
    recording.sequence = false;
    session.report(Severity::info, fmt::format("{} pictures are in {}", recording.pictures, recording.sequence_folder));
    return;
  }
  const fs::path folder = freshFile(folder_, "pictures", "");
  if (!attempt(session, [&] { fs::create_directories(folder); })) return;
  recording.sequence = true;
  recording.sequence_folder = folder.string();
  recording.pictures = 0;
  session.report(Severity::info, fmt::format("Recording pictures into {}", recording.sequence_folder));
}

void Outputs::savePlots(Session& session) {
  const Plots& plots = session.plots;
  const fs::path file = freshFile(folder_, "plots", ".csv");
  const auto write = [&] { writeFile(file, historyAsCsv(plots.fingers, plots.shownEnd(), plots.window_s)); };
  if (attempt(session, write)) session.report(Severity::info, fmt::format("The plots are in {}", file.string()));
}

Outputs::Saving Outputs::saveScene(Session& session, const SaveScene& request) {
  fs::path target = !request.file.empty() ? fs::path(request.file) : session.document.file;
  if (target.empty()) target = freshFile(folder_, "scene", ".toml");
  if (!request.sure && wouldOverwrite(session.document, target)) {
    const bool known = fs::absolute(target).lexically_normal() == session.document.file;
    session.ask({.kind = Question::Kind::overwrite,
                 .words = fmt::format("{} {}. Write over it?", target.string(),
                                      known ? "was changed by somebody else since it was opened" : "exists already"),
                 .answers = {"Overwrite", "Cancel"},
                 .file = target.string()});
    return Saving::asked;
  }
  const scene::Scene scene = sceneToSave(session);
  SceneWriting written;
  if (!attempt(session, [&] { written = writeScene(scene, session.document, target); })) return Saving::failed;
  session.document = std::move(written.document);
  session.scene.view = scene.view;
  session.scene.strain = scene.strain;
  session.opened = {.look = session.state.look, .stereo = session.state.stereo};
  session.history.saved(session);
  std::string words = written.as_it_was ? fmt::format("Nothing to save: {} says it all", session.document.file.string())
                                        : fmt::format("The scene is saved as {}", session.document.file.string());
  if (!written.kept.empty())
    words += fmt::format("; its comments could not be kept and are in {}", written.kept.string());
  session.report(Severity::info, std::move(words));
  return Saving::done;
}

void Outputs::useProfile(Session& session) {
  fs::path& file = session.scene.deformation.profile_file;
  const bool ours = file.filename().string().starts_with(kProfileStem) && file.parent_path() == folder_;
  const fs::path target = ours ? file : freshFile(folder_, kProfileStem, ".csv");
  std::string table = "q,value\n";
  for (const tissue::ProfileKnot& knot : session.profile.knots) table += fmt::format("{},{}\n", knot.q, knot.value);
  if (!attempt(session, [&] { writeFile(target, table); })) return;
  file = target;
  session.profile.drawn = session.profile.knots;
  session.scene.deformation.forms.normal_profile.kind = tissue::ProfileKind::user;
  session.asks.changed |= kMapChange;
}

void Outputs::keepFrame(Session& session, view::Image image) {
  Recording& recording = session.recording;
  if (screenshot_) {
    screenshot_ = false;
    const fs::path file = freshFile(folder_, "palpate", ".png");
    pictures_.write(file, image);
    // The next fresh name must not be the same one.
    pictures_.finish();
    if (fs::exists(file)) {
      session.report(Severity::info, fmt::format("The picture is saved as {}", file.string()));
      saved_picture_ = file;
    }
  }
  if (!recording.sequence) return;
  const fs::path file = fs::path(recording.sequence_folder) / fmt::format("frame_{:05d}.png", recording.pictures++);
  pictures_.write(file, std::move(image));
}

void Outputs::saveClearPicture(Session& session, const view::CutOut& picture) {
  const fs::path file = freshFile(folder_, "palpate", ".png");
  if (!attempt(session, [&] { view::writePng(file, picture); })) return;
  session.report(Severity::info, fmt::format("The picture without background is saved as {}", file.string()));
}

void Outputs::tellErrors(Session& session) {
  const std::string error = pictures_.takeError();
  if (error.empty()) return;
  session.recording.sequence = false;
  session.report(Severity::error, error);
}

fs::path Outputs::keepChanges(const Session& session) const {
  if (!session.history.changed()) return {};
  const fs::path& from = session.document.file;
  const fs::path target = from.empty() ? freshFile(folder_, "scene-backup", ".toml")
                                       : freshFile(from.parent_path(), from.stem().string() + "-backup", ".toml");
  scene::save(sceneToSave(session), target);
  return target;
}

void Outputs::finish(Session& session) {
  if (session.recording.forces) toggleForces(session);
  if (session.recording.sequence) toggleSequence(session);
  pictures_.finish();
  tellErrors(session);
}

}  // namespace palpate::viewer
