// Load time; range and histogram are taken once, so that a panel need not.
#include "palpate/scene/skin_channels.h"

#include <algorithm>
#include <cmath>

namespace palpate::scene {

namespace {

SkinScalar toSkinScalar(mesh::VertexScalar channel) {
  SkinScalar scalar{.name = std::move(channel.name), .values = std::move(channel.values)};
  bool any = false;
  for (const float value : scalar.values) {
    if (!std::isfinite(value)) continue;
    scalar.least = any ? std::min<double>(scalar.least, value) : value;
    scalar.greatest = any ? std::max<double>(scalar.greatest, value) : value;
    any = true;
  }
  const double width = scalar.greatest - scalar.least;
  for (const float value : scalar.values) {
    if (!std::isfinite(value)) continue;
    const double share = width > 0.0 ? (value - scalar.least) / width : 0.0;
    ++scalar.histogram[std::min(SkinScalar::kBins - 1, static_cast<std::size_t>(share * SkinScalar::kBins))];
  }
  return scalar;
}

}  // namespace

std::shared_ptr<const SkinChannels> skinChannels(const mesh::VertexChannels& of_file,
                                                 std::vector<Index> source_vertex) {
  mesh::VertexChannels of_skin = mesh::followed(of_file, source_vertex);
  SkinChannels channels;
  for (mesh::VertexScalar& scalar : of_skin.scalars) channels.scalars.push_back(toSkinScalar(std::move(scalar)));
  channels.colours = std::move(of_skin.colours);
  channels.source_vertex = std::move(source_vertex);
  return std::make_shared<const SkinChannels>(std::move(channels));
}

const SkinScalar* scalarNamed(const SkinChannels* channels, std::string_view name) {
  if (channels == nullptr || channels->scalars.empty()) return nullptr;
  if (name.empty()) return &channels->scalars.front();
  const auto found = std::ranges::find(channels->scalars, name, &SkinScalar::name);
  return found == channels->scalars.end() ? nullptr : &*found;
}

std::string scalarNames(const SkinChannels* channels) {
  if (channels == nullptr || channels->scalars.empty()) return "none";
  std::string names;
  for (const SkinScalar& scalar : channels->scalars) names += (names.empty() ? "" : ", ") + scalar.name;
  return names;
}

}  // namespace palpate::scene
