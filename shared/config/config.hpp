#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cosight {

/// A configuration that can't be used: one sentence with file, line and key, and what would do.
///
///   config/robot.yaml:14: search.max_features: 0 is not in [10, 1000]; leave it out for 60
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ConfigTree;  // config_tree.hpp: yaml-cpp stays behind it

/// One section of a configuration. Each getter names the key, what to use when the key is absent, and what is
/// allowed; what is not allowed is a ConfigError. A getter also makes its key known (see
/// `ConfigFile::refuse_unknown_keys`). Cheap to copy.
///
///   SearchOptions read_search_options(const ConfigNode& node) {
///     SearchOptions options;
///     options.max_features = node.integer("max_features", options.max_features, 10, 1000);
///     return options;
///   }
///   …
///   options.search = read_search_options(root.section("search"));
class ConfigNode {
 public:
  static constexpr double kAny = std::numeric_limits<double>::infinity();

  explicit ConfigNode(std::shared_ptr<ConfigTree> tree) : tree_(std::move(tree)) {}

  double number(std::string_view key, double otherwise, double min = -kAny, double max = kAny) const;
  int integer(std::string_view key, int otherwise, int min = std::numeric_limits<int>::min(),
              int max = std::numeric_limits<int>::max()) const;
  bool boolean(std::string_view key, bool otherwise) const;
  std::string text(std::string_view key, std::string_view otherwise) const;

  /// `{{"orb", Descriptor::kOrb}, {"sift", Descriptor::kSift}}`
  template <class Enum>
  Enum choice(std::string_view key, Enum otherwise,
              std::initializer_list<std::pair<const char*, Enum>> choices) const {
    std::vector<std::string_view> names;
    std::size_t index = 0;
    for (const auto& [name, value] : choices) {
      if (value == otherwise) index = names.size();
      names.emplace_back(name);
    }
    return (choices.begin() + choice_index(key, index, names))->second;
  }

  /// In a file relative to that file's folder, on the command line to the working folder; `~` and `$NAME` are
  /// expanded (`$COSIGHT_DATA` is `../shared/data` when it is not set). Empty stays empty.
  std::filesystem::path path(std::string_view key, const std::filesystem::path& otherwise) const;

  std::vector<double> numbers(std::string_view key, const std::vector<double>& otherwise, double min = -kAny,
                              double max = kAny) const;
  Eigen::Vector3d vector3(std::string_view key, const Eigen::Vector3d& otherwise, double min = -kAny,
                          double max = kAny) const;
  std::vector<std::string> texts(std::string_view key, const std::vector<std::string>& otherwise) const;

  /// A matrix written row by row, `[[a, b], [c, d]]` or flat; an error when it is given in another size.
  Eigen::MatrixXd matrix(std::string_view key, const Eigen::MatrixXd& otherwise) const;

  /// An absent section reads as an empty one.
  ConfigNode section(std::string_view key) const;

  /// The sections of a list, `key: [{…}, {…}]`; none when it is absent.
  std::vector<ConfigNode> sections(std::string_view key) const;

  bool has(std::string_view key) const;
  std::vector<std::string> keys() const;

  /// A ConfigError about `key` in this section, for what only the caller can judge (two keys that exclude
  /// each other, a required key that is missing).
  ConfigError error(std::string_view key, const std::string& sentence) const;

 private:
  std::ptrdiff_t choice_index(std::string_view key, std::size_t otherwise,
                              std::span<const std::string_view> names) const;
  const ConfigTree* find(std::string_view key) const;

  std::shared_ptr<ConfigTree> tree_;
};

/// A value that replaces the file's: `--set slam.max_landmarks=60`.
struct ConfigOverride {
  std::string key;         ///< dotted
  std::string value;       ///< yaml, or plain text
  std::string origin;      ///< for error messages: "--set", "--rate"
  bool plain_text = true;  ///< false: `value` is yaml, so that it may be a list
};

/// `slam.max_landmarks=60` as `--set` gets it. Throws ConfigError when there is no `=`.
ConfigOverride parse_override(const std::string& assignment);

/// A yaml file with what the command line says otherwise.
class ConfigFile {
 public:
  /// Throws ConfigError when the file can't be read or is not yaml.
  static ConfigFile load(const std::filesystem::path& file,
                         const std::vector<ConfigOverride>& overrides = {});
  static ConfigFile parse(const std::string& yaml, const std::string& name,
                          const std::vector<ConfigOverride>& overrides = {});

  const ConfigNode& root() const { return root_; }

  /// To be called once everything has been read: a key that no getter asked for is a ConfigError which names
  /// the nearest known one.
  void refuse_unknown_keys() const;

  /// Everything that was read, defaults included, as yaml: the whole truth about a run.
  std::string resolved() const;

 private:
  explicit ConfigFile(std::shared_ptr<ConfigTree> tree);

  std::shared_ptr<ConfigTree> tree_;
  ConfigNode root_;
};

}  // namespace cosight
