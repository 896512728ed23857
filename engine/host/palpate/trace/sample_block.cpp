// zlib at its fastest level: a block of 200 ticks takes some 0.1 ms, on the writer's thread.
#include "palpate/trace/sample_block.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>

#include "palpate/base/error.h"

namespace palpate::trace {

namespace {

using contact::FingerOutput;

template <auto Member, int Axis>
constexpr SampleColumn feltAxis(std::string_view name, std::string_view unit, std::string_view meaning) {
  return {name,
          "f64",
          unit,
          meaning,
          [](const Sample& s) { return std::bit_cast<std::uint64_t>((s.contact.*Member)[Axis]); },
          [](Sample& s, std::uint64_t bits) { (s.contact.*Member)[Axis] = std::bit_cast<double>(bits); }};
}

template <int Axis>
constexpr SampleColumn deviceAxis(std::string_view name) {
  return {name,
          "f64",
          "N",
          "what the device was sent",
          [](const Sample& s) { return std::bit_cast<std::uint64_t>(s.device_force[Axis]); },
          [](Sample& s, std::uint64_t bits) { s.device_force[Axis] = std::bit_cast<double>(bits); }};
}

template <int Axis>
constexpr SampleColumn dentAxis(std::string_view name, std::string_view meaning) {
  return {name,
          "f64",
          "mm",
          meaning,
          [](const Sample& s) { return std::bit_cast<std::uint64_t>(s.contact.dent.place[Axis]); },
          [](Sample& s, std::uint64_t bits) { s.contact.dent.place[Axis] = std::bit_cast<double>(bits); }};
}

template <auto Member>
constexpr SampleColumn felt(std::string_view name, std::string_view meaning) {
  return {name,
          "u32",
          "",
          meaning,
          [](const Sample& s) { return static_cast<std::uint64_t>(s.contact.*Member); },
          [](Sample& s, std::uint64_t bits) { s.contact.*Member = static_cast<std::uint32_t>(bits); }};
}

constexpr std::array kColumns = {
    SampleColumn{"tick", "u64", "", "of the servo loop", [](const Sample& s) { return s.tick; },
                 [](Sample& s, std::uint64_t bits) { s.tick = bits; }},
    feltAxis<&FingerOutput::tip, 0>("tip_x_mm", "mm", "where the device held the finger"),
    feltAxis<&FingerOutput::tip, 1>("tip_y_mm", "mm", ""),
    feltAxis<&FingerOutput::tip, 2>("tip_z_mm", "mm", ""),
    feltAxis<&FingerOutput::proxy, 0>("proxy_x_mm", "mm", "where the skin holds it; the tip when free"),
    feltAxis<&FingerOutput::proxy, 1>("proxy_y_mm", "mm", ""),
    feltAxis<&FingerOutput::proxy, 2>("proxy_z_mm", "mm", ""),
    feltAxis<&FingerOutput::anchor, 0>("anchor_x_mm", "mm", "what of the skin friction holds; the tip when free"),
    feltAxis<&FingerOutput::anchor, 1>("anchor_y_mm", "mm", ""),
    feltAxis<&FingerOutput::anchor, 2>("anchor_z_mm", "mm", ""),
    feltAxis<&FingerOutput::hold, 0>("hold_x_mm", "mm", "where the pull of friction ends; the tip when free"),
    feltAxis<&FingerOutput::hold, 1>("hold_y_mm", "mm", ""),
    feltAxis<&FingerOutput::hold, 2>("hold_z_mm", "mm", ""),
    feltAxis<&FingerOutput::normal, 0>("normal_x", "", "out of the skin; zero when free"),
    feltAxis<&FingerOutput::normal, 1>("normal_y", "", ""),
    feltAxis<&FingerOutput::normal, 2>("normal_z", "", ""),
    feltAxis<&FingerOutput::force, 0>("force_x_n", "N", "of the contact, on the tip"),
    feltAxis<&FingerOutput::force, 1>("force_y_n", "N", ""),
    feltAxis<&FingerOutput::force, 2>("force_z_n", "N", ""),
    SampleColumn{"depth_mm", "f64", "mm", "of the tip under the skin",
                 [](const Sample& s) { return std::bit_cast<std::uint64_t>(s.contact.depth_mm); },
                 [](Sample& s, std::uint64_t bits) { s.contact.depth_mm = std::bit_cast<double>(bits); }},
    deviceAxis<0>("device_x_n"),
    deviceAxis<1>("device_y_n"),
    deviceAxis<2>("device_z_n"),
    SampleColumn{"touch", "u32", "", "0 free, 1 stick, 2 slip",
                 [](const Sample& s) { return static_cast<std::uint64_t>(s.contact.touch); },
                 [](Sample& s, std::uint64_t bits) { s.contact.touch = static_cast<contact::Touch>(bits); }},
    felt<&FingerOutput::triangle>("triangle", "under the proxy; 4294967295: none"),
    felt<&FingerOutput::anchor_triangle>("anchor_triangle", "under the anchor; 4294967295: none"),
    felt<&FingerOutput::status>("contact_status", "bits, see docs/explanation/contact.md"),
    SampleColumn{"safety_status", "u32", "", "bits, see docs/explanation/servo.md",
                 [](const Sample& s) { return static_cast<std::uint64_t>(s.safety); },
                 [](Sample& s, std::uint64_t bits) { s.safety = static_cast<std::uint32_t>(bits); }},
    SampleColumn{"world", "u32", "", "of the table worlds", [](const Sample& s) { return std::uint64_t{s.world}; },
                 [](Sample& s, std::uint64_t bits) { s.world = static_cast<std::uint32_t>(bits); }},
    SampleColumn{"forgot", "u32", "", "bits: 1 what it touched, 2 what the limiter knew was forgotten before this tick",
                 [](const Sample& s) { return std::uint64_t{s.forgot}; },
                 [](Sample& s, std::uint64_t bits) { s.forgot = static_cast<std::uint32_t>(bits); }},
    SampleColumn{"loss_n_mm", "f64", "N mm", "given by the loop beyond the skin's law and not taken back yet",
                 [](const Sample& s) { return std::bit_cast<std::uint64_t>(s.loss_n_mm); },
                 [](Sample& s, std::uint64_t bits) { s.loss_n_mm = std::bit_cast<double>(bits); }},
    SampleColumn{"buttons", "u32", "", "bits: those of the device that are down, 1 the first",
                 [](const Sample& s) { return std::uint64_t{s.buttons}; },
                 [](Sample& s, std::uint64_t bits) { s.buttons = static_cast<std::uint32_t>(bits); }},
    SampleColumn{"rest_mm", "f64", "mm", "effective depth at which the skin under the finger would stay by itself",
                 [](const Sample& s) { return std::bit_cast<std::uint64_t>(s.contact.rest_mm); },
                 [](Sample& s, std::uint64_t bits) { s.contact.rest_mm = std::bit_cast<double>(bits); }},
    SampleColumn{"dent_mm", "f64", "mm", "effective depth of the dent that the finger left; 0: none",
                 [](const Sample& s) { return std::bit_cast<std::uint64_t>(s.contact.dent.rest_mm); },
                 [](Sample& s, std::uint64_t bits) { s.contact.dent.rest_mm = std::bit_cast<double>(bits); }},
    dentAxis<0>("dent_x_mm", "where that dent is"),
    dentAxis<1>("dent_y_mm", ""),
    dentAxis<2>("dent_z_mm", ""),
    SampleColumn{"dent_triangle", "u32", "", "under that dent; 4294967295: none",
                 [](const Sample& s) { return std::uint64_t{s.contact.dent.triangle}; },
                 [](Sample& s, std::uint64_t bits) { s.contact.dent.triangle = static_cast<Index>(bits); }},
    felt<&FingerOutput::lump>("lump", "the mobile lump nearest to the finger, by its number; 4294967295: none"),
    feltAxis<&FingerOutput::lump_moved_mm, 0>("lump_across_mm", "mm", "how far that one is from its place"),
    feltAxis<&FingerOutput::lump_moved_mm, 1>("lump_up_mm", "mm", ""),
    feltAxis<&FingerOutput::lump_force, 0>("lump_force_x_n", "N", "of the contact's force, what lumps add"),
    feltAxis<&FingerOutput::lump_force, 1>("lump_force_y_n", "N", ""),
    feltAxis<&FingerOutput::lump_force, 2>("lump_force_z_n", "N", ""),
    SampleColumn{"lump_share", "f64", "", "their normal force over that of the press without them",
                 [](const Sample& s) { return std::bit_cast<std::uint64_t>(s.contact.lump_share); },
                 [](Sample& s, std::uint64_t bits) { s.contact.lump_share = std::bit_cast<double>(bits); }},
};

std::size_t rowBytes(std::span<const SampleColumn> columns) {
  std::size_t bytes = 0;
  for (const SampleColumn& column : columns) bytes += column.width();
  return bytes;
}

std::uint32_t computeChecksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

void writeColumn(const SampleColumn& column, std::span<const Sample> samples, char* plane) {
  const std::size_t width = column.width();
  std::uint64_t before = 0;
  for (std::size_t row = 0; row < samples.size(); ++row) {
    const std::uint64_t bits = column.bits(samples[row]);
    for (std::size_t byte = 0; byte < width; ++byte) {
      plane[byte * samples.size() + row] = static_cast<char>(((bits ^ before) >> (8 * byte)) & 0xffu);
    }
    before = bits;
  }
}

void readColumn(const SampleColumn& column, const char* plane, std::span<Sample> samples) {
  const std::size_t width = column.width();
  std::uint64_t bits = 0;
  for (std::size_t row = 0; row < samples.size(); ++row) {
    for (std::size_t byte = 0; byte < width; ++byte) {
      bits ^= std::uint64_t{static_cast<unsigned char>(plane[byte * samples.size() + row])} << (8 * byte);
    }
    column.set(samples[row], bits);
  }
}

std::string inflated(std::string_view bytes, std::size_t size) {
  std::string raw(size, '\0');
  uLongf length = size;
  const int result = ::uncompress(reinterpret_cast<Bytef*>(raw.data()), &length,
                                  reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  if (result != Z_OK || length != size) throw Error("the block does not decompress to its number of rows");
  return raw;
}

}  // namespace

std::span<const SampleColumn> sampleColumns() { return kColumns; }

SampleBlock packSamples(std::span<const Sample> samples) {
  if (samples.empty() || samples.size() > kMaxBlockRows) {
    throw Error(fmt::format("block of {} samples; expected 1 to {}", samples.size(), kMaxBlockRows));
  }
  std::string raw(rowBytes(kColumns) * samples.size(), '\0');
  char* plane = raw.data();
  for (const SampleColumn& column : kColumns) {
    writeColumn(column, samples, plane);
    plane += column.width() * samples.size();
  }
  SampleBlock block;
  uLongf length = ::compressBound(raw.size());
  block.bytes.resize(length);
  if (::compress2(reinterpret_cast<Bytef*>(block.bytes.data()), &length, reinterpret_cast<const Bytef*>(raw.data()),
                  raw.size(), Z_BEST_SPEED) != Z_OK) {
    throw Error("not enough memory to compress a block");
  }
  block.bytes.resize(length);
  block.crc32 = computeChecksum(block.bytes);
  return block;
}

SampleColumn columnOf(std::string_view name, std::string_view type) {
  constexpr std::array<std::string_view, 3> kTypes = {"f64", "u64", "u32"};
  const auto* const found = std::find(kTypes.begin(), kTypes.end(), type);
  if (found == kTypes.end()) throw Error(fmt::format("column {}: '{}' is not a number type", name, type));
  for (const SampleColumn& column : kColumns) {
    if (column.name != name) continue;
    if (column.type != type) throw Error(fmt::format("column {} has type {}; expected {}", name, type, column.type));
    return column;
  }
  return {{}, *found, {}, {}, {}, [](Sample&, std::uint64_t) {}};
}

std::vector<Sample> unpackSamples(std::string_view bytes, std::uint32_t crc32, std::size_t rows, std::uint32_t finger,
                                  std::span<const SampleColumn> columns) {
  if (rows == 0 || rows > kMaxBlockRows) throw Error(fmt::format("invalid block: {} rows", rows));
  if (computeChecksum(bytes) != crc32) throw Error("block checksum mismatch");
  const std::string raw = inflated(bytes, rowBytes(columns) * rows);
  std::vector<Sample> samples(rows);
  const char* plane = raw.data();
  for (const SampleColumn& column : columns) {
    readColumn(column, plane, samples);
    plane += column.width() * rows;
  }
  for (Sample& sample : samples) {
    if (sample.contact.touch > contact::Touch::slip) throw Error("a block contains an invalid contact state");
    sample.finger = finger;
  }
  return samples;
}

}  // namespace palpate::trace
