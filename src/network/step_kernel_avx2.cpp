#if defined(__AVX2__)
#define LAYER_KERNEL avx2LayerKernel
#define NETWORK_KERNEL avx2NetworkKernel
#include "network/step_kernel_source.hpp"
#endif
