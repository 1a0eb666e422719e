#include "tools/run/provenance.h"

#include <fmt/format.h>

namespace bp {

OptionText& OptionText::add(const std::string& key, const std::string& value) {
  if (value.empty()) return *this;
  if (!text_.empty()) text_ += ' ';
  text_ += key + "=" + value;
  return *this;
}

OptionText& OptionText::add(const std::string& key, double value) {
  return add(key, fmt::format("{}", value));
}

Provenance make_provenance(const std::string& tool, const OptionText& options, const std::string& input_hash) {
  return {tool, BP_VERSION, options.text(), input_hash};
}

}  // namespace bp
