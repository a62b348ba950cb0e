// Which parts of a tree are shown, and how many of each. Compiled as GLSL and, within a struct that holds the same
// arrays, as C++ (foliage/select.cpp): both give the same bits, since only operations are used that IEEE 754 rounds
// correctly, in an order that `precise` fixes: no division, no square root, no library function.
//   sites, block_rows, plants, cells, steps, details, views: arrays
//   view_sides: planes of what is in view
//   error2_at_1m: the square of what may be wrong a metre away, in metres
//   heed_neighbours: 1: more may be wrong of what neighbours hide; 0: not

vec3 placed(vec4 x, vec4 y, vec4 z, vec3 p) {
  precise vec3 q;
  q.x = x.x * p.x + x.y * p.y + x.z * p.z + x.w;
  q.y = y.x * p.x + y.y * p.y + y.z * p.z + y.w;
  q.z = z.x * p.x + z.y * p.y + z.z * p.z + z.w;
  return q;
}

float squared(vec3 v) {
  precise float s = v.x * v.x + v.y * v.y + v.z * v.z;
  return s;
}

vec4 scaled_row(vec4 row, TreeSite site, float foot) {
  precise vec4 r;
  precise float x = row.x * site.turn.x + row.y * site.turn.y, y = row.y * site.turn.x - row.x * site.turn.y;
  r.x = x * site.radius;
  r.y = y * site.radius;
  r.z = row.z * site.height;
  r.w = foot;
  return r;
}

// Azimuths, in 256ths of the way from one to the next: none of them needs an angle.
uint azimuth_of(float x, float y, float both) {
  const uint kWhole = 256u * kLeewayAzimuths, kHalf = kWhole / 2u;
  uint b = uint(rounded_share(abs(y), both, int(kHalf / 2u)));
  uint around = x < 0.0f ? (y < 0.0f ? kHalf + b : kHalf - b) : (y < 0.0f ? kWhole - b : b);
  return around & (kWhole - 1u);
}

// Of a word, f / 256 of the way from a byte to the next; the last is followed by none.
uint leeway_between(uint word, uint height, uint f) {
  uint at = word >> (8u * height);
  return (at & 255u) * (256u - f) + ((at >> 8u) & 255u) * f;
}

// By how much the error of a tree may grow, seen from an eye so far from its middle, in its block's frame.
float leeway_of(uint index, vec3 eye) {
  float x = flushed(eye.x), y = flushed(eye.y), z = flushed(max(eye.z, 0.0f));
  precise float both = abs(x) + abs(y), up = kLeewaySteepness * z;
  precise float all = both + up;
  if (!(both > 0.0f) || !(all < 1.2676506002282294e30f)) return 0.0f;
  uint azimuth = azimuth_of(x, y, both), height = min(uint(rounded_share(up, all, 1024)), 1023u);
  uint a = azimuth >> 8u, b = (a + 1u) & (kLeewayAzimuths - 1u), f = height & 255u, g = azimuth & 255u;
  uint sum = leeway_between(sites[index].leeway[a], height >> 8u, f) * (256u - g) +
             leeway_between(sites[index].leeway[b], height >> 8u, f) * g;
  precise float far = min(both * 0.005f, 1.0f);  // 1 / kLeewayReach
  precise float more = float(sum) * 1.1967677696078431e-7f * far * heed_neighbours;  // kMostLeeway / (255 * 65536)
  return more;
}

vec3 eye_from(vec4 x, vec4 y, vec4 z, vec3 middle) {
  precise vec3 eye;
  eye.x = -(x.x * middle.x + y.x * middle.y + z.x * middle.z);
  eye.y = -(x.y * middle.x + y.y * middle.y + z.y * middle.z);
  eye.z = -(x.z * middle.x + y.z * middle.y + z.z * middle.z);
  return eye;
}

vec3 middle_of(TreeRecord tree) {
  return placed(tree.row_x, tree.row_y, tree.row_z, vec3(0.0f, 0.0f, plants[tree.plant].middle));
}

