#define STEP_KERNELS kStepKernelsBaseline
#include "network/step_kernel_source.hpp"
