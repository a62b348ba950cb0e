#pragma once
/// Where streets lie, before anything is laid on them: tidied lines, how they meet at junctions, and sections across.
/// s counts across a street from its middle to the right, seen along its points; z up.
#include <array>
#include <span>
#include <vector>

#include "scenegraph/import/street_graph.h"

namespace manzana {

/// What is laid for a kind of street; metres.
struct StreetLook {
  Material material = Material::asphalt;
  double height = 0.12;  ///< of the surface above the edge's height; differs by kind, so that crossing ribbons do not
                         ///< flicker
  double pavement = 0;   ///< width on either side; 0: none
  bool road = true;      ///< carriageway: has junctions and lane lines
};
StreetLook street_look(StreetClass kind);
inline constexpr double kPavementHeight = 0.08;

/// A cut across a street, through `center`. Mitred at bends; on the inner side offsets end where the neighbouring
/// section would be crossed.
struct Section {
  Vec2d center{0, 0};
  double height = 0;  ///< of the edge's line above ground
  double along = 0;   ///< metres from the edge's first point, in plan
  Vec2d right{1, 0};  ///< unit
  double stretch = 1, most_left = 1e9, most_right = 1e9;
  double grade = 0;
  Vec2d at(double s) const;
};

/// A fan that closes the wedge between two ribbons that meet at more than 180 degrees: from angle a0, radius r0, left
/// turning to a1 and r1 (half widths of the carriageways); `pavement` is added to the radii.
struct Wedge {
  Vec3d center{0, 0, 0};
  double a0 = 0, a1 = 0, r0 = 0, r1 = 0;
  double pavement = 0;
};

/// One end of an edge, or a sharp bend within it.
struct EdgeEnd {
  bool continued = false;    ///< mitred with the one other street here
  Vec2d beyond{0, 0};        ///< then: unit direction of travel on the other side
  double beyond_length = 0;  ///< and the length of its first segment
  double clear = 0;          ///< metres without lane lines
  double open = 0;           ///< metres without parapets, for other streets to get out
};

struct StreetLine {
  std::vector<Vec3d> points;  ///< tidied
  double half_width = 3;      ///< of the carriageway
  std::array<EdgeEnd, 2> ends;
  std::vector<Wedge> wedges;  ///< to be laid with this edge; every wedge of a junction belongs to one edge
  bool laid = true;           ///< false: a closed area, or not usable
};

/// A row an edge.
std::vector<StreetLine> street_lines(const StreetGraph& graph, std::vector<Issue>& issues);

/// Sections at the points of a line and at the given distances (rising); cuts move to a point that is near. A run of
/// sections ends at a bend too sharp for a mitre; its wedge is added to the line.
using Run = std::vector<Section>;
std::vector<Run> street_runs(StreetLine& line, std::span<const double> cuts, double pavement);

double length_in_plan(std::span<const Vec3d> points);  ///< in plan

}  // namespace manzana
