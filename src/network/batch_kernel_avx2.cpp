#if defined(__AVX2__)
#include "batch_kernel_source.hpp"
#endif
