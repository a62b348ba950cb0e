// From visible trees to what is drawn of them, in three dispatches without a read-back:
//   place    a tree in view -> its record and its fixed items; sums of the groups that these fill and of the cells that
//            trees show, so that each tree knows where its own stand
//   choose   a cell -> its item; sums of the groups that they fill
//   expand   an item -> its groups
// Draws read groups. What a list has no room for is left out, and counted: hosts should see to it that it never
// happens (foliage/budget.h).
const uint kScanBlock = 1024u;     // elements that one work group sums
const uint kSumThreads = 64u;     // by so many invocations
const uint kQuadsOfDraw = 65536u;  // of one command; the index buffer repeats

struct Capacity {
  uint cells, quad_groups, line_groups, point_groups;
  uint quad_draws, line_draws, spare0, spare1;  // commands that these might need
};

// What passes are told, and what they tell. Trees are extracted all at once, or node after node.
struct Totals {
  uint trees, first_tree;  // of the node at hand
  float error2_at_1m, heed_neighbours;
  uint cells, cells_before;           // of the node; of those before it
  uint all_trees;                     // of all nodes
  uint done;                          // work groups of the pass at hand
  uvec4 groups;                       // of quads, lines, points that are wanted so far, with this node
  uvec4 groups_before;                // where the node's begin: bark, lines, points, leaves
  uvec4 per_cell, per_block, per_row;  // work groups for choose, the scan of cells, expand
  Capacity capacity;
  vec4 view_sides[kViewSides];
  uvec4 shown;    // primitives of each kind, of all nodes
  uvec4 missing;  // what lists had no room for: cells; groups of quads, lines, points
};
