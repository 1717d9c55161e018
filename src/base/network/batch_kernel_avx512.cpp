#if defined(__AVX512F__)
#include "base/network/batch_kernel_source.hpp"
#endif
