#include "shared/image/image_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "shared/image/image_header.hpp"

namespace cosight {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Smooth enough that JPEG keeps it within a few gray levels.
GrayImage waves(int width, int height) {
  GrayImage image{width, height, Bytes(static_cast<std::size_t>(width * height))};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.row(y)[x] = static_cast<std::uint8_t>(128 + 60 * std::sin(0.11 * x) + 50 * std::cos(0.07 * y));
    }
  }
  return image;
}

Bytes jpeg(const GrayImage& image, int quality = 90) {
  Bytes bytes;
  encode_jpeg(image, quality, bytes);
  return bytes;
}
Bytes png(const GrayImage& image) {
  Bytes bytes;
  encode_png(image, bytes);
  return bytes;
}

TEST(ImageCodec, PngGivesBackEveryPixel) {
  const GrayImage image = waves(61, 47);
  GrayImage decoded;
  ASSERT_EQ(decode_gray(png(image), {61, 47}, decoded), DecodeOutcome::kDecoded);
  EXPECT_EQ(decoded.width, 61);
  EXPECT_EQ(decoded.height, 47);
  EXPECT_EQ(decoded.data, image.data);
}

TEST(ImageCodec, JpegGivesBackNearlyEveryPixel) {
  const GrayImage image = waves(61, 47);
  GrayImage decoded;
  ASSERT_EQ(decode_gray(jpeg(image), {61, 47}, decoded), DecodeOutcome::kDecoded);
  for (std::size_t i = 0; i < image.data.size(); ++i)
    ASSERT_NEAR(decoded.data[i], image.data[i], 6) << i;
}

TEST(ImageCodec, DecodingTheSameSizeAgainReusesTheMemory) {
  GrayImage decoded;
  ASSERT_EQ(decode_gray(jpeg(waves(64, 48)), {}, decoded), DecodeOutcome::kDecoded);
  const std::uint8_t* const before = decoded.data.data();
  ASSERT_EQ(decode_gray(png(waves(64, 48)), {}, decoded), DecodeOutcome::kDecoded);
  EXPECT_EQ(decoded.data.data(), before);
}

TEST(ImageCodec, EveryTruncationOfAJpegIsFound) {
  const Bytes whole = jpeg(waves(64, 48));
  GrayImage decoded;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const DecodeOutcome outcome = decode_gray(std::span(whole).first(size), {}, decoded);
    ASSERT_TRUE(outcome == DecodeOutcome::kTruncated || outcome == DecodeOutcome::kNotAnImage) << size;
  }
  EXPECT_EQ(decode_gray(std::span(whole).first(whole.size() * 2 / 3), {}, decoded),
            DecodeOutcome::kTruncated);
}

TEST(ImageCodec, EveryTruncationOfAPngIsFound) {
  const Bytes whole = png(waves(64, 48));
  GrayImage decoded;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_NE(decode_gray(std::span(whole).first(size), {}, decoded), DecodeOutcome::kDecoded) << size;
  }
}

TEST(ImageCodec, BytesAfterTheEndDoNoHarm) {
  for (Bytes bytes : {jpeg(waves(64, 48)), png(waves(64, 48))}) {
    bytes.resize(bytes.size() + 100, 0);
    GrayImage decoded;
    EXPECT_EQ(decode_gray(bytes, {}, decoded), DecodeOutcome::kDecoded);
  }
}

TEST(ImageCodec, AnotherSizeThanTheCalibrationSaysIsRefused) {
  GrayImage decoded;
  EXPECT_EQ(decode_gray(jpeg(waves(64, 48)), {64, 47}, decoded), DecodeOutcome::kWrongSize);
  EXPECT_EQ(decode_gray(png(waves(64, 48)), {63, 48}, decoded), DecodeOutcome::kWrongSize);
  EXPECT_EQ(decode_gray(png(waves(64, 48)), {0, 48}, decoded), DecodeOutcome::kDecoded);
}

