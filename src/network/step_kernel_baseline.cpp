#define LAYER_KERNEL baselineLayerKernel
#include "network/step_kernel_source.hpp"
