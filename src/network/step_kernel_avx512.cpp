#if defined(__AVX512F__)
#define LAYER_KERNEL avx512LayerKernel
#define NETWORK_KERNEL avx512NetworkKernel
#include "network/step_kernel_source.hpp"
#endif
