#include "shared/image/image_codec.hpp"

#include <fstream>
#include <opencv2/imgcodecs.hpp>

namespace cosight {
namespace {

/// A header over memory that OpenCV only reads, though its type can't say so.
cv::Mat over(const std::uint8_t* data, int rows, int columns) {
  return {rows, columns, CV_8UC1,
          const_cast<std::uint8_t*>(data)};  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

}  // namespace

const char* to_string(DecodeOutcome outcome) {
  switch (outcome) {
    case DecodeOutcome::kDecoded:
      return "decoded";
    case DecodeOutcome::kNotAnImage:
      return "neither JPEG nor PNG";
    case DecodeOutcome::kTruncated:
      return "truncated";
    case DecodeOutcome::kTooLarge:
      return "too large";
    case DecodeOutcome::kWrongSize:
      return "of another size than the calibration says";
    case DecodeOutcome::kCorrupt:
      return "corrupt";
  }
  return "unknown";
}

DecodeOutcome judge_header(const std::optional<ImageHeader>& header, const SizeLimits& limits) {
  if (!header) return DecodeOutcome::kNotAnImage;
  if (static_cast<std::int64_t>(header->width) * header->height > limits.max_pixels) {
    return DecodeOutcome::kTooLarge;
  }
  if ((limits.width > 0 && header->width != limits.width) ||
      (limits.height > 0 && header->height != limits.height)) {
    return DecodeOutcome::kWrongSize;
  }
  return header->complete ? DecodeOutcome::kDecoded : DecodeOutcome::kTruncated;
}

DecodeOutcome decode_gray(std::span<const std::uint8_t> bytes, const SizeLimits& limits, GrayImage& image) {
  const auto header = read_image_header(bytes);
  const DecodeOutcome verdict = judge_header(header, limits);
  if (verdict != DecodeOutcome::kDecoded) return verdict;
  image.width = header->width;
  image.height = header->height;
  image.data.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  cv::Mat pixels(image.height, image.width, CV_8UC1, image.data.data());
  try {
    const cv::Mat encoded = over(bytes.data(), 1, static_cast<int>(bytes.size()));
    cv::imdecode(encoded, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION, &pixels);
  } catch (const cv::Exception&) {
    return DecodeOutcome::kCorrupt;
  }
  // OpenCV decodes in place unless it failed, or found another size than the header says.
  return pixels.data == image.data.data() ? DecodeOutcome::kDecoded : DecodeOutcome::kCorrupt;
}

void encode_jpeg(const GrayImage& image, int quality, std::vector<std::uint8_t>& bytes) {
  cv::imencode(".jpg", over(image.data.data(), image.height, image.width), bytes,
               {cv::IMWRITE_JPEG_QUALITY, quality});
}

void encode_png(const GrayImage& image, std::vector<std::uint8_t>& bytes, int level) {
  cv::imencode(".png", over(image.data.data(), image.height, image.width), bytes,
               {cv::IMWRITE_PNG_COMPRESSION, level});
}

GrayImage read_image(const std::filesystem::path& file) {
  std::vector<std::uint8_t> bytes;
  if (!read_bytes(file, bytes)) throw ImageFileError(file.string() + ": can't be read; check the path");
  GrayImage image;
  const DecodeOutcome outcome = decode_gray(bytes, {}, image);
  if (outcome != DecodeOutcome::kDecoded) throw ImageFileError(file.string() + ": is " + to_string(outcome));
  return image;
}

void write_image(const std::filesystem::path& file, const GrayImage& image, int quality) {
  std::vector<std::uint8_t> bytes;
  const auto extension = file.extension();
  if (extension == ".jpg" || extension == ".jpeg") {
    encode_jpeg(image, quality, bytes);
  } else {
    encode_png(image, bytes);
  }
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!out.flush())
    throw ImageFileError(file.string() + ": can't be written; check the folder and free space");
}

bool read_bytes(const std::filesystem::path& file, std::vector<std::uint8_t>& bytes) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) return false;
  const auto size = std::filesystem::file_size(file, failure);
  std::ifstream in(file, std::ios::binary);
  if (failure || !in) return false;
  bytes.resize(size);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return in.gcount() == static_cast<std::streamsize>(size);
}

}  // namespace cosight
