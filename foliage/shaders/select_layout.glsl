// What selection reads and writes, as std430 lays it out; compiled as C++ too (foliage/select.h). Metres; a plant's own
// frame has its foot at the origin and z up.

// Of leeway: a word for each azimuth, whose bytes are of sight that is level, then ever steeper; from straight above
// there is none. Bytes are shares of the most.
const uint kLeewayAzimuths = 8u;
const float kLeewaySteepness = 4.0f, kMostLeeway = 2.0f;
const float kLeewayReach = 200.0f;  // metres, of neighbours; an eye that is nearer sees past some of them

// Where a copy of a plant stands.
struct TreeSite {
  vec3 position;     // of its foot, in its block's frame
  float radius;      // its size over the plant's natural one, across
  vec2 turn;         // cosine and sine of its yaw
  float height;      // and along its axis
  float inv_scale2;  // 1 / the larger of both, squared; times a jitter of its own, so that no ring sweeps over a meadow
  uint plant, block;
  uint hash;  // what is random about it; the lowest byte is its tint
  uint spare;
  uint leeway[kLeewayAzimuths];  // by how much more may be wrong, seen past its neighbours: foliage/neighbours.h
};

// How much is shown where so much may be wrong: a row of a plant's detail table.
struct Detail {
  float share;      // of a cell's leaf quads, if all of them could be seen
  float scale;      // linear size of those
  float fade;       // share of the shown ones that shrinks to nothing, the last in order
  float to_points;  // 0: leaf quads only, 1: points only
  float points;       // how many, when there are only points
  float point_level;  // of the finer of two levels that are mixed; its fraction: how far on the way to the next
  float point_gain;   // a point's area is multiplied by this and by the points of its level
  float lines;      // share of the lines that are shown, where branches have no mesh
  float bark;       // level of the branches' mesh; its fraction: how far on the way to the next
  float hidden;       // 1: of each cell only what can be seen of it from the eye; 0: all of it
  float line_level;  // 0: the finest lines
  float to_lines;    // share of the leaf quads that are lines, where leaves are thin
};

// Of a plant's table, over the square of an error in metres: four an octave, from 2^-32 m2 to 2^16 m2.
const uint kDetailSteps = 193u;
const uint kMostLevels = 8u, kMostPointLevels = 12u;

// A plant in the buffers of all plants.
struct PlantHead {
  uint first_quad, first_line, first_point, first_cell, first_step;
  uint cells, bark_levels, point_levels;
  uint branches, line_levels, first_line_row;  // where lines begin: branches + 2 steps a level, in x
  uint first_view, view_side;  // visibility: bytes, cell by cell; side 0: all is visible
  float near2, per_near2;      // of the crown's ball: radius squared, and 1 / (3 of that)
  float density;               // share of the ellipse of its height and width that it hides, seen from its sides
  uint spare0, spare1;
  float middle;                // height of the crown's middle
  float crown;                 // radius of the crown
  uvec4 bark[kMostLevels];     // first quad, first step, steps, 0
  uvec4 points[kMostPointLevels];   // first point, points, 0, 0
};

struct CellHead {
  vec3 centre;
  uint first, count;  // quads
  float radius;       // about the centre: of a ball that holds them
  float leaf;         // how far a corner is from what its quad is scaled about, at most
  float sway;         // by how much the wind may move it
};

// Of what is sparser, as grass and herbs are, no shadow would be seen.
const float kLeastShadow = 0.08f;  // PlantHead::density

// Sides of what is in view, relative to the eye: dot(xyz, p) + w >= 0 within. Plants have their own ends.
const uint kViewSides = 4u;

const uint kShareShift = 24u, kAllMosaics = 255u;

// A tree in view, placed: p -> dot(row, vec4(p, 1)), relative to the eye.
struct TreeRecord {
  vec4 row_x, row_y, row_z;
  uint site;  // its row; from kShareShift on: how much of it mosaics show instead, 255ths
  uint plant, hash;
  float error2_from_1m;  // what may be wrong of it a metre away: squared metres of its natural size
};

// What is drawn of one thing: `count` primitives from `first` on.
struct Item {
  uint record, kind, first, count;
  float edge;   // leaf quads, points: rank where nothing is left of them; lines: where the finer level's begin
  float fade;   // ranks over which they shrink
  float scale;  // of leaf quads their size, linear; of points their area
  uint second;  // of lines from rank `edge` on: in place of `first`
};
// A group is a handful of primitives of one item, so a list of groups is short where a list of primitives would not be.
const uint kQuadGroup = 4u, kLineGroup = 4u, kPointGroup = 16u;
const float kLeafFade = 0.3f;   // share of a cell's shown leaves that shrinks to nothing
const float kPointFade = 0.3f;  // share of a level's points over which its last ones shrink
const uint kBark = 0u, kLeaves = 1u, kLines = 2u, kPoints = 3u;

// Items of every tree: its bark, its lines, its points in two levels. Those of all trees come first, whether empty or
// not, then those of the cells of trees that show leaf quads.
const uint kFixedItems = 4u;
