#include "network/batch_kernel_source.hpp"
