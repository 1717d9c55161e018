#include "batch_kernel_source.hpp"
