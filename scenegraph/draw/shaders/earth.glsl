// The Earth's own ground, a sphere without end or hole.
const float kEarth = 6371008.8;

// Distance to the Earth along d, metres. Scaled by the Earth's radius, and the nearer root taken by the quotient that
// does not cancel. A ray that just misses is given the horizon's distance.
float earth_distance(vec3 d) {
  float h = max(frame.up.w, 0.3) / kEarth;
  float b = min((1.0 + h) * dot(d, frame.up.xyz), -1e-7);
  float q = h * (2.0 + h);
  return kEarth * q / (sqrt(max(b * b - q, 0.0)) - b);
}
