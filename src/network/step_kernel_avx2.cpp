#if defined(__AVX2__)
#define LAYER_KERNEL avx2LayerKernel
#include "network/step_kernel_source.hpp"
#endif
