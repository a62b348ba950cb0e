// Of a tree that mosaics show a share of: the other samples.
layout(location = 7) flat in uvec2 plant_share;  // the tree's hash; 255ths

uint tree_samples() {
  uint mask = ~0u;
  if (plant_share.y == 0u) return mask;
  float choice = pixel_number(plant_share.x), share = float(plant_share.y) * (1.0 / 255.0);
  for (uint s = 0u; s < samples; ++s)
    if (sample_number(choice, s, samples) < share) mask &= ~(1u << s);
  return mask;
}
