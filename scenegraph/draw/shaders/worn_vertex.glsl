// Of a vertex that wears a picture: which.
layout(location = 6) in uint worn;
uint seed_of(uint own_colour, uint own_block) { return worn; }
