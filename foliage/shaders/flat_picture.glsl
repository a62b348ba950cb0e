layout(location = 0) uniform float focal_px;

// Metres along the view; what is behind the eye is clipped, whatever it is given here.
float depth_of(vec3 rel, vec4 clip) { return max(clip.w, 0.01 * length(rel)); }

// What a square metre that faces the eye has of a flat picture: towards the border more, by 1 / cos^3 of the angle.
float facing_pixels(vec3 rel, float depth) {
  float f = focal_px / depth;
  return f * f * length(rel) / depth;
}
