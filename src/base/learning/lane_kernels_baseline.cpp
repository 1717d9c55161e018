#include "base/learning/lane_kernels_source.hpp"
