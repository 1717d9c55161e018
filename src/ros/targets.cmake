# Plugins, nodes and the panel. Included by CMakeLists.txt.

set(precompiled_ros ${precompiled_std} <geometry_msgs/PoseStamped.h> <geometry_msgs/Twist.h> <nav_msgs/Odometry.h>
  <pluginlib/class_loader.hpp> <ros/ros.h> <sensor_msgs/LaserScan.h> <std_srvs/Trigger.h>
  <tf2_geometry_msgs/tf2_geometry_msgs.h> <tf2_msgs/TFMessage.h> <tf2_ros/buffer.h>)

# The first target of a group parses the headers (ARGN), the others use the result: they are compiled with the same options.
# GCC warns of boost::function inside what it has parsed before, as it forgets that these are the system's headers; GCC 14
# with another of its warnings.
function(precompile_headers_once target group)
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,14>>:-Wno-uninitialized>)
  get_property(first_of_group GLOBAL PROPERTY lstm_planner_first_of_${group})
  if(first_of_group)
    target_precompile_headers(${target} REUSE_FROM ${first_of_group})
  else()
    set_property(GLOBAL PROPERTY lstm_planner_first_of_${group} ${target})
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

set(ros_libraries)

# Everything that sees ROS: its headers, and what stands in for those it lacks.
add_library(lstm_planner_ros_interface INTERFACE)
target_include_directories(lstm_planner_ros_interface SYSTEM INTERFACE ${catkin_INCLUDE_DIRS})
target_link_libraries(lstm_planner_ros_interface INTERFACE lstm_planner_drive ${catkin_LIBRARIES})
if(dynamic_reconfigure_FOUND)
  target_compile_definitions(lstm_planner_ros_interface INTERFACE LSTM_PLANNER_HAVE_DYNAMIC_RECONFIGURE)
endif()
if(create_msgs_FOUND)
  target_compile_definitions(lstm_planner_ros_interface INTERFACE LSTM_PLANNER_HAVE_CREATE_MSGS)
endif()
if(LSTM_PLANNER_COMPAT)
  file(GLOB compat_sources CONFIGURE_DEPENDS src/compat/*.cpp)
  add_library(lstm_planner_compat ${compat_sources})
  target_include_directories(lstm_planner_compat BEFORE PUBLIC include/lstm_planner/compat)
  target_include_directories(lstm_planner_compat SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
  target_link_libraries(lstm_planner_compat PRIVATE ${catkin_LIBRARIES})
  target_link_libraries(lstm_planner_ros_interface INTERFACE lstm_planner_compat)
  list(APPEND ros_libraries lstm_planner_compat)
endif()

# A node NAME is src/ros/ROOM/NAME.cpp with the NAME_*.cpp beside it that only it needs. The rest of common, planner and
# controller is the plugin library, the rest of the other rooms is for nodes and the tool. A node that loads plugins must
# not be linked with them, hence --as-needed. The first one parses the headers for all of them: one that the demo needs.
set(node_names create2_stub bag_replay dataset_recorder demo_runner drive_advice scripted_teleoperator)
file(GLOB ros_sources CONFIGURE_DEPENDS src/ros/*/*.cpp)
list(FILTER ros_sources EXCLUDE REGEX "/ros/panel/")
if(LSTM_PLANNER_COMPAT)
  list(APPEND node_names standalone_move_base)
else()
  list(FILTER ros_sources EXCLUDE REGEX "/ros/move_base/")
endif()
set(shared_sources ${ros_sources})
foreach(node_name IN LISTS node_names)
  set(sources_of_${node_name} ${ros_sources})
  list(FILTER sources_of_${node_name} INCLUDE REGEX "/${node_name}[^/]*$")
  list(FILTER shared_sources EXCLUDE REGEX "/${node_name}[^/]*$")
endforeach()
list(APPEND sources_of_standalone_move_base
  src/ros/common/parameter_reader.cpp src/ros/common/parameter_value.cpp src/ros/common/transform_listener.cpp)

set(plugin_sources ${shared_sources})
list(FILTER plugin_sources INCLUDE REGEX "/ros/(common|planner|controller)/")
set(recording_sources ${shared_sources})
list(REMOVE_ITEM recording_sources ${plugin_sources})
add_library(lstm_planner_plugins ${plugin_sources})
target_link_libraries(lstm_planner_plugins PUBLIC lstm_planner_ros_interface)
# Drives in bags, and what is shown of them.
add_library(lstm_planner_recordings ${recording_sources})
target_link_libraries(lstm_planner_recordings PUBLIC lstm_planner_plugins lstm_planner_practice)
foreach(target IN ITEMS lstm_planner_plugins lstm_planner_recordings)
  add_headers(${target} ros)
  set_target_properties(${target} PROPERTIES DEFINE_SYMBOL lstm_planner_EXPORTS)
  precompile_headers_once(${target} plugins ${precompiled_ros})
  list(APPEND ros_libraries ${target})
endforeach()

function(add_node node_name)
  add_executable(${node_name} ${ARGN})
  add_headers(${node_name} ros)
  precompile_headers_once(${node_name} nodes ${precompiled_ros})
  # Its work is done in the libraries: optimised like them, it would take longer to build and no less to run.
  target_compile_options(${node_name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(${node_name} PRIVATE -Wl,--as-needed ${libraries_of_${node_name}} lstm_planner_plugins
    lstm_planner_ros_interface Threads::Threads)
  install(TARGETS ${node_name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()
set(libraries_of_create2_stub lstm_planner_simulation)
set(libraries_of_demo_runner lstm_planner_simulation)
foreach(node_name IN ITEMS bag_replay dataset_recorder drive_advice scripted_teleoperator)
  set(libraries_of_${node_name} lstm_planner_recordings)
endforeach()
foreach(node_name IN LISTS node_names)
  add_node(${node_name} ${sources_of_${node_name}})
endforeach()

# The panel in rviz. Not linked with the plugins: rviz would load them, too.
if(LSTM_PLANNER_PANEL)
  file(GLOB panel_sources CONFIGURE_DEPENDS src/ros/panel/*.cpp)
  add_library(lstm_planner_panel ${panel_sources})
  target_compile_definitions(lstm_planner_panel PRIVATE QT_NO_KEYWORDS)
  target_include_directories(lstm_planner_panel PRIVATE src)
  target_include_directories(lstm_planner_panel SYSTEM PUBLIC ${rviz_INCLUDE_DIRS} ${catkin_INCLUDE_DIRS})
  target_link_libraries(lstm_planner_panel PUBLIC ${rviz_LIBRARIES} ${catkin_LIBRARIES} Qt${qt}::Widgets Threads::Threads)
  list(APPEND ros_libraries lstm_planner_panel)
endif()

# What launch/demo.sh needs.
add_custom_target(lstm_planner_demo)
add_dependencies(lstm_planner_demo create2_stub demo_runner)
foreach(target IN ITEMS lstm_planner_plugins lstm_planner_panel standalone_move_base)
  if(TARGET ${target})
    add_dependencies(lstm_planner_demo ${target})
  endif()
endforeach()

install(TARGETS ${ros_libraries}
  ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
  RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION}
)
install(DIRECTORY include/${PROJECT_NAME}/ros DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
if(LSTM_PLANNER_COMPAT)
  install(DIRECTORY include/${PROJECT_NAME}/compat DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION})
endif()
install(DIRECTORY launch DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}
  PATTERN "*.sh" EXCLUDE PATTERN Dockerfile EXCLUDE)
install(FILES launch/includes/move_base_${LSTM_PLANNER_MOVE_BASE}.launch
  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/launch/includes RENAME move_base_default.launch)
