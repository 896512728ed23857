// Presses of an ultrasound probe on the limbs of living people, from a public table: the tissue under the probe and how
// stiff that is.
//
// Based on: Erdemir and Neumann, doi 10.18735/S5R97F, as the master list of the public repository
// sbdoherty/UltrasoundML has it. The list is not shipped. Its `Total_Stiff` is the slope of a line through pressure
// over the change of thickness from skin to bone, MPa/mm; the pressure is the force over 360 mm^2 (`MaxForce` over
// `maxForce_normArea`).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palpate::lab {

/// The probe's area that the pressures of the list are made with, mm^2.
inline constexpr double kProbeAreaMm2 = 360.0;

struct LivingTest {
  int person = 0;
  std::string site;       ///< upper or lower, arm or leg, anterior or posterior: "UA_P"
  double cover_mm = 0.0;  ///< skin to bone, before the press
  double skin_mm = 0.0;
  double fat_mm = 0.0;
  double n_per_mm = 0.0;
};

struct LivingTests {
  std::vector<LivingTest> tests;
  int left_out = 0;  ///< rows whose thickness or stiffness is empty: the people's own exclusions
};

/// Name of the list; readLivingTests accepts it or its folder.
inline constexpr const char* kLivingList = "001_MasterList_indentation_orig.csv";

/// Throws Error naming file and line for a table that is something else, too large, or has numbers no limb has.
LivingTests readLivingTests(const std::filesystem::path& list_or_folder);

}  // namespace palpate::lab
