#if defined(__AVX512F__)
#include "lane_kernels_source.hpp"
#endif
