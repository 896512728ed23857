// Sessions for Python: what is in a file, its ticks as arrays by column, and whether it can be felt again.
//
//   FILE.session ─► trace::RecordingReader ─┬─► dicts of arrays, a block at a time
//                                         └─► engine::replay ─► ReplayReport
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>

#include "arrays.h"
#include "bindings.h"
#include "busy.h"
#include "dicts.h"
#include "interrupts.h"
#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/engine/recording_replay.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_repair.h"
#include "palpate/trace/sample_block.h"
#include "world_handle.h"

namespace palpate::python {

namespace {

using trace::SampleColumn;
using trace::TickSpan;

constexpr const char* kInUse = "this Session";

/// A file that is read; closed by Python.
class RecordingFile {
 public:
  explicit RecordingFile(const std::filesystem::path& file) : file_(file) {
    unlocked([&](Interrupts& interrupts) {
      const trace::ReadingWatch watch([&] { interrupts.check(); });
      reader_.emplace(file);
    });
  }

  trace::RecordingReader& reader() {
    if (!reader_) throw py::value_error("the session is closed");
    return *reader_;
  }
  const trace::RecordingFacts& facts() { return reader().facts(); }
  void close() { reader_.reset(); }
  const std::filesystem::path& file() const { return file_; }

  Busy busy;

 private:
  std::filesystem::path file_;
  std::optional<trace::RecordingReader> reader_;
};

// --- what is wanted -------------------------------------------------------------------------------------------------

/// Three columns that belong together have a name of their own.
struct VectorField {
  const char* name;
  const char* before;  ///< text before the axis
  const char* after;
};
constexpr std::array kVectors = {VectorField{"tip", "tip_", "_mm"},
                                 VectorField{"proxy", "proxy_", "_mm"},
                                 VectorField{"anchor", "anchor_", "_mm"},
                                 VectorField{"hold", "hold_", "_mm"},
                                 VectorField{"normal", "normal_", ""},
                                 VectorField{"force", "force_", "_n"},
                                 VectorField{"device_force", "device_", "_n"},
                                 VectorField{"dent", "dent_", "_mm"},
                                 VectorField{"lump_force", "lump_force_", "_n"}};

/// A field of a table: one column, or three.
struct Field {
  std::string name;
  std::vector<const SampleColumn*> columns;
};

const SampleColumn* columnNamed(const std::string& name) {
  const auto columns = trace::sampleColumns();
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

Field fieldNamed(const std::string& name) {
  if (const SampleColumn* column = columnNamed(name)) return {name, {column}};
  std::vector<std::string> known;
  for (const VectorField& vector : kVectors) {
    known.emplace_back(vector.name);
    if (name != vector.name) continue;
    Field field{name, {}};
    for (const char axis : {'x', 'y', 'z'}) {
      field.columns.push_back(columnNamed(std::string(vector.before) + axis + vector.after));
    }
    return field;
  }
  for (const SampleColumn& column : trace::sampleColumns()) known.emplace_back(column.name);
  throw Error(unknownName("field", name, "", known));
}

std::vector<Field> fieldsNamed(const std::optional<std::vector<std::string>>& names) {
  std::vector<Field> fields;
  if (names) {
    for (const std::string& name : *names) fields.push_back(fieldNamed(name));
    if (fields.empty()) throw py::value_error("fields: must not be empty; None means all columns");
  } else {
    for (const SampleColumn& column : trace::sampleColumns()) fields.push_back({std::string(column.name), {&column}});
  }
  return fields;
}

std::uint32_t findFinger(RecordingFile& session, const py::object& finger) {
  const auto& fingers = session.facts().fingers;
  if (py::isinstance<py::str>(finger)) {
    const auto wanted = finger.cast<std::string>();
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < fingers.size(); ++i) {
      if (fingers[i].name == wanted) return i;
      names.push_back(fingers[i].name);
    }
    throw Error::inFile(session.file().string(), unknownName("finger", wanted, "", names));
  }
  const auto number = finger.cast<std::int64_t>();
  if (number < 0 || number >= static_cast<std::int64_t>(fingers.size())) {
    throw py::index_error(fmt::format("finger {}: the session has only {}", number, fingers.size()));
  }
  return static_cast<std::uint32_t>(number);
}

using SpanLike = std::optional<std::pair<std::uint64_t, std::uint64_t>>;

TickSpan asTickSpan(const SpanLike& given) {
  if (!given) return {};
  if (given->first > given->second) throw py::value_error("span: the first tick must not be after the last");
  return {given->first, given->second};
}

// --- tables ---------------------------------------------------------------------------------------------------------

struct Wanted {
  std::vector<Field> fields;
  std::uint32_t finger = 0;
  TickSpan span;
};

/// The bits of each column of each field, row by row: read without the interpreter's lock.
std::vector<std::vector<std::uint64_t>> bitsOf(RecordingFile& session, const Wanted& wanted) {
  std::vector<std::vector<std::uint64_t>> bits(wanted.fields.size());
  trace::RecordingReader& reader = session.reader();
  const auto append = [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) {
      if (sample.finger != wanted.finger) continue;
      for (std::size_t i = 0; i < bits.size(); ++i) {
        for (const SampleColumn* column : wanted.fields[i].columns) bits[i].push_back(column->bits(sample));
      }
    }
  };
  unlocked([&](Interrupts& interrupts) {
    reader.forEachTick(wanted.span, [&](std::span<const trace::Sample> samples) {
      interrupts.check();
      append(samples);
      return true;
    });
  });
  return bits;
}

template <class Number>
py::array arrayOfBits(const std::vector<std::uint64_t>& bits, std::size_t columns) {
  const auto rows = static_cast<py::ssize_t>(bits.size() / columns);
  std::vector<py::ssize_t> shape = {rows};
  if (columns > 1) shape.push_back(static_cast<py::ssize_t>(columns));
  py::array_t<Number> array(shape);
  Number* out = array.mutable_data();
  for (const std::uint64_t value : bits) {
    if constexpr (std::is_same_v<Number, double>) {
      *out++ = std::bit_cast<double>(value);
    } else {
      *out++ = static_cast<Number>(value);
    }
  }
  return array;
}

Arrays tableOf(RecordingFile& session, const Wanted& wanted) {
  const Busy::Guard guard(session.busy, kInUse);
  const auto bits = bitsOf(session, wanted);
  Arrays table;
  for (std::size_t i = 0; i < wanted.fields.size(); ++i) {
    const Field& field = wanted.fields[i];
    const std::string_view type = field.columns.front()->type;
    const std::size_t columns = field.columns.size();
    if (type == "f64") table[py::str(field.name)] = arrayOfBits<double>(bits[i], columns);
    if (type == "u64") table[py::str(field.name)] = arrayOfBits<std::uint64_t>(bits[i], columns);
    if (type == "u32") table[py::str(field.name)] = arrayOfBits<std::uint32_t>(bits[i], columns);
  }
  return table;
}

/// Walks through a recording, a block of ticks at a time.
struct Blocks {
  std::shared_ptr<RecordingFile> session;
  Wanted wanted;  ///< its span is what is left
  std::uint64_t ticks;

