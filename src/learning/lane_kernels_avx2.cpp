#if defined(__AVX2__)
#include "lane_kernels_source.hpp"
#endif
