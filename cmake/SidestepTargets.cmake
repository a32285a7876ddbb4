# SPDX-License-Identifier: BSD-3-Clause
# The two ways in which something is added: a module of the library, and a program.

# Warnings of our own code only; MRPT's and the other packages' headers come as SYSTEM.
add_library(sidestep_warnings INTERFACE)
target_compile_options(sidestep_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  -Wold-style-cast -Woverloaded-virtual -Wconversion -Wno-sign-conversion -Wdouble-promotion -Wformat=2
  $<$<BOOL:${SIDESTEP_WERROR}>:-Werror>)

# Headers of others that most files read, compiled once: half of the time of a build goes into reading them. Files must
# still include what they use; the clang builds, which go without, hold them to it.
option(SIDESTEP_PCH "Precompile the headers of MRPT, Eigen and the standard library" ON)
function(precompile_headers target)
  if(NOT SIDESTEP_PCH)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <cstdio> <deque> <filesystem> <fstream> <functional> <limits> <map> <memory>
    <numeric> <optional> <set> <span> <sstream> <string> <vector>
    <Eigen/Cholesky> <Eigen/LU>
    <mrpt/math/TPose2D.h> <mrpt/math/wrap2pi.h> <mrpt/poses/CPose2D.h> ${ARGN})
endfunction()

# add_module(NAME): all of libs/NAME becomes part of libsidestep.
function(add_module name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/libs/${name}/*.cpp)
  target_sources(sidestep PRIVATE ${sources})
endfunction()

# What the library needs and offers, in one place.
function(configure_library target)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
  add_library(sidestep::sidestep ALIAS ${target})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/libs> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/sidestep>)
  target_compile_definitions(${target} PRIVATE SIDESTEP_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target}
    PUBLIC mrpt::obs mrpt::maps mrpt::topography Eigen3::Eigen
    PRIVATE $<BUILD_INTERFACE:sidestep_warnings> yaml-cpp nlohmann_json::nlohmann_json ZLIB::ZLIB Threads::Threads
      $<BUILD_INTERFACE:sidestep_opencv> $<BUILD_INTERFACE:sidestep_ompl>)
  precompile_headers(${target})
endfunction()

# add_app(NAME): the program built from apps/NAME/*.cpp, installed beside the others.
function(add_app name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/apps/${name}/*.cpp ${PROJECT_SOURCE_DIR}/apps/common/*.cpp)
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/apps)
  target_compile_definitions(${name} PRIVATE SIDESTEP_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE sidestep sidestep_warnings CLI11::CLI11 nlohmann_json::nlohmann_json)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  set_property(GLOBAL APPEND PROPERTY SIDESTEP_APPS ${name})
endfunction()
