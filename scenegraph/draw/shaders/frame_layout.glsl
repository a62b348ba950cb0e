// What is the same for all of a frame; compiled as C++ too (camera.h). Directions and positions are in L's axes,
// relative to the eye, metres. Light is linear, relative to a white that the tone mapping knows.
struct FrameData {
  mat4 view_projection;
  vec4 ray_forward;   // the view ray of a pixel: forward + x right + y up with x, y in -1..1
  vec4 ray_right;
  vec4 ray_up;
  vec4 up;            // away from the Earth at the eye; w: height of the eye over the ground, metres
  vec4 sun;           // towards the sun, unit
  vec4 sun_light;
  vec4 sky_light;     // from above
  vec4 ground_light;  // thrown back from below
  vec4 horizon;       // the air's own light, far away
  vec4 zenith;
  vec4 fog;           // x: 1 / distance where half of the light is the air's
  vec4 ground_x;      // axes of the ground's and the clouds' noise; w: the eye's place along them, metres
  vec4 ground_y;
};
