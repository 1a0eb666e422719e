#pragma once
#include <exception>
#include <string>

namespace bp::detail {

/// Returns the fault of a JSON text, without the number that nlohmann gives the kind of error.
inline std::string json_fault(const std::exception& e) {
  const std::string text = e.what();
  const std::size_t end = text.find("] ");
  return text.starts_with("[json.exception") && end != std::string::npos ? text.substr(end + 2) : text;
}

}  // namespace bp::detail
