#define SHIELD_KERNELS baselineShieldKernels
#include "robot/driving/shield_kernels_source.hpp"
