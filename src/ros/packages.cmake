# The packages of ROS, and what this package is to others in a catkin workspace. Included by CMakeLists.txt.

# The navigation stack does not come with every ROS 1 distribution (Debian's has none).
find_package(nav_core QUIET)
find_package(costmap_2d QUIET)
if(nav_core_FOUND AND costmap_2d_FOUND)
  set(LSTM_PLANNER_COMPAT OFF)
  set(LSTM_PLANNER_MOVE_BASE real)
  list(APPEND lstm_planner_catkin_packages costmap_2d nav_core)
  message(STATUS "nav_core found: the plugins are compiled against the navigation stack")
else()
  set(LSTM_PLANNER_COMPAT ON)
  set(LSTM_PLANNER_MOVE_BASE standalone)
  set(instead "the plugins are compiled against the package's own declarations of their interfaces, and "
    "standalone_move_base takes the place of move_base")
  if("$ENV{ROS_DISTRO}" MATCHES "^(noetic|one)$")
    message(WARNING "nav_core or costmap_2d not found: " ${instead} ". ROS has the real one. To use it: apt-get install "
                    "ros-$ENV{ROS_DISTRO}-move-base ros-$ENV{ROS_DISTRO}-nav-core ros-$ENV{ROS_DISTRO}-costmap-2d, and "
                    "configure again")
  else()
    message(STATUS "nav_core or costmap_2d not found: " ${instead})
  endif()
endif()

# A macro, as find_package() sets what others ask for.
macro(use_if_found package without_it)
  find_package(${package} QUIET)
  if(${package}_FOUND)
    list(APPEND lstm_planner_catkin_packages ${package})
  else()
    message(STATUS "${package} not found: ${without_it}")
  endif()
endmacro()
use_if_found(create_msgs "create2_stub leaves out the driver's topics of these types")
use_if_found(dynamic_reconfigure "parameters do not change while the robot drives")

# For the panel in rviz, with the Qt that rviz was built with: two of them in one process end it.
find_package(rviz QUIET)
string(REGEX MATCH "^[0-9]+" qt "${rviz_QT_VERSION}")
if(NOT qt)
  set(qt 5)
endif()
set(LSTM_PLANNER_PANEL OFF)
if(rviz_FOUND)
  find_package(Qt${qt} QUIET COMPONENTS Widgets)
  set(LSTM_PLANNER_PANEL ${Qt${qt}_FOUND})
endif()
if(NOT LSTM_PLANNER_PANEL)
  message(STATUS "rviz's headers (librviz-dev) or its Qt ${qt} (Qt 5: qtbase5-dev, Qt 6: qt6-base-dev) not found: "
                 "the panel for rviz is left out")
endif()

find_package(catkin REQUIRED COMPONENTS ${lstm_planner_catkin_packages})

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES ${library_targets}
  CATKIN_DEPENDS ${lstm_planner_catkin_packages}
  DEPENDS EIGEN3 OpenCV
)

# What the launch files start unless they are told otherwise.
set(move_base_default ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_SHARE_DESTINATION}/launch/includes/move_base_default.launch)
configure_file(launch/includes/move_base_${LSTM_PLANNER_MOVE_BASE}.launch ${move_base_default} COPYONLY)