  Arrays next() {
    while (wanted.span.from <= wanted.span.to) {
      Wanted part = wanted;
      part.span.to = std::min(wanted.span.to, wanted.span.from + ticks - 1);
      wanted.span.from = part.span.to + 1;
      Arrays table = tableOf(*session, part);
      if (py::len(table.begin()->second) > 0) return table;
    }
    throw py::stop_iteration();
  }
};

Blocks makeBlocks(const std::shared_ptr<RecordingFile>& session, std::int64_t ticks,
                  const std::optional<std::vector<std::string>>& fields, const py::object& finger,
                  const SpanLike& span) {
  if (ticks < 1) throw py::value_error("ticks: must be at least 1");
  Wanted wanted{fieldsNamed(fields), findFinger(*session, finger), asTickSpan(span)};
  const trace::RecordingFacts& facts = session->facts();
  wanted.span.from = std::max(wanted.span.from, facts.first_tick);
  wanted.span.to = std::min(wanted.span.to, facts.last_tick);
  if (facts.samples == 0) wanted.span = {1, 0};
  return {session, std::move(wanted), static_cast<std::uint64_t>(ticks)};
}

// --- text -----------------------------------------------------------------------------------------------------------

/// Text in a user's recording need not be UTF-8.
py::str textOf(const std::string& words) {
  return py::reinterpret_steal<py::str>(
      PyUnicode_DecodeUTF8(words.data(), static_cast<py::ssize_t>(words.size()), "replace"));
}

Facts headerFacts(RecordingFile& session) {
  const trace::RecordingFacts& facts = session.facts();
  const trace::RecordingHeader& header = facts.header;
  Facts all;
  all["started_utc"] = textOf(header.started_utc);
  all["ended_utc"] = textOf(facts.ended_utc);
  all["ended_by"] = textOf(facts.ended_by);
  all["software"] = textOf(header.software);
  all["machine"] = textOf(header.machine);
  all["ticks_per_s"] = header.ticks_per_s;
  all["notes"] = textOf(header.notes);
  all["tags"] = textOf(header.tags);
  all["version"] = facts.version;
  all["samples"] = facts.samples;
  all["dropped"] = facts.dropped;
  all["first_tick"] = facts.first_tick;
  all["last_tick"] = facts.last_tick;
  all["seconds"] = facts.seconds();
  return all;
}

FactsList fingersOf(RecordingFile& session) {
  FactsList all;
  for (const trace::RecordingFinger& finger : session.facts().fingers) {
    Facts one;
    one["name"] = textOf(finger.name);
    one["device"] = textOf(finger.device);
    one["capabilities"] = textOf(finger.capabilities);
    one["placed"] = textOf(finger.placed);
    all.append(one);
  }
  return all;
}

FactsList worldFacts(RecordingFile& session) {
  const Busy::Guard guard(session.busy, kInUse);
  const trace::RecordingFacts& facts = session.facts();
  FactsList all;
  for (std::uint64_t number = facts.first_world; number < facts.first_world + facts.worlds; ++number) {
    const trace::RecordingWorld world = session.reader().world(number);
    Facts one;
    one["number"] = number;
    one["scene"] = textOf(world.scene);
    one["folder"] = textOf(world.folder);
    one["body"] = textOf(world.body);
    one["triangles"] = world.triangles;
    one["hash"] = fmt::format("{:016x}", world.hash);
    all.append(one);
  }
  return all;
}

FactsList eventFacts(RecordingFile& session, const SpanLike& span) {
  const Busy::Guard guard(session.busy, kInUse);
  FactsList all;
  for (const trace::RecordingEvent& event : session.reader().events(asTickSpan(span))) {
    Facts one;
    one["tick"] = event.tick;
    one["finger"] = event.finger ? py::object(py::int_(*event.finger)) : py::object(py::none());
    one["kind"] = textOf(event.kind);
    one["text"] = textOf(event.text);
    all.append(one);
  }
  return all;
}

FactsList columnFacts(RecordingFile& /*session*/) {
  FactsList all;
  for (const SampleColumn& column : trace::sampleColumns()) {
    Facts one;
    one["name"] = std::string(column.name);
    one["type"] = std::string(column.type);
    one["unit"] = std::string(column.unit);
    one["meaning"] = std::string(column.meaning);
    all.append(one);
  }
  return all;
}

WorldPointer buildRecordedWorld(RecordingFile& session, std::uint64_t number, const std::filesystem::path& folder) {
  const Busy::Guard guard(session.busy, kInUse);
  const trace::RecordingWorld recorded = session.reader().world(number);
  return unlocked([&](Interrupts& interrupts) {
    return std::make_shared<WorldHandle>(WorldHandle{engine::builtWorld(recorded, folder, interrupts.progress())});
  });
}

engine::ReplayReport replayed(RecordingFile& session, const SpanLike& span, const std::filesystem::path& folder) {
  const Busy::Guard guard(session.busy, kInUse);
  trace::RecordingReader& reader = session.reader();
  const engine::ReplaySettings settings{asTickSpan(span), folder};
  return unlocked([&](Interrupts& interrupts) {
    const auto looks = [&](std::span<const trace::Sample>) { interrupts.check(); };
    return engine::replay(reader, settings, looks, interrupts.progress());
  });
}

void closeSession(RecordingFile& session) {
  const Busy::Guard guard(session.busy, kInUse);
  session.close();
}

trace::RecordingRepair repaired(const std::filesystem::path& file, const std::filesystem::path& target,
                                bool overwrite) {
  if (!overwrite && std::filesystem::exists(target)) {
    throw Error::inFile(target.string(), "already exists; replace it with overwrite=True");
  }
  return unlocked([&](Interrupts& interrupts) { return trace::repairRecording(file, target, interrupts.progress()); });
}

FactsList missingTickFacts(const trace::RecordingRepair& repair, const std::vector<trace::MissingTicks>& missing) {
  FactsList all;
  for (const trace::MissingTicks& ticks : missing) {
    Facts one;
    one["finger"] = textOf(repair.fingers.at(ticks.finger));
    one["first_tick"] = ticks.first;
    one["last_tick"] = ticks.last;
    one["samples"] = ticks.count;
    all.append(one);
  }
  return all;
}

py::list toTextList(const std::vector<std::string>& lines) {
  py::list all;
  for (const std::string& line : lines) all.append(textOf(line));
  return all;
}

void bindRepair(py::module_& module) {
  using trace::RecordingRepair;
  py::class_<RecordingRepair>(module, "SessionRepair", "What was recovered from a damaged session, and what was lost.")
      .def_property_readonly("nothing_lost", &RecordingRepair::nothingLost,
                             "Whether everything recorded is in the new file.")
      .def_readonly("samples", &RecordingRepair::samples, "Number of recovered samples.")
      .def_readonly("blocks", &RecordingRepair::blocks, "Number of recovered blocks.")
      .def_readonly("events", &RecordingRepair::events, "Number of recovered events.")
      .def_readonly("worlds", &RecordingRepair::worlds, "Number of recovered worlds.")
      .def_readonly("attachments", &RecordingRepair::attachments, "Number of recovered attachments.")
      .def_property_readonly("samples_lost", &RecordingRepair::samplesLost,
                             "Number of lost samples, as far as their times are known.")
      .def_readonly("blocks_lost", &RecordingRepair::blocks_lost,
                    "Number of blocks that are missing or have a wrong checksum.")
      .def_readonly("bytes_missing", &RecordingRepair::bytes_missing, "Number of bytes missing at the end of the file.")
      .def_readonly("header_lost", &RecordingRepair::header_lost,
                    "Whether the header is lost: start time, rate, notes.")
      .def_property_readonly(
          "lost", [](const RecordingRepair& r) { return missingTickFacts(r, r.lost); },
          "Lost spans, one dict each: finger, first_tick, last_tick (inclusive), samples.")
      .def_property_readonly(
          "gaps", [](const RecordingRepair& r) { return missingTickFacts(r, r.gaps); },
          "Spans that were never recorded, in the form of `lost`.")
      .def_property_readonly(
          "other_lost", [](const RecordingRepair& r) { return toTextList(r.other); },
          "Lost worlds, names and attachments, one line each.")
      .def_property_readonly(
          "notes", [](const RecordingRepair& r) { return toTextList(r.notes); }, "Other observations.")
      .def("__repr__", [](const RecordingRepair& r) {
        return fmt::format("SessionRepair({} samples, {})", r.samples,
                           r.nothingLost() ? "nothing lost" : "with losses");
      });
  module.def("repair", repaired, py::arg("file"), py::arg("target"), py::kw_only(), py::arg("overwrite") = false,
             "Writes the readable parts of a damaged session into `target`; `file` is only read. A sample comes\nout "
             "with every bit, or not at all. Releases the GIL. Raises Error if nothing can be recovered, for\na target "
             "that already exists, and for the same file twice.");
}

void bindReplay(py::module_& module) {
  using engine::ReplayDifference;
  using engine::ReplayReport;
  py::class_<ReplayDifference>(module, "ReplayDifference", "First place where a replay differs from the recording.")
      .def_readonly("tick", &ReplayDifference::tick, "Tick of the servo loop.")
      .def_readonly("finger", &ReplayDifference::finger, "Name of the finger.")
      .def_readonly("field", &ReplayDifference::field, "Name of the column.")
      .def_readonly("recorded", &ReplayDifference::recorded, "Value in the file, as text.")
      .def_readonly("replayed", &ReplayDifference::replayed, "Value of the replay, as text.")
      .def("__repr__", [](const ReplayDifference& d) {
        return fmt::format("ReplayDifference(tick {}, {}, {}: {} -> {})", d.tick, d.finger, d.field, d.recorded,
                           d.replayed);
      });
  py::class_<ReplayReport>(module, "ReplayReport", "Result of replaying a session.")
      .def_property_readonly("identical", &ReplayReport::identical, "Whether every compared bit is the same.")
      .def_readonly("ticks", &ReplayReport::ticks, "Number of compared samples.")
      .def_readonly("different", &ReplayReport::different, "Number of samples that differ.")
      .def_readonly("unproven", &ReplayReport::unproven,
                    "Samples that could not be compared, because earlier ticks are missing from the session.")
      .def_readonly("first_difference", &ReplayReport::first_difference, "The first difference, or None.")
      .def_readonly("notes", &ReplayReport::notes, "Notes, e.g. a body that differs from the recorded one.")
      .def_readonly("gaps", &ReplayReport::gaps, "Spans with missing ticks, as text.")
      .def("__repr__", [](const ReplayReport& r) {
        return fmt::format("ReplayReport({}, {} samples, {} different)", r.identical() ? "identical" : "not identical",
                           r.ticks, r.different);
      });
}

}  // namespace

