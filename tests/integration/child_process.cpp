#include "tests/integration/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <utility>

namespace cosight::integration {
namespace {

constexpr int kOverwrite = O_WRONLY | O_CREAT | O_TRUNC;

std::vector<char*> argv_of(std::vector<std::string>& words) {
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words)
    argv.push_back(word.data());
  argv.push_back(nullptr);
  return argv;
}

int exit_code_of(int status) {
  constexpr int kSignalled = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
                           std::filesystem::path streams)
    : streams_(std::move(streams)) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, stream(".out").c_str(), kOverwrite, 0644);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, stream(".err").c_str(), kOverwrite, 0644);
  const int error =
      ::posix_spawn(&process_, program.c_str(), &files, nullptr, argv_of(words).data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::runtime_error(program + ": can't be started");
}

ChildProcess::~ChildProcess() {
  if (!is_running()) return;
  send(SIGKILL);
  ::waitpid(process_, &status_, 0);
}

void ChildProcess::send(int signal) const {
  if (!ended_) ::kill(process_, signal);
}

bool ChildProcess::is_running() {
  if (!ended_) ended_ = ::waitpid(process_, &status_, WNOHANG) == process_;
  return !ended_;
}

bool ChildProcess::has_ended(std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (is_running()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
  return true;
}

Ending ChildProcess::wait(std::chrono::milliseconds patience) {
  if (!has_ended(patience)) {
    send(SIGKILL);
    ::waitpid(process_, &status_, 0);
    ended_ = true;
  }
  return {exit_code_of(status_), text_of(stream(".out")), text_of(stream(".err"))};
}

std::string ChildProcess::err() const {
  return text_of(stream(".err"));
}

std::filesystem::path ChildProcess::stream(const char* extension) const {
  std::filesystem::path file = streams_;
  return file += extension;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace cosight::integration
