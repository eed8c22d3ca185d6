#include "shared/dataset/v4l2_device.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <system_error>

#include "shared/dataset/dataset_error.hpp"

namespace cosight {
namespace {

std::string reason() {
  return std::generic_category().message(errno);
}

}  // namespace

V4l2Source::Device::Device(const V4l2Options& options) : name_(options.device.string()) {
  file_ = ::open(name_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (file_ < 0) {
    throw DatasetError(name_ + ": can't be opened (" + reason() +
                       "); is the camera plugged in, and are you in the group video?");
  }
  using std::chrono::nanoseconds;
  monotonic_to_epoch_ = nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count() -
                        nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  try {
    check_capabilities();
    choose_format(options);
    map_buffers();
  } catch (const DatasetError&) {
    close_device();
    throw;
  }
}

V4l2Source::Device::~Device() {
  close_device();
}

void V4l2Source::Device::close_device() {
  for (const auto& buffer : buffers_)
    ::munmap(buffer.data(), buffer.size());
  buffers_.clear();
  ::close(file_);  // also stops the stream
}

void V4l2Source::Device::fail(const std::string& sentence) const {
  throw DatasetError(name_ + ": " + sentence);
}

int V4l2Source::Device::control(unsigned long request, void* argument) const {
  int result = -1;
  do {
    result = ::ioctl(file_, request, argument);
  } while (result < 0 && errno == EINTR);
  return result;
}

void V4l2Source::Device::check_capabilities() const {
  v4l2_capability capability{};
  if (control(VIDIOC_QUERYCAP, &capability) < 0)
    fail("is no V4L2 camera; list them with v4l2-ctl --list-devices");
  const std::uint32_t can = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0 ? capability.device_caps
                                                                                  : capability.capabilities;
  if ((can & V4L2_CAP_VIDEO_CAPTURE) == 0 || (can & V4L2_CAP_STREAMING) == 0) {
    fail("can't stream video; the camera's other /dev/video number may");
  }
}

void V4l2Source::Device::choose_format(const V4l2Options& options) {
  constexpr std::array kKnown = {V4L2_PIX_FMT_MJPEG, V4L2_PIX_FMT_GREY, V4L2_PIX_FMT_YUYV};
  for (const std::uint32_t wanted : kKnown) {
    format_ = {};
    format_.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    format_.fmt.pix.width = static_cast<std::uint32_t>(options.width);
    format_.fmt.pix.height = static_cast<std::uint32_t>(options.height);
    format_.fmt.pix.pixelformat = wanted;
    format_.fmt.pix.field = V4L2_FIELD_NONE;
    if (control(VIDIOC_S_FMT, &format_) == 0 && pixel_format() == wanted && width() == options.width &&
        height() == options.height) {
      v4l2_streamparm rate{};
      rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
      rate.parm.capture.timeperframe = {1000, static_cast<std::uint32_t>(options.rate_hz * 1000.0)};
      control(VIDIOC_S_PARM, &rate);  // a camera that can't keeps its own rate: stamps tell
      return;
    }
  }
  fail("offers neither MJPEG nor GREY nor YUYV at " + std::to_string(options.width) + "x" +
       std::to_string(options.height) + "; see v4l2-ctl --list-formats-ext");
}

void V4l2Source::Device::map_buffers() {
  v4l2_requestbuffers request{};
  request.count = 4;
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (control(VIDIOC_REQBUFS, &request) < 0)
    fail("gives no buffers (" + reason() + "); does another program use it?");
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.index = i;
    if (control(VIDIOC_QUERYBUF, &buffer) < 0) fail("lost a buffer: " + reason());
    void* const memory = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, file_,
                                static_cast<off_t>(buffer.m.offset));
    if (memory == MAP_FAILED) fail("can't map its buffers: " + reason());
    buffers_.emplace_back(static_cast<std::uint8_t*>(memory), buffer.length);
    if (control(VIDIOC_QBUF, &buffer) < 0) fail("refuses a buffer: " + reason());
  }
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (control(VIDIOC_STREAMON, &type) < 0)
    fail("does not start (" + reason() + "); does another program use it?");
}

bool V4l2Source::Device::read(const std::atomic<bool>& stop, const std::function<void(const Frame&)>& show) {
  constexpr int kSliceMs = 50;
  while (!stop) {
    pollfd waiting{file_, POLLIN, 0};
    if (::poll(&waiting, 1, kSliceMs) <= 0) continue;
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    buffer.memory = V4L2_MEMORY_MMAP;
    if (control(VIDIOC_DQBUF, &buffer) < 0) {
      if (errno == EAGAIN) continue;
      return false;  // unplugged
    }
    const Stamp stamp = buffer.timestamp.tv_sec * kNanosecondsPerSecond + buffer.timestamp.tv_usec * 1000;
    const bool monotonic = (buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
    const auto memory = buffers_[buffer.index];
    show({.bytes = memory.first(std::min<std::size_t>(buffer.bytesused, memory.size())),
          .stamp = stamp + (monotonic ? monotonic_to_epoch_ : 0),
          .sequence = buffer.sequence,
          .damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0});
    return control(VIDIOC_QBUF, &buffer) == 0;
  }
  return false;
}

}  // namespace cosight
