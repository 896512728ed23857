// Rows are collected as text and written in blocks of 256 KiB.
// Data flow: samples of the servo -> here, between ticks or on a thread beside them -> forces.csv.
#include "palpate/trace/forces_csv.h"

#include <utility>

namespace palpate::trace {

namespace {

/// Bytes collected before a write: large enough to make system calls rare, small enough to lose little in a crash.
constexpr std::size_t kBlockBytes = std::size_t{1} << 18;

}  // namespace

ForcesCsvWriter::ForcesCsvWriter(const std::filesystem::path& file, ForcesCsvSettings settings,
                                 OutputFile::Unfinished unfinished, MoreColumns more)
    : settings_(std::move(settings)), more_(std::move(more)), file_(file, unfinished), block_(forcesCsvHeader()) {
  block_ += more_.header + '\n';
}

void ForcesCsvWriter::add(const Sample& sample) {
  appendForcesRow(block_, settings_, sample);
  if (more_.append) {
    block_.pop_back();  // the end of the line
    more_.append(sample, block_);
    block_ += '\n';
  }
  if (block_.size() > kBlockBytes) flush();
}

void ForcesCsvWriter::flush() {
  file_.write(block_);
  block_.clear();
}

void ForcesCsvWriter::commit() {
  flush();
  file_.commit();
}

}  // namespace palpate::trace
