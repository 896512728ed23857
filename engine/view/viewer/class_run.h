// A class that is run from the window: the commands of `palpate class` and `palpate train --class`, each as a program
// of its own, started and stopped properly.
//
//   StartClass ─► class init (for a new class) ─► class serve --broker ─► class watch
//   JoinClass ─► train --class;  WatchClass ─► class watch
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/system/fed_program.h"
#include "view/viewer/state/requests.h"
#include "view/viewer/state/viewer_parts.h"

namespace palpate::viewer {

class ClassRun {
 public:
  /// `classes`: palpate-class; empty: it is not installed.
  explicit ClassRun(std::filesystem::path classes) : classes_(std::move(classes)) {}
  ClassRun(const ClassRun&) = delete;
  ClassRun& operator=(const ClassRun&) = delete;
  /// Stops the running programs properly.
  ~ClassRun();

  bool offered() const { return !classes_.empty(); }
  /// None of these waits: `advance` reports the outcome. Faults of the request are reported at once.
  void start(const StartClass& request, ClassShown& shown);
  void watch(const std::string& folder, ClassShown& shown);
  void join(const std::string& folder, ClassShown& shown);
  /// Waits for all to stop, a second or two.
  void end(ClassShown& shown);
  /// Once a frame.
  void advance(double now_s, ClassShown& shown);

 private:
  using Program = std::unique_ptr<system::FedProgram>;
  Program started(std::vector<std::string> words, ClassShown& shown) const;
  void serve(ClassShown& shown);
  void pollPrograms(ClassShown& shown);

  std::filesystem::path classes_;
  Program init_, serve_, watch_, join_;
  double looked_s_ = 0.0;
};

}  // namespace palpate::viewer
