#if defined(__AVX2__)
#define SCAN_KERNELS avx2ScanKernels
#include "robot/perception/scan_kernels_source.hpp"
#endif
