/* manzana.h compiles as C, and a C program can fill its structs. */
#include "manzana/manzana.h"

manzana_camera c_camera(int width, int height);

manzana_camera c_camera(int width, int height) {
  manzana_camera camera = {{0}, {0}, MANZANA_DEPTH_MINUS_ONE_TO_ONE, 0, 0, 0, 0};
  camera.width = width;
  camera.height = height;
  return camera;
}
