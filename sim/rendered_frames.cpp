#include "sim/rendered_frames.hpp"

#include <utility>

namespace cosight::sim {

RenderedFrames::RenderedFrames(const Carrier& carrier, unsigned threads) : carrier_(carrier) {
  for (unsigned k = 0; k < threads; ++k)
    threads_.emplace_back([this](const std::stop_token& stop) { render(stop); });
}

RenderedFrames::~RenderedFrames() {
  for (std::jthread& thread : threads_)
    thread.request_stop();
}

void RenderedFrames::render(const std::stop_token& stop) {
  Film film = carrier_.film();
  std::unique_lock lock(mutex_);
  while (next_to_render_ < carrier_.ticks.size()) {
    const auto has_room = [this] { return next_to_render_ < next_to_take_ + kAhead; };
    if (!changed_.wait(lock, stop, has_room)) return;
    if (next_to_render_ >= carrier_.ticks.size()) return;
    const std::size_t frame = next_to_render_++;
    lock.unlock();
    ImageSample sample = carrier_.sample(film, frame);
    lock.lock();
    rendered_.emplace(frame, std::move(sample));
    changed_.notify_all();
  }
}

std::optional<Sample> RenderedFrames::next() {
  std::unique_lock lock(mutex_);
  if (next_to_take_ == carrier_.ticks.size()) return std::nullopt;
  changed_.wait(lock, [this] { return rendered_.contains(next_to_take_); });
  Sample sample = std::move(rendered_.extract(next_to_take_).mapped());
  ++next_to_take_;
  changed_.notify_all();
  return sample;
}

SourceCounters RenderedFrames::counters(SampleKind kind) const {
  SourceCounters counters;
  const std::lock_guard lock(mutex_);
  if (kind == SampleKind::kImage) counters.delivered = next_to_take_;
  return counters;
}

std::string RenderedFrames::description() const {
  return "rendered frames (" + std::to_string(carrier_.ticks.size()) + ")";
}

}  // namespace cosight::sim
