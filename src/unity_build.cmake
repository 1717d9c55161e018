# Several sources of a target are compiled as one. launch/environment.sh has it included after project(lstm_planner), so
# that other packages of the workspace are compiled as they ask for.
set(CMAKE_UNITY_BUILD ON)
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
# GCC takes a source for a header when another one includes it, and warns of members whose type is in an anonymous
# namespace. It also inlines across sources, and then takes initialised values for uninitialised ones.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage> $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
