#include "robot_agent/vision/descriptor.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "robot_agent/vision/opencv_view.hpp"
#include "robot_agent/vision/surf.hpp"

namespace cosight::vision {
namespace {

/// The smallest box around given pixels.
ConvexPolygon around(const std::vector<Eigen::Vector2d>& pixels) {
  if (pixels.empty()) return {};
  const Rectangle box = bounding_box(pixels);
  return {box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}};
}

/// Angle of the intensity's centroid within a disk, as ORB defines orientation [rad].
double centroid_angle(const GrayImage& image, const Eigen::Vector2d& pixel, int radius) {
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  int moment_x = 0;
  int moment_y = 0;
  for (int v = -radius; v <= radius; ++v) {
    const std::uint8_t* row = image.row(std::clamp(y + v, 0, image.height - 1));
    const int reach = static_cast<int>(std::sqrt(radius * radius - v * v));
    for (int u = -reach; u <= reach; ++u) {
      const int gray = row[std::clamp(x + u, 0, image.width - 1)];
      moment_x += u * gray;
      moment_y += v * gray;
    }
  }
  return std::atan2(moment_y, moment_x);
}

/// 255 inside the region.
cv::Mat region_mask(const ConvexPolygon& roi, const PixelBox& box) {
  std::vector<cv::Point> corners;
  for (const Eigen::Vector2d& corner : roi) {
    corners.emplace_back(static_cast<int>(std::lround(corner.x())) - box.left,
                         static_cast<int>(std::lround(corner.y())) - box.top);
  }
  cv::Mat mask = cv::Mat::zeros(box.height, box.width, CV_8UC1);
  cv::fillConvexPoly(mask, corners, cv::Scalar(255));
  return mask;
}

void keep_strongest_inside(std::vector<cv::KeyPoint>& keypoints, const ConvexPolygon& roi,
                           const PixelBox& box, int max_features) {
  std::erase_if(keypoints, [&](const cv::KeyPoint& keypoint) {
    const cv::Point2f& p = keypoint.pt;
    return !contains(roi, Eigen::Vector2d(box.left, box.top) + Eigen::Vector2d(p.x, p.y));
  });
  std::stable_sort(keypoints.begin(), keypoints.end(),
                   [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
  if (keypoints.size() > static_cast<std::size_t>(max_features)) {
    keypoints.resize(static_cast<std::size_t>(max_features));
  }
}

/// ORB and SIFT, as OpenCV has them.
class OpencvExtractor final : public DescriptorExtractor {
 public:
  OpencvExtractor(DescriptorKind kind, cv::Ptr<cv::ORB> orb, cv::Ptr<cv::SIFT> sift)
      : kind_(kind), orb_(std::move(orb)), sift_(std::move(sift)) {}

  DescribedFeatures detect_and_describe(const GrayImage& image, const ConvexPolygon& roi,
                                        int max_features) override {
    const PixelBox box = pixel_box(roi, kMargin, image);
    if (box.empty() || max_features <= 0) return {};
    const cv::Mat part = opencv_view(image)(cv::Rect(box.left, box.top, box.width, box.height));
    std::vector<cv::KeyPoint> keypoints;
    cv::Mat descriptors;
    if (kind_ == DescriptorKind::kOrb) {
      // ORB counts its features inside the mask, so that one pass over one pyramid is enough.
      orb_->setMaxFeatures(max_features);
      orb_->detectAndCompute(part, region_mask(roi, box), keypoints, descriptors);
    } else {
      sift_->detect(part, keypoints);
      keep_strongest_inside(keypoints, roi, box, max_features);
      if (!keypoints.empty()) sift_->compute(part, keypoints, descriptors);
    }
    DescribedFeatures described = gather(box, keypoints, descriptors);
    for (std::size_t i = 0; i < described.size(); ++i)
      described.sources[i] = i;
    return described;
  }

  DescribedFeatures describe(const GrayImage& image, const std::vector<Eigen::Vector2d>& pixels) override {
    const PixelBox box = pixel_box(around(pixels), kMargin, image);
    if (box.empty()) return {};
    std::vector<cv::KeyPoint> keypoints;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Eigen::Vector2d& pixel = pixels[i];
      if (!(pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= image.width - 1.0 &&
            pixel.y() <= image.height - 1.0)) {
        continue;
      }
      double degrees = centroid_angle(image, pixel, 15) * 180.0 / std::numbers::pi;
      if (degrees < 0.0) degrees += 360.0;
      const float size = kind_ == DescriptorKind::kOrb ? 31.0F : 8.0F;
      keypoints.emplace_back(static_cast<float>(pixel.x() - box.left),
                             static_cast<float>(pixel.y() - box.top), size, static_cast<float>(degrees), 0.0F,
                             0, static_cast<int>(i));
    }
    const cv::Mat part = opencv_view(image)(cv::Rect(box.left, box.top, box.width, box.height));
    cv::Mat descriptors;
    if (keypoints.empty()) return {};
    if (kind_ == DescriptorKind::kOrb) {
      orb_->compute(part, keypoints, descriptors);
    } else {
      sift_->compute(part, keypoints, descriptors);
    }
    return gather(box, keypoints, descriptors);
  }

 private:
  static constexpr int kMargin = 32;  // [px] what ORB's patch needs around a point

  static DescribedFeatures gather(const PixelBox& box, const std::vector<cv::KeyPoint>& keypoints,
                                  const cv::Mat& descriptors) {
    DescribedFeatures described;
    for (const cv::KeyPoint& keypoint : keypoints) {
      described.pixels.emplace_back(Eigen::Vector2d(box.left, box.top) +
                                    Eigen::Vector2d(keypoint.pt.x, keypoint.pt.y));
      described.sources.push_back(static_cast<std::size_t>(keypoint.class_id));
    }
    if (descriptors.empty()) return described;
    if (descriptors.type() == CV_8U) {
      described.bits.resize(keypoints.size());
      for (int i = 0; i < descriptors.rows; ++i) {
        std::memcpy(described.bits[static_cast<std::size_t>(i)].data(), descriptors.ptr(i),
                    sizeof(BitDescriptor));
      }
    } else {
      described.vectors =
          Eigen::Map<const VectorDescriptors>(descriptors.ptr<float>(), descriptors.rows, descriptors.cols);
      described.vectors.rowwise().normalize();
    }
    return described;
  }

  DescriptorKind kind_;
  cv::Ptr<cv::ORB> orb_;
  cv::Ptr<cv::SIFT> sift_;
};

class SurfExtractor final : public DescriptorExtractor {
 public:
  DescribedFeatures detect_and_describe(const GrayImage& image, const ConvexPolygon& roi,
                                        int max_features) override {
    const PixelBox box = pixel_box(roi, kMargin, image);
    if (box.empty()) return {};
    const Eigen::Vector2d origin(box.left, box.top);
    integral_.build(image, box.left, box.top, box.width, box.height);
    points_.clear();
    for (const SurfPoint& point : surf_.detect(integral_)) {
      if (static_cast<int>(points_.size()) >= max_features) break;
      if (contains(roi, origin + point.pixel)) points_.push_back(point);
    }
    DescribedFeatures described = describe_points(origin);
    for (std::size_t i = 0; i < points_.size(); ++i)
      described.sources[i] = i;
    return described;
  }

  DescribedFeatures describe(const GrayImage& image, const std::vector<Eigen::Vector2d>& pixels) override {
    constexpr double kScale = 1.6;
    const PixelBox box = pixel_box(around(pixels), kMargin, image);
    if (box.empty()) return {};
    const Eigen::Vector2d origin(box.left, box.top);
    integral_.build(image, box.left, box.top, box.width, box.height);
    points_.clear();
    std::vector<std::size_t> sources;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const Eigen::Vector2d pixel = pixels[i] - origin;
      if (!(pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < box.width && pixel.y() < box.height))
        continue;
      points_.push_back(SurfPoint{pixel, kScale, 0.0, 0.0, false});
      sources.push_back(i);
    }
    DescribedFeatures described = describe_points(origin);
    described.sources = std::move(sources);
    return described;
  }

 private:
  static constexpr int kMargin = 40;  // [px] the descriptor's window at small scales

  DescribedFeatures describe_points(const Eigen::Vector2d& origin) {
    DescribedFeatures described;
    described.sources.resize(points_.size());
    described.vectors.resize(static_cast<Eigen::Index>(points_.size()), 64);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      SurfPoint& point = points_[i];
      if (!surf_.options().upright) point.angle = surf_.orientation(integral_, point);
      const SurfDescriptor descriptor = surf_.describe(integral_, point);
      described.pixels.emplace_back(origin + point.pixel);
      described.vectors.row(static_cast<Eigen::Index>(i)) =
          Eigen::Map<const Eigen::RowVectorXf>(descriptor.data(), 64);
    }
    return described;
  }

