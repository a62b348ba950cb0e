// The ground's photo: a pyramid whose finer levels are held about the eye only, each in a window that repeats.  [Tanner,
// Migdal, Jones, The Clipmap: A Virtual Mipmap, SIGGRAPH 1998]
layout(std140, binding = 1) uniform PhotoBlock { PhotoData photo; };
layout(binding = 0) uniform sampler2DArray photo_windows;
layout(binding = 1) uniform sampler2D photo_rest;

bool photo_held(int level, vec2 p) {
  if (level >= int(photo.place.w)) return true;
  vec2 q = p * exp2(-float(level));
  vec4 held = photo.held[level];
  return all(greaterThanEqual(q, held.xy + 0.5)) && all(lessThanEqual(q, held.zw - 0.5));
}

vec4 photo_at(int level, vec2 p) {
  vec2 q = p * exp2(-float(level));
  int windows = int(photo.place.w);
  if (level < windows) return textureLod(photo_windows, vec3(q / photo.size.z, float(level)), 0.0);
  vec2 whole = p * exp2(-photo.place.w) / vec2(textureSize(photo_rest, 0));
  return textureLod(photo_rest, whole, float(level - windows));
}

// What the photo has there, premultiplied; plan: x and y in L, relative to the eye.
vec4 photo_seen(vec2 plan) {
  vec2 p = photo.place.xy + plan * photo.place.z;
  vec2 along = dFdx(p), across = dFdy(p);
  float lod = max(0.5 * log2(max(dot(along, along), dot(across, across))), 0.0);
  if (any(lessThan(p, vec2(0.0))) || any(greaterThan(p, photo.size.xy))) return vec4(0.0);
  int fine = int(lod);
  float rest = lod - float(fine);
  while (!photo_held(fine, p)) ++fine, rest = 0.0;
  vec4 seen = photo_at(fine, p);
  if (rest > 0.0 && photo_held(fine + 1, p)) seen = mix(seen, photo_at(fine + 1, p), rest);
  return seen;
}

// And `base` where it has nothing.
vec3 photographed(vec3 base, vec2 plan) {
  vec4 seen = photo_seen(plan);
  return base * (1.0 - seen.a) + seen.rgb;
}
