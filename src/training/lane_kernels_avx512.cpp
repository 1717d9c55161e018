#if defined(__AVX512F__)
#define LANE_KERNELS kLaneKernelsAvx512
#include "training/lane_kernels_source.hpp"
#endif
