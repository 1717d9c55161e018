#if defined(__AVX512F__)
#define LAYER_KERNEL avx512LayerKernel
#include "network/step_kernel_source.hpp"
#endif
