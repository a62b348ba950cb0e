// Two fans round the eye, at infinity: from the zenith down to the Earth's horizon, and from there to the nadir. Each has
// a shader of its own, because software devices run both sides of a branch.
layout(location = 0) out vec3 out_ray;

layout(location = 0) uniform float side;  // 1: above the horizon, -1: below

const int kSides = 48;
const float kEarth = 6371008.8;

void main() {
  vec3 up = frame.up.xyz;
  vec3 a = normalize(cross(up, abs(up.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  vec3 b = cross(up, a);
  float h = max(frame.up.w, 0.3) / kEarth;
  float dip = sqrt(h * (2.0 + h)) / (1.0 + h);  // sine of the horizon's depression
  int triangle = gl_VertexID / 3, corner = gl_VertexID % 3;
  float angle = 6.28318530718 * float((triangle + corner) % kSides) / float(kSides);
  vec3 rim = sqrt(1.0 - dip * dip) * (cos(angle) * a + sin(angle) * b) - dip * up;
  out_ray = corner == 0 ? side * up : rim;
  gl_Position = frame.view_projection * vec4(out_ray, 0.0);
}
