#define LAYER_KERNEL baselineLayerKernel
#define NETWORK_KERNEL baselineNetworkKernel
#include "network/step_kernel_source.hpp"
