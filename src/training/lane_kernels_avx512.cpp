#if defined(__AVX512F__)
#include "training/lane_kernels_source.hpp"
#endif
