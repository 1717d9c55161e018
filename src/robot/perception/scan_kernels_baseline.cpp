#define SCAN_KERNELS baselineScanKernels
#include "robot/perception/scan_kernels_source.hpp"