  Surf surf_;
  IntegralImage integral_;
  std::vector<SurfPoint> points_;
};

}  // namespace

PixelBox pixel_box(const ConvexPolygon& roi, int margin, const GrayImage& image) {
  if (roi.empty()) return {};
  const Rectangle bounds = bounding_box(roi);
  const auto floor_in = [margin](double value, int size) {
    return static_cast<int>(std::clamp(std::floor(value) - margin, 0.0, static_cast<double>(size)));
  };
  const auto ceil_in = [margin](double value, int size) {
    return static_cast<int>(std::clamp(std::ceil(value) + 1.0 + margin, 0.0, static_cast<double>(size)));
  };
  PixelBox box;
  box.left = floor_in(bounds.min.x(), image.width);
  box.top = floor_in(bounds.min.y(), image.height);
  box.width = ceil_in(bounds.max.x(), image.width) - box.left;
  box.height = ceil_in(bounds.max.y(), image.height) - box.top;
  return box;
}

std::unique_ptr<DescriptorExtractor> make_descriptor_extractor(DescriptorKind kind) {
  if (kind == DescriptorKind::kSurf) return std::make_unique<SurfExtractor>();
  // More than are asked for: those outside the region fall away afterwards.
  constexpr int kDetected = 1000;
  return std::make_unique<OpencvExtractor>(kind, cv::ORB::create(kDetected, 1.2F, 6),
                                           cv::SIFT::create(kDetected));
}

}  // namespace cosight::vision
