// The soft shadow of a crown: a disc on the ground, a little away from the sun; within the crown's own radius, so that a
// tree that is culled takes no visible shadow with it; lighter where the crown is sparse, none where it is very sparse
// or too small to see. The instance is the tree's.
layout(std430, binding = 3) readonly buffer Plants { PlantHead plants[]; };
layout(std430, binding = 9) readonly buffer Trees { TreeRecord trees[]; };

layout(location = 0) out vec2 out_at;
layout(location = 1) flat out vec2 out_kind;  // darkness, squareness

void main() {
  vec2 at = vec2(gl_VertexID == 0 || gl_VertexID == 3 ? -1.0 : 1.0, gl_VertexID < 2 ? -1.0 : 1.0);
  TreeRecord tree = trees[gl_InstanceID];
  vec3 x = vec3(tree.row_x.x, tree.row_y.x, tree.row_z.x);
  vec3 up = normalize(vec3(tree.row_x.z, tree.row_y.z, tree.row_z.z));
  float r = length(x) * plants[tree.plant].crown;
  vec3 away = up * dot(frame.sun.xyz, up) - frame.sun.xyz;  // level, away from the sun, at most 1 long
  vec3 along = length(away) > 1e-4 ? normalize(away) : normalize(cross(up, vec3(0.3, 1.0, 0.2)));
  vec3 across = cross(along, up);
  vec3 foot = vec3(tree.row_x.w, tree.row_y.w, tree.row_z.w) + up * 0.17;  // over the highest surface
  vec3 rel = foot + r * (0.22 * away + 0.78 * (along * at.y + across * at.x));
  float distance = length(rel), seen = r / (distance * length(frame.ray_up.xyz));  // of half the picture's height
  float dark = 0.6 * plants[tree.plant].density * exp2(-distance * frame.fog.x) * smoothstep(0.003, 0.008, seen);
  out_at = at;
  out_kind = vec2(dark, 0.0);
  gl_Position = dark > 0.004 && plants[tree.plant].density >= kLeastShadow ? frame.view_projection * vec4(rel, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
