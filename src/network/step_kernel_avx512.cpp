#if defined(__AVX512F__)
#define STEP_KERNELS kStepKernelsAvx512
#include "network/step_kernel_source.hpp"
#endif
