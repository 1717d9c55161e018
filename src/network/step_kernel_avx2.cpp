#if defined(__AVX2__)
#define STEP_KERNELS kStepKernelsAvx2
#include "network/step_kernel_source.hpp"
#endif
