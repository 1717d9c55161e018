#define FLOOR_KERNELS kFloorBaseline
#include "floor_source.hpp"
