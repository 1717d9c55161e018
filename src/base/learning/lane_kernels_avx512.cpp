#if defined(__AVX512F__)
#include "base/learning/lane_kernels_source.hpp"
#endif
