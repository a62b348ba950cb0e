// A crown as an ellipsoid, of six bands round its axis.
struct Crown {
  vec4 foot;  // relative to the eye; w: height
  vec4 up;    // w: radius
  uvec4 id;
};
layout(std430, binding = 2) readonly buffer Crowns { Crown crowns[]; };
layout(location = 0) uniform mat4 view_projection;

layout(location = 0) flat out uint id;

const int kSides = 10, kBands = 6;
const float kPi = 3.14159265;

void main() {
  Crown crown = crowns[gl_InstanceID];
  int quad = gl_VertexID / 6, corner = gl_VertexID % 6;
  int right = corner == 1 || corner == 2 || corner == 4 ? 1 : 0, top = corner == 2 || corner == 4 || corner == 5 ? 1 : 0;
  float angle = 2.0 * kPi * float(quad % kSides + right) / float(kSides);
  float rise = kPi * (float(quad / kSides + top) / float(kBands) - 0.5);
  vec3 z = crown.up.xyz, x = normalize(cross(z, abs(z.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0)));
  vec3 out_from = cos(rise) * (cos(angle) * x + sin(angle) * cross(z, x));
  vec3 rel = crown.foot.xyz + crown.up.w * out_from + crown.foot.w * 0.5 * (1.0 + sin(rise)) * z;
  id = crown.id.x;
  gl_Position = view_projection * vec4(rel, 1.0);
}
