// The response of one stack of layers over bone to a fingertip: the shape of its skin and the force, by depth.
//
// Made by the finite element solver (room `elements`) or fitted to measured curves; what the body blends at run time
// (layered_library.h). Depths are those of the rigid sphere's lowest point under the undeformed skin.
// Based on: dissertation, future work 1 and 2; the forms are compared in docs/explanation/tissue.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/tissue/press_field.h"

namespace palpate::tissue {

/// One sheet of a stack, nearly incompressible neo-Hookean.
struct Layer {
  std::string name;           ///< "skin", "fat", "muscle", or empty
  double thickness_mm = 0.0;  ///< > 0
  double young_kpa = 0.0;     ///< Young's modulus at rest, > 0
};

/// Flat bonded layers, from the skin down to a rigid base (bone).
struct LayerStack {
  std::vector<Layer> layers;  ///< empty: unknown, in a table fitted to measured curves
  double poisson = 0.48;      ///< in [0, 0.5)
};

/// mm, of all layers.
double totalThickness(const LayerStack& stack);

/// Throws Error naming the layer (counted from 1) and the number that makes no sense: thickness 0.1 to 500 mm, Young's
/// modulus 0.01 to 1e6 kPa, 1 to 16 layers, Poisson's ratio 0 to 0.499.
void check(const LayerStack& stack);

/// The skin under a press of one depth. Normalised by `surface_mm`, like the golden tables.
struct PressedShape {
  double depth_mm = 0.0;           ///< of the sphere's lowest point
  double surface_mm = 0.0;         ///< u0: what the skin on the axis has gone down by
  double force_n = 0.0;            ///< normal force on the whole sphere
  double contact_radius_mm = 0.0;  ///< of the skin that touches, at rest
  std::vector<double> down;        ///< u_z / u0 at the table's radii, into the body; 1 on the axis
  std::vector<double> outward;     ///< u_r / u0, away from the axis; 0 on the axis
};

/// The skin under a small drag, linear: share of the drag (1 + q^2)^-p, q^2 = (x/along)^2 + (y/across)^2 with x along
/// the drag.
struct DragShape {
  double exponent = 0.83;
  double along_mm = 16.0;
  double across_mm = 9.2;
  double tangential_over_normal = 0.7;  ///< k_t / k_n of a bonded patch, both from the same linear solve
  // The solution itself, if known: the share of the drag at the table's radii along the two axes. As long as the radii,
  // or empty.
  std::vector<double> on_along;
  std::vector<double> on_across;
};

/// The same stack under a sphere of another radius: only the force.
struct FingerForces {
  double radius_mm = 0.0;
  std::vector<double> depths_mm;  ///< increasing, > 0
  std::vector<double> force_n;    ///< one per depth, > 0, not falling
};

struct LayeredTable {
  LayerStack stack;
  double indenter_radius_mm = 8.0;
  std::vector<double> radii_mm;      ///< from 0, increasing: where the shapes are told, at rest
  std::vector<PressedShape> shapes;  ///< depths increasing, > 0
  std::optional<DragShape> drag;     ///< where it was solved
  /// For radii other than the indenter's, increasing; empty: forces change with the radius as in the shipped stacks
  /// (nodeOf in layered_tissue.h).
  std::vector<FingerForces> fingers = {};
  std::optional<PressField> field = {};  ///< where it was solved; lumps need it
};

/// Throws Error naming what makes no sense: radii or depths that do not increase, shapes of other sizes, forces that
/// fall with the depth, numbers that are not finite.
void check(const LayeredTable& table);

/// Writes and reads JSON (docs/reference/tissue-tables.md has the form). Reading throws Error naming the file and the
/// key; files of at most 64 MB.
void writeLayeredTable(const std::filesystem::path& file, const LayeredTable& table);
LayeredTable readLayeredTable(const std::filesystem::path& file);
/// `name` stands for the file in messages.
LayeredTable parseLayeredTable(std::string_view json, std::string_view name);
std::string layeredTableText(const LayeredTable& table);

/// "skin:2mm:150kPa" -> Layer. Units mm and kPa (or MPa, cm) are asked for or may be left out; throws Error saying the
/// form.
Layer parseLayer(std::string_view text);

/// "10mm", "1 cm", "10"; "60kPa", "0.06 MPa", "60": nothing for anything else.
std::optional<double> parseMillimetres(std::string_view text);
std::optional<double> parseKilopascals(std::string_view text);

}  // namespace palpate::tissue
