#if defined(__AVX512F__)
#define LAYER_KERNEL layerKernelAvx512
#include "network/step_kernel_source.hpp"
#endif
