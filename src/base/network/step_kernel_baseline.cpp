#define LAYER_KERNEL baselineLayerKernel
#define NETWORK_KERNEL baselineNetworkKernel
#include "base/network/step_kernel_source.hpp"
