// Marks need some hundredths of a second, so one measuring of them is always finished: while a slider is pulled,
// results follow it. Photographs need seconds and are cancelled at their next report of progress.
#include "measure/window/measuring_work.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <utility>

#include "measure/window/measuring_view.h"
#include "palpate/measure/photograph.h"

namespace palpate::viewer {

namespace {

struct GivenUp : std::exception {};

view::Image makePreview(const measure::Photograph& photo) {
  view::Image image(photo.width_px, photo.height_px);
  std::memcpy(image.pixels.data(), photo.rgb.data(), photo.rgb.size());
  while (std::max(image.width, image.height) > kMaxShownPx) {
    // Halving wants even sizes: an odd last row or column is left out.
    view::Image even(image.width / 2 * 2, image.height / 2 * 2);
    for (int y = 0; y < even.height; ++y) std::copy_n(&image.at(0, y), even.width, &even.at(0, y));
    image = view::reduced(even, 2);
  }
  return image;
}

bool has(const std::vector<measure::Finding>& findings, const measure::Finding& wanted) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const auto& finding) { return finding.text == wanted.text; });
}

/// Findings that the marks of the same photographs do not show: time stamps, colours, the stick.
std::vector<measure::Finding> photographOnlyFindings(const measure::Measurement& whole) {
  const measure::DotPair marks = photoMarks(whole);
  const std::vector<measure::Finding> by_marks = measure::measureDots(marks, whole.settings).findings;
  std::vector<measure::Finding> alone = whole.findings;
  std::erase_if(alone, [&](const measure::Finding& finding) { return has(by_marks, finding); });
  return alone;
}

void measurePhotographs(const std::array<std::optional<measure::Photograph>, 2>& photos, const MeasuringJob& job,
                        const Progress& progress, MeasuringResult& result) {
  measure::Measurement whole = measure::measurePair(*photos[0], *photos[1], job.settings, progress);
  result.of_photographs_alone = photographOnlyFindings(whole);
  result.measured = std::make_shared<measure::Measurement>(std::move(whole));
}

void measureMarks(const MeasuringJob& job, const Progress& progress, MeasuringResult& result) {
  measure::Measurement of_marks = measure::measureDots(job.marks, job.settings, progress);
  of_marks.width_px = job.width_px;
  of_marks.height_px = job.height_px;
  of_marks.findings.insert(of_marks.findings.end(), job.of_photographs.begin(), job.of_photographs.end());
  result.of_photographs_alone = job.of_photographs;
  result.measured = std::make_shared<measure::Measurement>(std::move(of_marks));
}

}  // namespace

MeasuringResult measured(const MeasuringJob& job, const Progress& progress) {
  MeasuringResult result{.of_photographs = job.ofPhotographs()};
  std::array<std::optional<measure::Photograph>, 2> photos;
  const auto attempt = [&result](const auto& action) {
    try {
      action();
    } catch (const GivenUp&) {
      throw;
    } catch (const std::exception& error) {
      result.errors.emplace_back(error.what());
    }
  };
  for (std::size_t i = 0; i < photos.size(); ++i) {
    if (job.files[i].empty()) continue;
    report(progress, "reading", 0.0);
    attempt([&] {
      photos[i] = measure::readPhotograph(job.files[i]);
      result.photos[i] = {job.files[i], photos[i]->width_px, photos[i]->height_px, photos[i]->notes,
                          makePreview(*photos[i])};
    });
  }
  if (photos[0] && photos[1]) attempt([&] { measurePhotographs(photos, job, progress, result); });
  if (!job.ofPhotographs()) attempt([&] { measureMarks(job, progress, result); });
  if (result.measured) result.overlay = measure::buildOverlay(*result.measured);
  return result;
}

void MeasuringWork::request(MeasuringJob job) {
  if (!work_.busy()) return begin(std::move(job));
  if (job.ofPhotographs() || of_photographs_) give_up_ = true;
  next_ = std::move(job);
}

void MeasuringWork::cancel() {
  next_.reset();
  give_up_ = true;
}

void MeasuringWork::begin(MeasuringJob job) {
  give_up_ = false;
  of_photographs_ = job.ofPhotographs();
  note("", 0.0);
  work_.start([this, job = std::move(job)] {
    return measured(job, [this](std::string_view stage, double done) {
      if (give_up_) throw GivenUp();
      note(stage, done);
    });
  });
}

MeasuringWork::State MeasuringWork::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

void MeasuringWork::note(std::string_view stage, double done) {
  const std::lock_guard lock(mutex_);
  state_ = {std::string(stage), done};
}

std::optional<MeasuringResult> MeasuringWork::collectResult() {
  auto done = work_.collectResult();
  if (!done) return std::nullopt;
  const bool given_up = give_up_;
  if (next_) begin(*std::exchange(next_, std::nullopt));
  if (given_up || !done->value) return std::nullopt;
  return std::move(done->value);
}

}  // namespace palpate::viewer
