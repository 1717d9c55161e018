#if defined(__AVX512F__)
#define FLOOR_KERNELS kFloorAvx512
#include "floor_source.hpp"
#endif