TEST(ImageCodec, AHugeClaimIsRefusedBeforeAnythingIsAllocated) {
  Bytes lying_png = png(waves(64, 48));
  lying_png[16] = 0x7F;  // the width's highest byte: 2 billion columns
  Bytes lying_jpeg = jpeg(waves(64, 48));
  for (std::size_t i = 0; i + 9 < lying_jpeg.size(); ++i) {
    if (lying_jpeg[i] == 0xFF && lying_jpeg[i + 1] == 0xC0) {
      for (std::size_t k = 5; k < 9; ++k)
        lying_jpeg[i + k] = 0xFF;  // 65535 x 65535
      break;
    }
  }
  for (const Bytes& bytes : {lying_png, lying_jpeg}) {
    GrayImage decoded;
    EXPECT_EQ(decode_gray(bytes, {}, decoded), DecodeOutcome::kTooLarge);
    EXPECT_EQ(decoded.data.capacity(), 0U);
  }
}

TEST(ImageCodec, WhatIsNoImageIsSaidSo) {
  GrayImage decoded;
  EXPECT_EQ(decode_gray({}, {}, decoded), DecodeOutcome::kNotAnImage);
  EXPECT_EQ(decode_gray(Bytes(1000, 0), {}, decoded), DecodeOutcome::kNotAnImage);
  EXPECT_EQ(decode_gray(Bytes(1000, 0xFF), {}, decoded), DecodeOutcome::kNotAnImage);
  EXPECT_EQ(decode_gray(Bytes{0xFF, 0xD8, 0xFF, 0xD9}, {}, decoded), DecodeOutcome::kNotAnImage);
}

TEST(ImageCodec, BrokenBytesNeverEndTheProcess) {
  std::mt19937 rng(11);
  GrayImage decoded;
  for (const Bytes& whole : {jpeg(waves(64, 48)), png(waves(64, 48))}) {
    for (int i = 0; i < 400; ++i) {
      Bytes bytes = whole;
      for (int k = 0; k < 3; ++k)
        bytes[rng() % bytes.size()] = static_cast<std::uint8_t>(rng());
      decode_gray(bytes, {.max_pixels = 100'000}, decoded);
      ASSERT_LE(decoded.data.capacity(), 100'000U);
    }
  }
}

TEST(ImageCodec, ADamagedPngIsCorrupt) {
  Bytes bytes = png(waves(64, 48));
  bytes[bytes.size() / 2] ^= 0x40;  // inside the data: its check sum no longer fits
  GrayImage decoded;
  EXPECT_EQ(decode_gray(bytes, {}, decoded), DecodeOutcome::kCorrupt);
}

TEST(ImageFile, WritesAndReadsByExtension) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "cosight_image_test";
  std::filesystem::create_directories(folder);
  const GrayImage image = waves(40, 30);
  write_image(folder / "a.png", image);
  write_image(folder / "a.jpg", image);
  EXPECT_EQ(read_image(folder / "a.png").data, image.data);
  Bytes bytes;
  ASSERT_TRUE(read_bytes(folder / "a.jpg", bytes));
  EXPECT_EQ(read_image_header(bytes)->format, ImageFormat::kJpeg);
  EXPECT_FALSE(read_bytes(folder, bytes));
  EXPECT_THROW(read_image(folder / "none.png"), ImageFileError);
  EXPECT_THROW(write_image(folder / "no/such/a.png", image), ImageFileError);
}

TEST(ImageHeader, ReadsTheRealSequencesWhenTheyAreThere) {
  const char* const given = std::getenv("COSIGHT_DATA");
  const std::filesystem::path data = given != nullptr ? given : COSIGHT_SOURCE_DIR "/../shared/data";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no " << data;
  int images = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data / "kitti00/left")) {
    Bytes bytes;
    ASSERT_TRUE(read_bytes(entry.path(), bytes));
    const auto header = read_image_header(bytes);
    ASSERT_TRUE(header) << entry.path();
    EXPECT_TRUE(header->complete && header->width == 1241 && header->height == 376) << entry.path();
    ++images;
  }
  EXPECT_GE(images, 100);
}

}  // namespace
}  // namespace cosight
