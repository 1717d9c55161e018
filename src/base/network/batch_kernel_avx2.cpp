#if defined(__AVX2__)
#include "base/network/batch_kernel_source.hpp"
#endif
