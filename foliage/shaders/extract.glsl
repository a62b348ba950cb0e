// From visible trees to what is drawn of them, in five dispatches without a read-back:
//   place    a tree in view -> its record, and how many items it has
//   scan     their sums, so that each tree knows where its items stand
//   choose   an item -> how many primitives of which list; how many groups they fill
//   scan     their sums
//   expand   an item -> its groups; a draw reads groups
// Draws read groups. What a list has no room for is left out, and counted: hosts should see to it that it never
// happens (foliage/budget.h).
const uint kScanBlock = 1024u;    // elements that one work group sums
const uint kQuadsOfDraw = 65536u;  // of one command; the index buffer repeats

struct Capacity {
  uint items, quad_groups, line_groups, point_groups;
  uint quad_draws, line_draws, spare0, spare1;  // commands that these might need
};

// What passes are told, and what they tell. Trees are extracted all at once, or node after node: what earlier nodes have
// left is `before`.
struct Totals {
  uint trees, runs, first_tree;  // of the node at hand
  float error2_at_1m;
  uint items, items_before, spare0, spare1;  // of the node; of those before it
  uvec4 groups, groups_before;               // quads, lines, points in x, y, z: with this node; without
  uvec4 per_item, per_block;                 // work groups for choose and expand, and for the scan of items
  Capacity capacity;
  uvec4 shown;    // primitives of each kind, of all nodes
  uvec4 missing;  // what lists had no room for: items; groups of quads, lines, points
};
