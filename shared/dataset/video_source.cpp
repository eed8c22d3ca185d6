#include "shared/dataset/video_source.hpp"

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "shared/dataset/dataset_error.hpp"

namespace cosight {

class VideoSource::Decoder {
 public:
  explicit Decoder(const std::filesystem::path& file) {
    if (!std::filesystem::is_regular_file(file)) {
      throw DatasetError(file.string() + ": no such video file; check the path");
    }
    if (!capture_.open(file.string(), cv::CAP_FFMPEG)) {
      throw DatasetError(file.string() + ": is no video that FFmpeg can read");
    }
  }

  bool read(GrayImage& image) {
    if (!capture_.read(frame_) || frame_.empty()) return false;
    image.width = frame_.cols;
    image.height = frame_.rows;
    image.data.resize(frame_.total());
    cv::Mat gray(frame_.rows, frame_.cols, CV_8UC1, image.data.data());
    if (frame_.channels() == 1) {
      frame_.copyTo(gray);
    } else {
      cv::cvtColor(frame_, gray, cv::COLOR_BGR2GRAY);
    }
    return true;
  }

  /// Of the frame read last [s]; zero when the container has no stamps.
  double time() const { return capture_.get(cv::CAP_PROP_POS_MSEC) * 1e-3; }
  double rate_hz() const { return capture_.get(cv::CAP_PROP_FPS); }

 private:
  cv::VideoCapture capture_;
  cv::Mat frame_;
};

VideoSource::VideoSource(const std::filesystem::path& file, double rate_hz, const FrameOutput& output)
    : decoder_(std::make_unique<Decoder>(file)), encoder_(output), file_(file), rate_hz_(rate_hz) {
  if (rate_hz_ == 0.0 && !(decoder_->rate_hz() > 0.0)) {
    throw DatasetError(file.string() + ": says no frame rate; give input.rate_hz");
  }
}

VideoSource::~VideoSource() = default;

std::optional<Sample> VideoSource::next() {
  while (decoder_->read(pixels_)) {
    const std::uint64_t index = index_++;
    double time = rate_hz_ > 0.0 ? static_cast<double>(index) / rate_hz_ : decoder_->time();
    if (index > 0 && !(time > 0.0)) time = static_cast<double>(index) / decoder_->rate_hz();
    ImageSample sample;
    sample.stamp = from_seconds(time);
    sample.sequence = index;
    if (last_ && sample.stamp <= *last_) {
      ++counters_.stamp_went_back;
    } else if (encoder_.encode(pixels_, sample) != DecodeOutcome::kDecoded) {
      ++counters_.wrong_size;
    } else {
      last_ = sample.stamp;
      ++counters_.delivered;
      return sample;
    }
  }
  return std::nullopt;
}

SourceCounters VideoSource::counters(SampleKind kind) const {
  return kind == SampleKind::kImage ? counters_ : SourceCounters{};
}

std::string VideoSource::description() const {
  return "video " + file_.string();
}

}  // namespace cosight
