# SPDX-License-Identifier: BSD-3-Clause
# Headers that are installed: what somebody needs to read and write logs, localize, and plan, and nothing else. A test
# (tests/contracts/install_test.cpp) installs them into an empty folder and compiles each against those alone.
set(public_headers
  # what a user includes
  core/errors.h core/geometry.h core/kinematics.h core/obstacles.h core/params.h core/reading.h core/robot_limits.h
  datasets/ground_truth.h datasets/log_reader.h datasets/log_writer.h
  maps/distance_field.h maps/grid_map.h maps/map_file.h
  localization/configuration.h localization/localizer.h localization/pose_filter.h localization/smoother.h
  planning/local_planner.h planning/planners.h planning/global/global_planner.h planning/global/global_planners.h
  planning/global/planning_grid.h
  # what those include
  core/param_sections.h
  localization/filters/filters.h localization/measurement.h localization/motion.h localization/motion_source.h
  localization/sensors/imu.h localization/sensors/odometry_model.h localization/sensors/sensor_model.h
  localization/sensors/sensors.h localization/start_alignment.h
  planning/global/bucket_queue.h planning/global/grid_search.h planning/global/sampling_planner.h)
