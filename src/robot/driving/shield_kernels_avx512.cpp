#if defined(__AVX512F__)
#define SHIELD_KERNELS avx512ShieldKernels
#include "robot/driving/shield_kernels_source.hpp"
#endif
