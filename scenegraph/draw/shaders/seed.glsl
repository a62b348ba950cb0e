// Of a vertex that wears no picture.
uint seed_of(uint own_colour, uint own_block) {
  return (own_block >> 24) != 0u ? own_block >> 24 : own_colour ^ own_block * 2654435761u;
}
