#pragma once

#include <memory>
#include <vector>

#include "shared/dataset/motion_csv.hpp"
#include "tests/shared/dataset/dataset_fixture.hpp"

namespace cosight {

inline std::unique_ptr<SampleSource> images(const std::vector<Stamp>& stamps) {
  std::vector<Sample> samples;
  for (const Stamp stamp : stamps) {
    ImageSample image;
    image.stamp = stamp;
    image.sequence = samples.size();
    samples.emplace_back(std::move(image));
  }
  return std::make_unique<SampleListSource>(std::move(samples), SampleKind::kImage, SourceCounters{},
                                            "images");
}

inline std::unique_ptr<SampleSource> orientations(const std::vector<Stamp>& stamps) {
  std::vector<Sample> samples;
  for (const Stamp stamp : stamps) {
    AhrsSample orientation;
    orientation.stamp = stamp;
    samples.emplace_back(orientation);
  }
  return std::make_unique<SampleListSource>(std::move(samples), SampleKind::kAhrs, SourceCounters{},
                                            "orientations");
}

}  // namespace cosight
