#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "shared/dataset/stamp.hpp"

namespace cosight {

/// What the robot's frames.csv says of one frame, as far as evaluation needs it.
struct FrameRecord {
  Stamp stamp = 0;
  bool pseudo_stereo = false;  ///< the worn camera's view was fused or started a landmark
  bool lost = false;
  double landmarks = 0.0;
  double total_ms = 0.0;          ///< wall time of the frame
  double pseudo_stereo_ms = 0.0;  ///< of it, what the worn camera cost: overlap prediction included
};

/// Reads frames.csv. Columns: stamp_ns, fused, initialised, landmarks, tracking, total_ms, overlap_ms,
/// pseudo_stereo_ms; one that is missing leaves its field as it is, but stamp_ns must be there.
/// Throws EvaluationError.
std::vector<FrameRecord> read_frame_log(const std::filesystem::path& path);

}  // namespace cosight
