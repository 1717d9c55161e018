#define LAYER_KERNEL layerKernelBaseline
#include "network/step_kernel_source.hpp"