// What may be wrong of it so many squared metres away, and at its middle.
float error2_from(TreeRecord tree, float r2) {
  precise float error2 = r2 * tree.error2_from_1m;
  return error2;
}
float tree_error2(TreeRecord tree) { return error2_from(tree, squared(middle_of(tree))); }

TreeRecord place_tree(uint index) {
  TreeSite site = sites[index];
  vec4 x = block_rows[site.block * 3u], y = block_rows[site.block * 3u + 1u], z = block_rows[site.block * 3u + 2u];
  vec3 foot = placed(x, y, z, site.position);
  TreeRecord tree;
  tree.row_x = scaled_row(x, site, foot.x);
  tree.row_y = scaled_row(y, site, foot.y);
  tree.row_z = scaled_row(z, site, foot.z);
  tree.site = index;
  tree.plant = site.plant;
  tree.hash = site.hash;
  precise float times = 1.0f + leeway_of(index, eye_from(x, y, z, middle_of(tree)));
  precise float error2 = site.inv_scale2 * error2_at_1m * (times * times);
  tree.error2_from_1m = error2;
  return tree;
}

float between(float a, float b, float t) {
  precise float v = a + (b - a) * t;
  return v;
}

// The table is linear in error2 within each quarter of an octave, so exponent and upper bits are the row.
Detail detail_at(uint plant, float error2) {
  uint bits = floatBitsToUint(min(max(error2, 2.3283064365386963e-10f), 65535.0f));
  uint step = (bits >> 21u) - 380u;
  float t = float(bits & 0x1fffffu) * 4.76837158203125e-7f;
  Detail a = details[plant * kDetailSteps + step], b = details[plant * kDetailSteps + step + 1u];
  Detail d;
  d.share = between(a.share, b.share, t);
  d.scale = between(a.scale, b.scale, t);
  d.fade = between(a.fade, b.fade, t);
  d.to_points = between(a.to_points, b.to_points, t);
  d.points = between(a.points, b.points, t);
  d.lines = between(a.lines, b.lines, t);
  d.bark = between(a.bark, b.bark, t);
  d.point_level = between(a.point_level, b.point_level, t);
  d.point_gain = between(a.point_gain, b.point_gain, t);
  d.hidden = between(a.hidden, b.hidden, t);
  d.line_level = between(a.line_level, b.line_level, t);
  d.to_lines = between(a.to_lines, b.to_lines, t);
  return d;
}

// Items of a tree's own cells.
uint cells_of(TreeRecord tree, Detail d) {
  return d.to_points < 1.0f && d.to_lines < 1.0f ? plants[tree.plant].cells : 0u;
}

Item no_item(uint record, uint kind) {
  Item item;
  item.record = record;
  item.kind = kind;
  item.first = 0u;
  item.count = 0u;
  item.edge = 0.0f;
  item.fade = 1.0f;
  item.scale = 1.0f;
  item.second = 0u;
  return item;
}

// The level's mesh without the branches that have turned into lines already, the more of them the farther.
uvec2 branch_step(uint plant, uint level, float bark) {
  uint last = plants[plant].bark[level].z - 1u;
  precise float gone = min(bark - float(level), 1.0f) * float(last);
  return steps[plants[plant].first_step + plants[plant].bark[level].y + last - min(uint(gone), last)];
}

struct ItemPair {
  Item a, b;
};

ItemPair pair_of(Item a, Item b) {
  ItemPair pair;
  pair.a = a;
  pair.b = b;
  return pair;
}

// Of a level: where what is shown begins, what the next level shows instead ends, and all ends.
struct LineRange {
  uint first, next, last;
};

// Of the branches from this one on; then of leaves, as many of them as are neither quads nor points. On the way x to
// the next level the first branches are in its lines already, and then the first leaves.
LineRange line_range(uint plant, uint level, uint branch, float x, Detail d) {
  uint branches = plants[plant].branches, begin = plants[plant].first_line_row, row = begin + level * (branches + 2u);
  uint leaves = steps[row + branches].x;
  bool both = branches > 0u && steps[begin + branches + 1u].x > steps[begin + branches].x;
  LineRange range;
  range.first = steps[row + branch].x;
  precise float of_branches = float(leaves - range.first) * d.lines;
  precise float of_leaves = float(steps[row + branches + 1u].x - leaves) * (d.to_lines * (1.0f - d.to_points));
  precise float ranks = min(both ? 2.0f * x : x, 1.0f) * float(branches);
  precise float turned = float(uint(of_leaves)) * max(both ? 2.0f * x - 1.0f : x, 0.0f);
  uint rank = min(uint(ranks), branches);
  range.last = of_leaves >= 1.0f ? leaves + uint(of_leaves) : range.first + uint(of_branches);
  range.next = rank < branches ? steps[row + max(rank, branch)].x : leaves + uint(turned);
  range.next = min(range.next, range.last);
  return range;
}

