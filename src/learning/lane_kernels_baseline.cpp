#include "lane_kernels_source.hpp"
