#if defined(__AVX2__)
#define LANE_KERNELS kLaneKernelsAvx2
#include "training/lane_kernels_source.hpp"
#endif
