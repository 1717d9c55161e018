#if defined(__AVX2__)
#define LAYER_KERNEL layerKernelAvx2
#include "network/step_kernel_source.hpp"
#endif
