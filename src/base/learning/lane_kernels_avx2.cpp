#if defined(__AVX2__)
#include "base/learning/lane_kernels_source.hpp"
#endif
