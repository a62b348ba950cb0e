layout(local_size_x = 64) in;
layout(std430, binding = 7) restrict readonly buffer SitesInView { uint sites_in_view[]; };
layout(std430, binding = 9) restrict writeonly buffer Trees { TreeRecord trees[]; };
layout(std430, binding = 13) restrict writeonly buffer Sums { uvec4 offsets[]; };
layout(std430, binding = 19) restrict writeonly buffer Counts { uvec4 counts[]; };
layout(std430, binding = 15) restrict writeonly buffer Items { Item items[]; };

void main() {
  uint i = gl_GlobalInvocationID.x, index = totals.first_tree + i, item = index * kFixedItems;
  if (i >= totals.trees) return;
  uint word = sites_in_view[index];
  TreeRecord tree = place_tree(word & ((1u << kShareShift) - 1u));
  tree.site = word;
  trees[index] = tree;
  Detail d = detail_at(tree.plant, tree_error2(tree));
  ItemPair branches = branch_items(tree, index, d), points = points_items(tree, index, d);
  bool shown = word >> kShareShift != kAllMosaics;  // a tree that is not has a record, for its shadow
  if (!shown) branches.a.count = branches.b.count = points.a.count = points.b.count = 0u;
  items[item] = branches.a;
  items[item + 1u] = branches.b;
  items[item + 2u] = points.a;
  items[item + 3u] = points.b;
  counts[i] = uvec4(branches.a.count, branches.b.count, points.a.count, points.b.count);
  offsets[i].w = shown ? cells_of(tree, d) : 0u;  // the others follow from the items
}
