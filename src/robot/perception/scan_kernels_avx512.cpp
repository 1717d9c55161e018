#if defined(__AVX512F__)
#define SCAN_KERNELS avx512ScanKernels
#include "robot/perception/scan_kernels_source.hpp"
#endif
