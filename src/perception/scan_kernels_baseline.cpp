#define SCAN_KERNELS baselineScanKernels
#include "perception/scan_kernels_source.hpp"
