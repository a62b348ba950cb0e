#include "foliage/import/gltf_plant.h"
