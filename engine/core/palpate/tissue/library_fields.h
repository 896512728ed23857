// Fields of presses for the shipped stacks (layered_library.h): what lumps in a body are made of.
//
// Made by `palpate tissue library --solve --field`; decoded once, when first asked for.
#pragma once

#include <string_view>
#include <vector>

#include "palpate/tissue/lump_energy.h"

namespace palpate::tissue {

/// The layers of a place, as the library understands it: skin of 2 mm, fat as far as the muscle keeps its least
/// thickness, muscle.
LayerStack placeStack(double thickness_mm, double fat_mm);

/// The stacks around a place, up to four, with shares that add up to 1: blends are straight in the share of fat and in
/// the logarithm of the thickness, as those of LayeredTissue. Pointers stay valid for the whole program; any number of
/// threads.
std::vector<WeightedField> libraryFieldsAt(double thickness_mm, double fat_mm);

/// The layers of a place and the fields around it, from which lumps and patterns of pressure are computed.
struct LumpPlace {
  LayerStack stack;
  std::vector<WeightedField> fields;

  LumpEnergy energyOf(const LumpShape& lump) const { return LumpEnergy(lump, stack, fields); }
};

/// For a body with the shipped stacks.
LumpPlace libraryPlaceAt(double thickness_mm, double fat_mm);

/// For the layers of a table, which must outlive it. Throws Error, with advice, if the table has no field.
LumpPlace tablePlace(const LayeredTable& table, std::string_view name);

}  // namespace palpate::tissue
