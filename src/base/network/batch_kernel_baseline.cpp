#include "base/network/batch_kernel_source.hpp"
