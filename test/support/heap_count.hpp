#pragma once

namespace lstm_planner {

/// What a thread has asked the heap for so far.
struct HeapCount {
  long allocations = 0;  ///< that it was asked for, enlarged ones too
  long live_bytes = 0;   ///< that have not been given back
};

/// Of this thread; counts everything: new, malloc and Eigen's own. heap_count.cpp replaces the C library's functions in
/// the executable that it is part of.
HeapCount heapCount();

/// Not with other C libraries than glibc, nor with a sanitizer, which brings its own malloc.
bool heapIsCounted();
constexpr char kHeapIsNotCounted[] = "allocations are counted with glibc and without sanitizers only";

}  // namespace lstm_planner
