#include "shared/recording/idl_tokens.hpp"

#include <cctype>

namespace cosight::recording {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-' || c == '+';
}

class Tokenizer {
 public:
  explicit Tokenizer(std::string_view text) : rest_(text) {}

  std::vector<std::string> run() {
    while (!rest_.empty())
      take_next();
    return std::move(tokens_);
  }

 private:
  void take_next() {
    if (rest_.starts_with("//") || rest_.starts_with('#')) return skip_past("\n");
    if (rest_.starts_with("/*")) return skip_past("*/");
    if (rest_[0] == '"') return take_string();
    if (rest_[0] == '@' || is_word(rest_[0]) || rest_.starts_with("::")) return take_word();
    if (std::isspace(static_cast<unsigned char>(rest_[0])) == 0) tokens_.emplace_back(1, rest_[0]);
    rest_.remove_prefix(1);
  }

  void skip_past(std::string_view end) {
    const std::size_t at = rest_.find(end);
    rest_.remove_prefix(at == std::string_view::npos ? rest_.size() : at + end.size());
  }

  void take_string() {
    const std::size_t end = rest_.find('"', 1);
    const std::size_t length = end == std::string_view::npos ? rest_.size() : end + 1;
    tokens_.emplace_back(rest_.substr(0, length));
    rest_.remove_prefix(length);
  }

  void take_word() {
    std::size_t length = rest_[0] == '@' ? 1 : 0;
    while (length < rest_.size() && (is_word(rest_[length]) || rest_.substr(length).starts_with("::")))
      length += is_word(rest_[length]) ? 1 : 2;
    tokens_.emplace_back(rest_.substr(0, length));
    rest_.remove_prefix(length);
  }

  std::string_view rest_;
  std::vector<std::string> tokens_;
};

}  // namespace

std::vector<std::string> idl_tokens(std::string_view text) {
  return Tokenizer(text).run();
}

}  // namespace cosight::recording
