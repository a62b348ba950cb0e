// What wears a picture: as it is, without our windows and tiles.
void main() {
  keep_own_share();
  vec3 base = worn_colour(albedo, uv, kind.y);
  colour = picture(base * diffuse_light(normalize(smooth_normal), 1.0), rel);
}
