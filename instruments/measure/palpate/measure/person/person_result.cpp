// A complete walk -> mean ellipses, stiffness -> person.csv and a scene; and the first files of a new folder.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"
#include "palpate/base/text.h"
#include "palpate/measure/key_row.h"
#include "palpate/measure/person/person_folder.h"
#include "palpate/measure/press_table.h"
#include "palpate/measure/stencil.h"

namespace palpate::measure {

namespace {

namespace fs = std::filesystem;

/// Accepted presses as rows; where the fit does not find the pull's direction, the planned one is used.
std::vector<PressRow> countingRows(const PersonWalk& walk) {
  std::string table = keyRowHeader();
  for (const WalkedPress& press : walk.presses) {
    if (press.counts()) table += press.outcome->row + "\n";
  }
  return parsePresses(table, (walk.folder / kMeasuredFile).string());
}

std::optional<PlaceFits> loadStiffness(const fs::path& file, const Progress& progress) {
  if (!fs::exists(file)) return std::nullopt;
  PlaceFits fits = fitPlaces(readPlaceCurves(file), {}, progress);
  for (const PlaceStiffness& place : fits.places) {
    if (place.refused()) throw Error::inFile(file.string(), place.place + ": " + place.refusal);
  }
  return fits;
}

/// Points get the stiffness of the place of their name; other places are rows of their own.
std::string personTable(const Averages& averages, const std::optional<PlaceFits>& stiffness) {
  Averages with = averages;
  std::string alone;
  for (const PlaceStiffness& place : stiffness ? stiffness->places : std::vector<PlaceStiffness>()) {
    const auto point = std::ranges::find(with.points, place.place, &PointMean::name);
    const double n_per_mm = place.secant_n_per_mm.value;
    if (point != with.points.end()) {
      point->stiffness_n_per_mm = n_per_mm;
    } else if (place.at_mm) {
      alone += fmt::format("{},{:.10g},{:.10g},,,,{:.6g},,,,,,\n", place.place, place.at_mm->x(), place.at_mm->y(),
                           n_per_mm);
    } else {
      throw Error(fmt::format("{}: {} has no position; give x_mm and y_mm in its rows", kForcesFile, place.place));
    }
  }
  return keyPointTable(with) + alone;
}

/// The circle where no point reaches: the geometric mean of the person's axes, as 150 mm is of the dissertation's.
double basicRadius(const Averages& averages) {
  double sum = 0.0;
  for (const PointMean& point : averages.points) sum += maps::logTensor(point.mean.ellipse).x();
  return std::exp(sum / static_cast<double>(averages.points.size()));
}

std::string sceneText(const PersonWalk& walk, const Averages& averages, const std::optional<PlaceFits>& stiffness) {
  const Protocol& protocol = walk.protocol;
  std::string text = fmt::format("# Made by palpate measure session from {} and {}.\ntitle = \"{}\"\n\n[body]\n",
                                 kProtocolFile, kMeasuredFile, protocol.person);
  text += "kind = \"trunk\"\n";
  if (protocol.stature_mm > 0.0) text += fmt::format("stature_mm = {:g}\n", protocol.stature_mm);
  if (protocol.body_mass_index > 0.0) text += fmt::format("body_mass_index = {:g}\n", protocol.body_mass_index);
  text += fmt::format(
      "\n[ellipses]\nkey_points = \"{}\"\nbasic_radius_mm = {:.1f}  # the mean\n\n[deformation]\nboundary = \"two_mm\" "
      " # what was measured\n",
      kPersonFile, basicRadius(averages));
  if (stiffness) {
    text += "\n[stiffness]\nsource = \"points\"\n";
    text += "\n[tissue]\n" + tissueKeys(*stiffness);
  }
  const ProtocolPoint& point = protocol.points.front();
  return text + fmt::format(
                    "\n[[finger]]\nname = \"index\"\nradius_mm = 8\nat_mm = [{:.6g}, {:.6g}]\n"
                    "script = [\n  {{ do = \"press\", depth_mm = 8, seconds = 0.5 }},\n"
                    "  {{ do = \"drag\", by_mm = [0, 30], seconds = 1 }},\n"
                    "  {{ do = \"hold\", seconds = 0.5 }},\n  {{ do = \"lift\", seconds = 0.5 }},\n]\n",
                    point.place_mm.x(), point.place_mm.y());
}

std::string checklist(const Protocol& protocol) {
  std::string text = fmt::format(
      "# Pictures of {}\n\n"
      "Dots by the stencil, contact marked in another colour. Camera upright over the back, 1.2 to 1.5 m away, focus\n"
      "and exposure locked, the whole grid in the frame. For every press, within one held breath: before, before2,\n"
      "press and pull 15 to 25 mm, after; then let go: released. Names as below, .jpg, .png or .tif.\n"
      "Forces by depth, where they are measured, go into {} (place,x_mm,y_mm,press,depth_mm,force_n).\n\n",
      protocol.person, kForcesFile);
  for (const PlannedPress& press : plannedPresses(protocol)) {
    text += fmt::format("- [ ] {0}_before, {0}_before2, {0}_after, {0}_released\n", press.name);
  }
  return text;
}

}  // namespace

PersonResult writePerson(const PersonWalk& walk, const Progress& progress) {
  if (!walk.complete()) throw Error::inFile(walk.folder.string(), "is not complete; measure the missing presses first");
  PersonResult result{.averages = averagePresses(countingRows(walk))};
  result.stiffness = loadStiffness(walk.folder / kForcesFile, progress);
  const std::string table = personTable(result.averages, result.stiffness);
  const auto write = [&](const char* name, const std::string& text) {
    writeFile(walk.folder / name, text);
    result.written.push_back((walk.folder / name).string());
  };
  write(kPersonFile, table);
  write(kSceneFile, sceneText(walk, result.averages, result.stiffness));
  return result;
}

std::vector<std::string> beginPerson(const fs::path& folder, const Protocol& protocol) {
  if (fs::exists(folder / kProtocolFile)) {
    throw Error::inFile((folder / kProtocolFile).string(), "exists already and is not replaced; choose another folder");
  }
  makePrivateFolder(folder);
  std::vector<std::string> written;
  const auto write = [&](const std::string& name, const std::string& text) {
    writeFile(folder / name, text);
    written.push_back((folder / name).string());
  };
  parseProtocol(protocolText(protocol), kProtocolFile);  // checks that the text can be read again
  for (const StencilSheet& sheet :
       stencilSheets({.spacing_mm = protocol.spacing_mm, .hole_mm = std::min(8.0, 0.3 * protocol.spacing_mm)})) {
    write(sheet.name.empty() ? "stencil.svg" : "stencil-" + sheet.name + ".svg", sheet.svg);
  }
  write("checklist.md", checklist(protocol));
  write(kProtocolFile, protocolText(protocol));
  return written;
}

}  // namespace palpate::measure
