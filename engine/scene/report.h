// Where the readers of one scene put the mistakes they find.
#pragma once

#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "engine/base/problems.h"

namespace firn {

class Report {
 public:
  /// `file` as it is to be shown.
  explicit Report(std::string file) : file_(std::move(file)) {}

  void add(SourceMark mark, std::string key, std::string message);
  void add(const toml::source_region& where, std::string key, std::string message) {
    add(mark(where), std::move(key), std::move(message));
  }

  /// No further mistake will be shown: finding its words can be saved. A hostile scene can hold millions.
  bool full() const { return problems_.size() >= kLimit; }

  const std::string& file() const { return file_; }
  /// A place in the file, or an override ("--set a.b=c"), which has no lines.
  SourceMark mark(const toml::source_region& where) const;

  void throw_if_any() const;

 private:
  static constexpr std::size_t kLimit = 200;
  std::string file_;
  Problems problems_;
  std::size_t left_out_ = 0;
};

/// "the string 'snw'", "an array of 2 values": what a user wrote, safe to print.
std::string describe(const toml::node& node);

/// "found ...; allowed: ..."
std::string found_and_allowed(const toml::node& found, std::string_view allowed);

}  // namespace firn