// Each branch is in one of two neighbouring levels.
Item line_item(TreeRecord tree, uint record, Detail d, uint branch) {
  uint plant = tree.plant, levels = plants[plant].line_levels;
  Item item = no_item(record, kLines);
  if (levels == 0u) return item;
  uint level = min(uint(d.line_level), levels - 1u);
  precise float x = min(d.line_level - float(level), 1.0f);
  LineRange fine = line_range(plant, level, branch, x, d);
  LineRange coarse = line_range(plant, min(level + 1u, levels - 1u), branch, x, d);
  uint of_coarse = coarse.next - coarse.first;
  item.first = plants[plant].first_line + coarse.first;
  item.second = plants[plant].first_line + fine.next - of_coarse;
  item.count = of_coarse + fine.last - fine.next;
  item.edge = float(of_coarse);
  return item;
}

// Bark and lines.
ItemPair branch_items(TreeRecord tree, uint record, Detail d) {
  uint plant = tree.plant, levels = plants[plant].bark_levels;
  Item bark = no_item(record, kBark);
  if (levels == 0u) return pair_of(bark, line_item(tree, record, d, 0u));
  uint level = min(uint(d.bark), levels - 1u);
  uvec2 step = branch_step(plant, level, d.bark);
  bark.first = plants[plant].first_quad + plants[plant].bark[level].x;
  bark.count = step.x;
  return pair_of(bark, line_item(tree, record, d, step.y));
}

// The last points shrink away, over a part of the level that stays as wide: so each takes its time. Where details fade.
Item faded(Item item, float shown, float most, uint hash, Detail d) {
  bool fades = d.fade >= 0.0f;
  precise float edge = shown * (fades ? kPointFade + 1.0f : 1.0f) + fraction_of(hash);
  precise float fade = most * (kPointFade * d.to_points);
  item.count = uint(max(min(edge, most), 0.0f));
  item.edge = fades ? edge : 3.0e38f;
  item.fade = max(fade, 1.0f);
  return item;
}

// Points of two neighbouring levels: x on the way from one to the next, x times all of the coarser are shown, and as
// many of the finer as are missing. So each level is whole where the next one takes over.
ItemPair points_items(TreeRecord tree, uint record, Detail d) {
  uint plant = tree.plant, levels = plants[plant].point_levels;
  Item fine = no_item(record, kPoints), coarse = fine;
  if (levels == 0u || d.to_points <= 0.0f) return pair_of(fine, coarse);
  uint level = min(uint(d.point_level), levels - 1u), next = min(level + 1u, levels - 1u);
  uvec4 of_level = plants[plant].points[level], of_next = plants[plant].points[next];
  precise float x = d.point_level - float(level), of_coarse = x * float(of_next.y);
  precise float fine_shown = (d.points - of_coarse) * d.to_points, coarse_shown = of_coarse * d.to_points;
  precise float fine_gain = float(of_level.y) * d.point_gain, coarse_gain = float(of_next.y) * d.point_gain;
  fine.first = plants[plant].first_point + of_level.x;
  fine = faded(fine, fine_shown, float(of_level.y), mixed(tree.hash + 2u), d);
  fine.scale = fine_gain;
  coarse.first = plants[plant].first_point + of_next.x;
  coarse = faded(coarse, coarse_shown, float(of_next.y), mixed(tree.hash + 3u), d);
  coarse.scale = coarse_gain;
  return pair_of(fine, coarse);
}

