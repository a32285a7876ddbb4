# SPDX-License-Identifier: BSD-3-Clause
# Packages whose own CMake files are missing in Debian or ask for more than we use.

# OpenCV without libopencv-dev, which would bring its windows along.
add_library(sidestep_opencv INTERFACE)
find_path(OPENCV_INCLUDE opencv2/core.hpp PATHS /usr/include/opencv4 REQUIRED)
target_include_directories(sidestep_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE})
foreach(part core imgproc imgcodecs)
  find_library(OPENCV_${part} opencv_${part} REQUIRED)
  target_link_libraries(sidestep_opencv INTERFACE ${OPENCV_${part}})
endforeach()

# OMPL's list names boost's and ode's libraries too, which its headers do not need.
find_package(ompl REQUIRED)
list(FILTER OMPL_LIBRARIES INCLUDE REGEX "libompl")
add_library(sidestep_ompl INTERFACE)
target_include_directories(sidestep_ompl SYSTEM INTERFACE ${OMPL_INCLUDE_DIRS})
target_link_libraries(sidestep_ompl INTERFACE ${OMPL_LIBRARIES})