void bindSessions(py::module_& module) {
  bindReplay(module);
  bindRepair(module);
  py::class_<Blocks>(module, "SessionBlocks", "Iterator over a session, one dict of arrays at a time.")
      .def(
          "__iter__", [](Blocks& blocks) -> Blocks& { return blocks; }, "Returns itself.")
      .def("__next__", &Blocks::next, "Returns the next non-empty block.");
  py::class_<RecordingFile, std::shared_ptr<RecordingFile>>(
      module, "Session",
      "A recorded session, readable while it is being written. Not thread-safe: a concurrent call "
      "raises\nRuntimeError. Closes with `with`.")
      .def(py::init<const std::filesystem::path&>(), py::arg("file"),
           "Raises Error for a file that is not a session, is damaged, or is of a later version.")
      .def_property_readonly("header", headerFacts,
                             "dict: started_utc, ended_utc, ended_by, software, machine, ticks_per_s, notes, tags,\n"
                             "version, samples, dropped, first_tick, last_tick, seconds.")
      .def_property_readonly("fingers", fingersOf, "Fingers, one dict each: name, device, capabilities, placed.")
      .def_property_readonly("worlds", worldFacts,
                             "Worlds, one dict each: number, scene (its text), folder, body, triangles, hash.")
      .def_property_readonly("columns", columnFacts, "Columns of `samples`, one dict each: name, type, unit, meaning.")
      .def("events", eventFacts, py::arg("span") = py::none(),
           "Events, one dict each: tick, finger (None for all), kind, text. span: first and last tick, inclusive.")
      .def(
          "samples",
          [](RecordingFile& session, const std::optional<std::vector<std::string>>& fields, const py::object& finger,
             const SpanLike& span) {
            return tableOf(session, {fieldsNamed(fields), findFinger(session, finger), asTickSpan(span)});
          },
          py::arg("fields") = py::none(), py::arg("finger") = 0, py::arg("span") = py::none(),
          "Ticks of one finger (its number or name) as a dict of new arrays (N,) by column, or (N, 3) for tip,\nproxy, "
          "anchor, hold, normal, force, device_force, dent, lump_force. fields: None means every column. span: first "
          "and\nlast tick, both included. Releases the GIL. Raises Error for a field, a finger, a damaged block.")
      .def("blocks", makeBlocks, py::arg("ticks") = 10000, py::arg("fields") = py::none(), py::arg("finger") = 0,
           py::arg("span") = py::none(),
           "Iterates over `samples`, this many ticks at a time; uses memory for one block, however long the\nsession. "
           "Spans without samples are skipped.")
      .def("world", buildRecordedWorld, py::arg("number") = 0, py::arg("folder") = "",
           "Builds a recorded world. folder: current location of the files that its scene names. Raises Error.")
      .def("replay", replayed, py::arg("span") = py::none(), py::arg("folder") = "",
           "Replays the session and compares every bit of the span. Releases the GIL. Raises Error for a scene\nthat "
           "can no longer be built.")
      .def(
          "damaged_blocks",
          [](RecordingFile& session) {
            const Busy::Guard guard(session.busy, kInUse);
            return session.reader().damagedBlocks();
          },
          "Blocks that cannot be read: pairs of number and reason.")
      .def("close", closeSession, "Closes the file; later calls raise ValueError.")
      .def(
          "__enter__", [](std::shared_ptr<RecordingFile> session) { return session; }, "Returns itself.")
      .def(
          "__exit__", [](RecordingFile& session, const py::args& /*error*/) { closeSession(session); },
          "Calls close().")
      .def("__repr__", [](RecordingFile& session) { return "Session('" + session.file().string() + "')"; });
}

}  // namespace palpate::python
