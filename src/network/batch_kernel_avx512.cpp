#if defined(__AVX512F__)
#include "batch_kernel_source.hpp"
#endif