uint view_share(uint plant, uint cell, uint direction) {
  uint side = plants[plant].view_side, at = plants[plant].first_view + cell * side * side + direction;
  return (views[at >> 2u] >> (8u * (at & 3u))) & 255u;
}

// Share of a cell that can be seen from the eye: between three baked directions outside, all of it within the crown.
float visible_share(TreeRecord tree, uint index, float hidden) {
  uint plant = tree.plant, side = plants[plant].view_side;
  if (side == 0u || hidden <= 0.0f) return 1.0f;
  TreeSite site = sites[tree.site & ((1u << kShareShift) - 1u)];
  vec3 middle = middle_of(tree);
  precise float r2 = squared(middle) * site.inv_scale2;
  precise float outside = (r2 - plants[plant].near2) * plants[plant].per_near2;
  if (outside <= 0.0f) return 1.0f;
  precise float rr = site.radius * site.radius, hh = site.height * site.height;
  precise float x = tree.row_x.x * middle.x + tree.row_y.x * middle.y + tree.row_z.x * middle.z;
  precise float y = tree.row_x.y * middle.x + tree.row_y.y * middle.y + tree.row_z.y * middle.z;
  precise float z = tree.row_x.z * middle.x + tree.row_y.z * middle.y + tree.row_z.z * middle.z;
  precise float ex = -x * hh, ey = -y * hh, ez = -z * rr;
  GridWeights grid = grid_weights(side, vec3(ex, ey, ez));
  uint sum = grid.weight.x * view_share(plant, index, grid.vertex.x) +
             grid.weight.y * view_share(plant, index, grid.vertex.y) +
             grid.weight.z * view_share(plant, index, grid.vertex.z);
  precise float baked = float(sum) * 1.5318627450980392e-5f;  // 1 / (256 * 255)
  return between(1.0f, baked, min(outside, 1.0f) * hidden);
}

// Whether all of a cell is beyond a side of the picture, with leaves scaled so and in any wind; rounded to "no".
bool beside_view(TreeRecord tree, CellHead cell, vec3 centre, float scale) {
  TreeSite site = sites[tree.site & ((1u << kShareShift) - 1u)];
  precise float most = max(site.radius, site.height) * (cell.radius + cell.leaf * max(scale - 1.0f, 0.0f) + cell.sway);
  precise float reach = most * 1.0001f + (abs(centre.x) + abs(centre.y) + abs(centre.z)) * 4.0e-6f;
  bool beside = false;
  for (uint i = 0u; i < kViewSides; ++i) {
    precise float inside =
        view_sides[i].x * centre.x + view_sides[i].y * centre.y + view_sides[i].z * centre.z + view_sides[i].w + reach;
    beside = beside || inside < 0.0f;
  }
  return beside;
}

Item cell_item(TreeRecord tree, uint record, uint index) {
  CellHead cell = cells[plants[tree.plant].first_cell + index];
  Item item = no_item(record, kLeaves);
  vec3 centre = placed(tree.row_x, tree.row_y, tree.row_z, cell.centre);
  Detail at_tree = detail_at(tree.plant, tree_error2(tree)),
         d = detail_at(tree.plant, error2_from(tree, squared(centre)));
  if (beside_view(tree, cell, centre, d.scale)) return item;
  // Where points or lines take over, quads shrink away too.
  precise float left = (1.0f - at_tree.to_points) * (1.0f - at_tree.to_lines);
  precise float going = min(4.0f * (1.0f - left), 1.0f) * kLeafFade;
  precise float more = d.fade < 0.0f ? 0.0f : max(going - d.fade, 0.0f);
  precise float keep =
      d.share * visible_share(tree, index, d.hidden) * left * (1.0f + 0.5f * more);
  precise float shown = float(cell.count) * keep;
  uint hash = mixed(tree.hash ^ mixed(index));
  precise float edge = shown + fraction_of(hash);
  item.first = plants[tree.plant].first_quad + cell.first;
  item.count = min(uint(edge), cell.count);
  item.edge = keep >= 1.0f ? 3.0e38f : edge;
  precise float fade = shown * (d.fade + more);
  item.fade = max(fade, 1.0f);
  item.scale = d.scale;
  return item;
}
