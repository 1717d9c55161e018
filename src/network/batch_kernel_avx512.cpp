#if defined(__AVX512F__)
#include "network/batch_kernel_source.hpp"
#endif
