#if defined(__AVX2__)
#include "network/batch_kernel_source.hpp"
#endif
