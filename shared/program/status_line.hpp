#pragma once

#include <string>

namespace cosight {

/// One line at the bottom of a terminal that is written over and over; nothing at all in a pipe or a file.
class StatusLine {
 public:
  /// `file`: where to, usually stderr (2).
  explicit StatusLine(int file = 2);
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Somebody sees it: else there is no need to make the text.
  bool is_visible() const { return is_visible_; }

  /// Cut to the terminal's width.
  void show(const std::string& text);

  void clear();

 private:
  void write(const std::string& text) const;

  int file_;
  bool is_visible_;
  bool is_dirty_ = false;
};

}  // namespace cosight
