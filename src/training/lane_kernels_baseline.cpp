#define LANE_KERNELS kLaneKernelsBaseline
#include "training/lane_kernels_source.hpp"
