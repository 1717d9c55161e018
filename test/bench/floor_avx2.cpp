#if defined(__AVX2__)
#define FLOOR_KERNELS kFloorAvx2
#include "floor_source.hpp"
#endif
