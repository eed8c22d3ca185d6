#pragma once

#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "shared/dataset/sample_source.hpp"
#include "sim/simulated_run.hpp"

namespace cosight::sim {

/// The frames of one camera, rendered ahead of whoever takes them by threads of their own. The same frames
/// with any number of threads.
class RenderedFrames : public SampleSource {
 public:
  static constexpr std::size_t kAhead = 40;  ///< frames that may wait to be taken

  /// `carrier` has to outlive this.
  RenderedFrames(const Carrier& carrier, unsigned threads);
  ~RenderedFrames() override;

  /// Waits for the renderer when it is behind.
  std::optional<Sample> next() override;

  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override;

 private:
  void render(const std::stop_token& stop);

  const Carrier& carrier_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::size_t next_to_render_ = 0;
  std::size_t next_to_take_ = 0;
  std::map<std::size_t, ImageSample> rendered_;
  std::vector<std::jthread> threads_;  ///< last: they stop first
};

}  // namespace cosight::sim
