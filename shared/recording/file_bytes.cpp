#include "shared/recording/file_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "shared/recording/recording_error.hpp"

namespace cosight::recording {
namespace {

// The disk begins early, so that little is left to be done at the end.
constexpr std::uint64_t kWriteBack = std::uint64_t{8} << 20;

std::string reason() {
  return std::generic_category().message(errno);
}

}  // namespace

FileSink::FileSink(std::filesystem::path path) : path_(std::move(path)) {
  // Never over another recording: what was recorded can't be recorded again.
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file_ < 0) fail("can't be made");
}

FileSink::~FileSink() {
  ::close(file_);
}

bool FileSink::write_all(ByteView bytes) const {
  while (!bytes.empty()) {
    const ::ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = ENOSPC;
    if (count <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

void FileSink::write(std::initializer_list<ByteView> parts) {
  std::uint64_t bytes = 0;
  for (const ByteView part : parts) {
    bytes += part.size();
    if (write_all(part)) continue;
    const int error = errno;
    if (::ftruncate(file_, static_cast<::off_t>(size_)) == 0) ::lseek(file_, 0, SEEK_END);
    errno = error;
    fail("can't be written");
  }
  size_ += bytes;
  if (size_ - write_back_ < kWriteBack) return;
  ::sync_file_range(file_, static_cast<::off64_t>(write_back_), static_cast<::off64_t>(size_ - write_back_),
                    SYNC_FILE_RANGE_WRITE);
  write_back_ = size_;
}

void FileSink::sync() {
  if (::fdatasync(file_) != 0) fail("can't be brought to the disk");
}

void FileSink::fail(const char* what) const {
  throw RecordingError("recording " + path_.string() + " " + what + ": " + reason());
}

FileSource::FileSource(std::filesystem::path path) : path_(std::move(path)) {
  file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) throw RecordingError("recording " + path_.string() + " can't be opened: " + reason());
  struct stat status {};
  if (::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(file_);
    throw RecordingError("recording " + path_.string() + " is not a file");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
}

FileSource::~FileSource() {
  ::close(file_);
}

std::size_t FileSource::read(std::uint64_t offset, std::span<std::uint8_t> into) const {
  std::size_t done = 0;
  while (done < into.size()) {
    const ::ssize_t count =
        ::pread(file_, into.data() + done, into.size() - done, static_cast<::off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

}  // namespace cosight::recording
