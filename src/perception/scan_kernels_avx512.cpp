#if defined(__AVX512F__)
#define SCAN_KERNELS avx512ScanKernels
#include "perception/scan_kernels_source.hpp"
#endif
