// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/serialization/CSerializable.h>

#include <memory>
#include <string>
#include <vector>

namespace mrpt::obs {
class CActionCollection;
}

namespace sidestep {

/// Turns the objects of a log, whichever of the two layouts it has, into observations.
///
/// In the action / sensory-frame layout an action and the frame after it belong together: the odometry increment led to
/// where the frame was sensed. Increments become absolute odometry from (0, 0, 0) on, at the stamp of that frame: an
/// action's own stamp, in MRPT's logs, lies half-way between the two frames and serves only if its frame has none.
/// Velocities and encoder ticks of actions are left out: old logs hold them uninitialised. An observation without stamp
/// takes the first valid one of its frame.
class FrameUnpacker {
 public:
  using Observations = std::vector<std::shared_ptr<mrpt::obs::CObservation>>;
  /// What comes out with this object; something that is neither observation, action nor frame gives nothing.
  Observations push(const mrpt::serialization::CSerializable::Ptr& object);
  /// The odometry of an action at the end of the log whose frame never came.
  Observations flush();
  /// Whether a frame or an action was seen.
  bool isFrameLayout() const { return frames_; }

 private:
  void takeAction(const mrpt::obs::CActionCollection& actions, Observations& out);
  void takeFrame(mrpt::obs::CSensoryFrame& frame, Observations& out);
  void releaseOdometry(double frame_s, Observations& out);

  bool frames_ = false;
  bool odometry_waits_ = false;
  double action_s_ = 0;  ///< stamp of the waiting action; <= 0 if it has none
  mrpt::poses::CPose2D odometry_;
};

/// Unix time of a stamp; <= 0 if it is none.
double stampSeconds(const mrpt::obs::CObservation& observation);

}  // namespace sidestep
