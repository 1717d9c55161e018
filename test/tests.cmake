# Tests, benchmarks and fuzzers. Included by CMakeLists.txt.

if(CATKIN_ENABLE_TESTING)
  # The workspace usually holds a symbolic link to the checkout; tests look for data beside the checkout itself.
  get_filename_component(real_source_dir ${CMAKE_CURRENT_SOURCE_DIR} REALPATH)
  # Optimised like what they test, the tests would take longer to build and no less to run.
  set(test_options $<$<CONFIG:Release>:-O1>)

  file(GLOB fuzz_harnesses CONFIGURE_DEPENDS test/fuzz/harnesses/*.cpp)
  file(GLOB_RECURSE unit_test_sources CONFIGURE_DEPENDS test/unit/*.cpp)
  if(unit_test_sources)
    # What the panel shows is prepared without rviz and Qt, and what a recipe says without the rest of the tool.
    list(APPEND unit_test_sources src/ros/panel/drive_view.cpp src/tools/recipe.cpp src/tools/shared_file.cpp
      test/support/heap_count.cpp test/bench/recorded_steps.cpp ${fuzz_harnesses}
      test/fuzz/harness.cpp test/fuzz/test_corpus.cpp)
    catkin_add_gtest(lstm_planner_unit_tests ${unit_test_sources})
    target_include_directories(lstm_planner_unit_tests PRIVATE src test)
    target_include_directories(lstm_planner_unit_tests SYSTEM PRIVATE
      ${CMAKE_CURRENT_BINARY_DIR} ${Protobuf_INCLUDE_DIRS})
    target_compile_options(lstm_planner_unit_tests PRIVATE ${test_options})
    target_precompile_headers(lstm_planner_unit_tests PRIVATE
      ${precompiled_std} <fstream> <random> <Eigen/Core> <gtest/gtest.h>)
    target_compile_definitions(lstm_planner_unit_tests PRIVATE
      LSTM_PLANNER_SOURCE_DIR="${real_source_dir}" LSTM_PLANNER_TOOL="$<TARGET_FILE:lstm_planner>")
    add_dependencies(lstm_planner_unit_tests lstm_planner)
    target_link_libraries(lstm_planner_unit_tests
      lstm_planner_practice lstm_planner_grid_world ${OpenCV_LIBS} ${Protobuf_LIBRARIES} Poco::DataSQLite Poco::Data Poco::Foundation
      SQLite::SQLite3 Threads::Threads gtest_main yaml-cpp)
    if(TARGET lstm_planner_recordings)
      target_link_libraries(lstm_planner_unit_tests lstm_planner_recordings)  # the harness bag
    endif()
  endif()

  # test/ros/NAME.test is a rostest. Its test node is test/ros/NAME.cpp, where there is one; several .test files may share
  # the test node of another, or run a script. All test nodes are one program, with what they share (fixtures): each of
  # its own would take 12 s to compile and link.
  find_package(rostest REQUIRED)
  file(GLOB ros_test_sources CONFIGURE_DEPENDS test/ros/*.cpp test/ros/fixtures/*.cpp)
  file(GLOB ros_test_files CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} test/ros/*.test)
  catkin_add_executable_with_gtest(ros_tests ${ros_test_sources} EXCLUDE_FROM_ALL)
  target_include_directories(ros_tests PRIVATE src test)
  # They mostly wait.
  target_compile_options(ros_tests PRIVATE $<$<CONFIG:Release>:-O0>)
  target_precompile_headers(ros_tests PRIVATE ${precompiled_ros} <gtest/gtest.h>)
  target_compile_definitions(ros_tests PRIVATE LSTM_PLANNER_SOURCE_DIR="${real_source_dir}")
  if(TARGET lstm_planner_recordings)
    target_link_libraries(ros_tests lstm_planner_recordings)
  endif()
  target_link_libraries(ros_tests lstm_planner_ros_interface ${OpenCV_LIBS} Threads::Threads)
  # For test/bench/node_cost.py: who merely receives what move_base does.
  add_executable(message_receiver EXCLUDE_FROM_ALL test/bench/nodes/message_receiver.cpp)
  target_link_libraries(message_receiver PRIVATE lstm_planner_ros_interface)
  set(ros_test_executables ros_tests message_receiver)
  foreach(ros_test_file IN LISTS ros_test_files)
    add_rostest(${ros_test_file} DEPENDENCIES ros_tests ${node_names} lstm_planner)
  endforeach()
  # ctest begins with what takes longest. By the computer's clock nothing else may run beside.
  foreach(name IN ITEMS learning_from_people restarts closed_loop bad_days real_map)
    set_tests_properties(_ctest_lstm_planner_rostest_test_ros_${name}.test PROPERTIES COST 100)
  endforeach()
  foreach(name IN ITEMS create2_stub_computer_clock two_machines two_robots)
    set_tests_properties(_ctest_lstm_planner_rostest_test_ros_${name}.test PROPERTIES RUN_SERIAL ON)
  endforeach()
  if(TARGET lstm_planner_panel)
    catkin_add_executable_with_gtest(rviz_panel test/ros/panel/rviz_panel.cpp EXCLUDE_FROM_ALL)
    target_compile_options(rviz_panel PRIVATE $<$<CONFIG:Release>:-O0>)
    target_compile_definitions(rviz_panel PRIVATE QT_NO_KEYWORDS)
    target_include_directories(rviz_panel PRIVATE test)
    target_include_directories(rviz_panel SYSTEM PRIVATE ${rviz_INCLUDE_DIRS} ${catkin_INCLUDE_DIRS})
    target_link_libraries(rviz_panel ${rviz_LIBRARIES} ${catkin_LIBRARIES} Qt${qt}::Widgets Threads::Threads)
    list(APPEND ros_test_executables rviz_panel)
    add_rostest(test/ros/panel/rviz_panel.test DEPENDENCIES rviz_panel lstm_planner_panel)
  endif()
  if(TARGET tests AND ros_test_executables)
    add_dependencies(tests ${ros_test_executables})
  endif()

  add_executable(lstm_planner_foresight EXCLUDE_FROM_ALL test/bench/foresight/foresight.cpp)
  target_link_libraries(lstm_planner_foresight PRIVATE lstm_planner_simulation)

  # 1.5 (Debian 11, Ubuntu 20.04) has neither Benchmark::Name nor kSecond.
  find_package(benchmark 1.6 QUIET)
  if(benchmark_FOUND)
    file(GLOB bench_sources CONFIGURE_DEPENDS test/bench/*.cpp)
    add_executable(lstm_planner_bench ${bench_sources})
    target_include_directories(lstm_planner_bench PRIVATE src)
    target_compile_definitions(lstm_planner_bench PRIVATE LSTM_PLANNER_SOURCE_DIR="${CMAKE_CURRENT_SOURCE_DIR}")
    target_link_libraries(lstm_planner_bench PRIVATE lstm_planner_practice lstm_planner_grid_world benchmark::benchmark_main)
  else()
    if(benchmark_CONSIDERED_VERSIONS)
      list(REMOVE_DUPLICATES benchmark_CONSIDERED_VERSIONS)
      set(benchmark_instead ", only ${benchmark_CONSIDERED_VERSIONS}")
    endif()
    message(STATUS "no Google Benchmark >= 1.6 found${benchmark_instead}: lstm_planner_bench is not built")
  endif()

  # The same in the navigation stack's own move_base, beside its own planners.
  set(missing_stack_packages)
  foreach(stack_package IN ITEMS move_base navfn global_planner base_local_planner dwa_local_planner rotate_recovery
                                 clear_costmap_recovery)
    find_package(${stack_package} QUIET)
    if(NOT ${stack_package}_FOUND)
      list(APPEND missing_stack_packages ${stack_package})
    endif()
  endforeach()
  if(missing_stack_packages OR LSTM_PLANNER_COMPAT)
    string(REPLACE ";" ", " missing_stack_packages "${missing_stack_packages}")
    message(STATUS "navigation stack incomplete (no ${missing_stack_packages}): test/ros/navigation_stack is left out")
  else()
    add_subdirectory(test/ros/navigation_stack)
  endif()
endif()

# -------------------------------------------------------------------- fuzzers

# Each test/fuzz/harnesses/NAME.cpp is the fuzzer fuzz_NAME; `make fuzzers` builds them all.
if(LSTM_PLANNER_FUZZERS)
  add_custom_target(fuzzers)
  file(GLOB fuzz_harnesses CONFIGURE_DEPENDS test/fuzz/harnesses/*.cpp)
  function(add_fuzzer fuzzer harness)
    add_executable(${fuzzer} EXCLUDE_FROM_ALL ${harness} test/fuzz/harness.cpp test/fuzz/libfuzzer_entry.cpp)
    target_include_directories(${fuzzer} PRIVATE src test)
    target_include_directories(${fuzzer} SYSTEM PRIVATE ${CMAKE_CURRENT_BINARY_DIR} ${Protobuf_INCLUDE_DIRS})
    target_link_options(${fuzzer} PRIVATE -fsanitize=fuzzer)
    target_link_libraries(${fuzzer} PRIVATE lstm_planner_practice lstm_planner_grid_world ${OpenCV_LIBS}
      ${Protobuf_LIBRARIES} Poco::DataSQLite Poco::Data Poco::Foundation SQLite::SQLite3 Threads::Threads yaml-cpp)
    if(fuzzer STREQUAL fuzz_bag)
      target_link_libraries(${fuzzer} PRIVATE lstm_planner_recordings)
    endif()
    add_dependencies(fuzzers ${fuzzer})
  endfunction()
  foreach(harness IN LISTS fuzz_harnesses)
    get_filename_component(fuzzer ${harness} NAME_WE)
    add_fuzzer(fuzz_${fuzzer} ${harness})
  endforeach()
endif()
