// A picture whose colours are before black, over or onto what is there.
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 mask;

void main() {
  colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
  mask = vec4(colour.a);
}
