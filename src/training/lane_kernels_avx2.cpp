#if defined(__AVX2__)
#include "training/lane_kernels_source.hpp"
#endif
