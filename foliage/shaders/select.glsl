// Which parts of a tree are shown, and how many of each. Compiled as GLSL and, within a struct that holds the same
// arrays, as C++ (foliage/select.cpp): both give the same bits, since only operations are used that IEEE 754 rounds
// correctly, in an order that `precise` fixes: no division, no square root, no library function.
//   sites, block_rows, plants, cells, steps, details, views: arrays
//   error2_at_1m: the square of what may be wrong a metre away, in metres

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
  vec3 middle = placed(tree.row_x, tree.row_y, tree.row_z, vec3(0.0f, 0.0f, plants[site.plant].middle));
  precise float error2 = squared(middle) * site.inv_scale2 * error2_at_1m;
  tree.error2 = error2;
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
  d.spare0 = 0.0f;
  d.spare1 = 0.0f;
  return d;
}

uint items_of(TreeRecord tree) {
  Detail d = detail_at(tree.plant, tree.error2);
  return kFixedItems + (d.to_points < 1.0f ? plants[tree.plant].cells : 0u);
}

// floor(n + a random part of 1), at most `most`: cells and trees share remainders fairly.
uint rounded(float n, uint hash, uint most) {
  precise float edge = n + fraction_of(hash);
  return min(uint(max(edge, 0.0f)), most);
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
  item.spare = 0.0f;
  return item;
}

// The level's mesh without the branches that have turned into lines already, the more of them the farther.
uvec2 branch_step(PlantHead plant, Detail d) {
  uint level = min(uint(d.bark), plant.bark_levels - 1u), last = plant.bark[level].z - 1u;
  precise float gone = min(d.bark - float(level), 1.0f) * float(last);
  return steps[plant.first_step + plant.bark[level].y + last - min(uint(gone), last)];
}

Item bark_item(TreeRecord tree, uint record, Detail d) {
  PlantHead plant = plants[tree.plant];
  Item item = no_item(record, kBark);
  if (plant.bark_levels == 0u) return item;
  item.first = plant.first_quad + plant.bark[min(uint(d.bark), plant.bark_levels - 1u)].x;
  item.count = branch_step(plant, d).x;
  return item;
}

Item lines_item(TreeRecord tree, uint record, Detail d) {
  PlantHead plant = plants[tree.plant];
  Item item = no_item(record, kLines);
  if (plant.bark_levels == 0u) return item;
  uint first = branch_step(plant, d).y, last = min(uint(d.lines), plant.lines);
  item.first = plant.first_line + first;
  item.count = max(last, first) - first;
  return item;
}

// Points of two neighbouring levels: x on the way from one to the next, x times all of the coarser are shown, and as
// many of the finer as are missing. So each level is whole where the next one takes over.
Item points_item(TreeRecord tree, uint record, Detail d, uint slot) {
  PlantHead plant = plants[tree.plant];
  Item item = no_item(record, kPoints);
  if (plant.point_levels == 0u || d.to_points <= 0.0f) return item;
  uint fine = min(uint(d.point_level), plant.point_levels - 1u), coarse = min(fine + 1u, plant.point_levels - 1u);
  precise float x = d.point_level - float(fine), of_coarse = x * float(plant.points[coarse].y);
  uint level = slot == 2u ? fine : coarse;
  precise float shown = (slot == 2u ? d.points - of_coarse : of_coarse) * d.to_points;
  item.first = plant.first_point + plant.points[level].x;
  item.count = rounded(shown, mixed(tree.hash + slot), plant.points[level].y);
  precise float gain = float(plant.points[level].y) * d.point_gain;
  item.scale = gain;
  return item;
}

uint view_share(PlantHead plant, uint cell, uint direction) {
  uint at = plant.first_view + cell * plant.view_side * plant.view_side + direction;
  return (views[at >> 2u] >> (8u * (at & 3u))) & 255u;
}

// Share of a cell that can be seen from the eye: between three baked directions outside, all of it within the crown.
float visible_share(TreeRecord tree, uint index, float hidden) {
  PlantHead plant = plants[tree.plant];
  if (plant.view_side == 0u || hidden <= 0.0f) return 1.0f;
  TreeSite site = sites[tree.site];
  vec3 middle = placed(tree.row_x, tree.row_y, tree.row_z, vec3(0.0f, 0.0f, plant.middle));
  precise float r2 = squared(middle) * site.inv_scale2, outside = (r2 - plant.near2) * plant.per_near2;
  if (outside <= 0.0f) return 1.0f;
  precise float rr = site.radius * site.radius, hh = site.height * site.height;
  precise float x = tree.row_x.x * middle.x + tree.row_y.x * middle.y + tree.row_z.x * middle.z;
  precise float y = tree.row_x.y * middle.x + tree.row_y.y * middle.y + tree.row_z.y * middle.z;
  precise float z = tree.row_x.z * middle.x + tree.row_y.z * middle.y + tree.row_z.z * middle.z;
  precise float ex = -x * hh, ey = -y * hh, ez = -z * rr;
  GridWeights grid = grid_weights(plant.view_side, vec3(ex, ey, ez));
  uint sum = grid.weight.x * view_share(plant, index, grid.vertex.x) +
             grid.weight.y * view_share(plant, index, grid.vertex.y) +
             grid.weight.z * view_share(plant, index, grid.vertex.z);
  precise float baked = float(sum) * 1.5318627450980392e-5f;  // 1 / (256 * 255)
  return between(1.0f, baked, min(outside, 1.0f) * hidden);
}

Item cell_item(TreeRecord tree, uint record, Detail at_tree, uint index) {
  PlantHead plant = plants[tree.plant];
  CellHead cell = cells[plant.first_cell + index];
  Item item = no_item(record, kLeaves);
  float r2 = squared(placed(tree.row_x, tree.row_y, tree.row_z, cell.centre));
  precise float error2 = r2 * sites[tree.site].inv_scale2 * error2_at_1m;
  Detail d = detail_at(tree.plant, error2);
  precise float keep = d.share * visible_share(tree, index, d.hidden) * (1.0f - at_tree.to_points);
  precise float shown = float(cell.count) * keep;
  uint hash = mixed(tree.hash ^ mixed(index));
  precise float edge = shown + fraction_of(hash);
  item.first = plant.first_quad + cell.first;
  item.count = min(uint(edge), cell.count);
  item.edge = keep >= 1.0f ? 3.0e38f : edge;
  precise float fade = shown * d.fade;
  item.fade = d.fade < 0.0f ? 1.0e-6f : max(fade, 1.0f);
  item.scale = d.scale;
  return item;
}

Item choose_item(TreeRecord tree, uint record, uint slot) {
  Detail d = detail_at(tree.plant, tree.error2);
  if (slot == 0u) return bark_item(tree, record, d);
  if (slot == 1u) return lines_item(tree, record, d);
  if (slot < kFixedItems) return points_item(tree, record, d, slot);
  return cell_item(tree, record, d, slot - kFixedItems);
}
