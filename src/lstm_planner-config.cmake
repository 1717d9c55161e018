include(CMakeFindDependencyMacro)
find_dependency(Eigen3)
find_dependency(nlohmann_json)
include(${CMAKE_CURRENT_LIST_DIR}/lstm_planner-targets.cmake)
