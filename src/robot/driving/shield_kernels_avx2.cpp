#if defined(__AVX2__)
#define SHIELD_KERNELS avx2ShieldKernels
#include "robot/driving/shield_kernels_source.hpp"
#endif
