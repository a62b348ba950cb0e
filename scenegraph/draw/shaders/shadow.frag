// Multiplied with what is there.
layout(location = 0) in vec2 at;
layout(location = 1) flat in vec2 kind;
layout(location = 0) out vec4 colour;

void main() {
  vec2 q = at * at;
  float d = mix(q.x + q.y, dot(q, q), kind.y);
  colour = vec4(vec3(1.0 - kind.x * (1.0 - smoothstep(mix(0.1, 0.35, kind.y), 1.0, d))), 1.0);
}
