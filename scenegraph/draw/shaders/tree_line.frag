layout(location = 0) in vec4 light;  // times the bark's colour; alpha: true width over the drawn one
layout(location = 1) in vec3 air;
layout(location = 2) flat in uint hash;
layout(location = 0) out vec4 colour;

layout(location = 1) uniform float alpha_to_coverage;

void main() {
  // Without coverage, as many pixels as alpha says, by a pattern without a grid.  [Jimenez 2014, interleaved gradient]
  float threshold = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))) + float(hash & 255u) / 256.0);
  if (light.a < threshold * (1.0 - alpha_to_coverage)) discard;
  colour = vec4(film(light.rgb + air), light.a);
}
