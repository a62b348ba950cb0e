// One work group for all cells.
shared uint part[256];

// floor(n lod), as foliage/lod_factor.h has it: in double, since float loses leaves of large cells.
uint kept(uint n, float lod) {
  if (lod >= 1.0f) return n;
  return lod > 0.0f ? min(n, uint(double(n) * double(lod))) : 0u;
}

void main() {
  uint t = gl_LocalInvocationID.x, total = 0u;
  for (uint first = 0u; first < cell_count; first += 256u) {
    uint cell = first + t, mine = cell < cell_count ? kept(cells[first_cell + cell].count, lods[cell]) : 0u;
    part[t] = mine;
    for (uint step = 1u; step < 256u; step *= 2u) {
      barrier();
      uint left = t >= step ? part[t - step] : 0u;
      barrier();
      part[t] += left;
    }
    barrier();
    if (cell < cell_count) offsets[cell] = total + part[t] - mine;
    total += part[255];
    barrier();
  }
  if (t != 0u) return;
  draw[0] = total * kIndices;
  draw[1] = 1u;
  draw[2] = draw[3] = draw[4] = 0u;
  dispatch[0] = (total + 255u) / 256u;
  dispatch[1] = dispatch[2] = 1u;
}
