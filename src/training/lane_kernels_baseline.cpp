#include "training/lane_kernels_source.hpp"
