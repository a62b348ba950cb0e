// The last cell that begins at this leaf or before: empty ones begin where the next one does.
uint cell_of(uint leaf) {
  uint low = 0u, high = cell_count;
  while (high - low > 1u) {
    uint middle = (low + high) / 2u;
    if (offsets[middle] <= leaf) low = middle;
    else high = middle;
  }
  return low;
}

void main() {
  uint leaf = gl_GlobalInvocationID.x;
  if (leaf >= draw[0] / kIndices) return;
  uint cell = cell_of(leaf);
  uint corner = 4u * (first_quad + cells[first_cell + cell].first + leaf - offsets[cell]), at = leaf * kIndices;
  indices[at] = corner;
  indices[at + 1u] = corner + 1u;
  indices[at + 2u] = corner + 2u;
  indices[at + 3u] = corner;
  indices[at + 4u] = corner + 2u;
  indices[at + 5u] = corner + 3u;
}
