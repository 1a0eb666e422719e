#pragma once
#include <concepts>
#include <string>

#include "lib/grid/stream.h"
#include "tools/cli/length.h"

/// The canonical text of a tool's options for the provenance chain: "voxel=0.125 fill=flood". It has only options that
/// change the result, with defaults, in a fixed order; never a path, a thread count or a time of day.
namespace bp {

class OptionText {
 public:
  OptionText& add(const std::string& key, const std::string& value);  ///< adds nothing if the value is empty
  OptionText& add(const std::string& key, const char* value) { return add(key, std::string(value)); }
  OptionText& add(const std::string& key, double value);  ///< shortest text that reads back the same
  OptionText& add(const std::string& key, bool value) { return add(key, value ? "yes" : "no"); }
  OptionText& add(const std::string& key, const Length& value) { return add(key, value.text()); }
  template <std::integral Int>
  OptionText& add(const std::string& key, Int value) {
    return add(key, std::to_string(value));
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Returns one link of the chain, made by this version of the suite.
[[nodiscard]] Provenance make_provenance(const std::string& tool, const OptionText& options,
                                         const std::string& input_hash = "");

}  // namespace bp
