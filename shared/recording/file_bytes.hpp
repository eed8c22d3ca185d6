#pragma once

#include <cstdint>
#include <filesystem>

#include "shared/recording/byte_sink.hpp"
#include "shared/recording/byte_source.hpp"

namespace cosight::recording {

/// A new file, written without a buffer of its own: what `write` returned from survives the end of the
/// process.
class FileSink : public ByteSink {
 public:
  /// Throws RecordingError when the file is already there or can't be made.
  explicit FileSink(std::filesystem::path path);
  ~FileSink() override;

  void write(std::initializer_list<ByteView> parts) override;
  void sync() override;

 private:
  bool write_all(ByteView bytes) const;
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;        ///< of what is whole
  std::uint64_t write_back_ = 0;  ///< up to where the kernel was told to begin writing
};

class FileSource : public ByteSource {
 public:
  /// Throws RecordingError when the file can't be opened.
  explicit FileSource(std::filesystem::path path);
  ~FileSource() override;

  /// As of opening: a file that still grows is read up to there.
  std::uint64_t size() const override { return size_; }
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> into) const override;
  std::string name() const override { return path_.string(); }

 private:
  std::filesystem::path path_;
  int file_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace cosight::recording
