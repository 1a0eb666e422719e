#pragma once
#include <optional>
#include <span>
#include <string>

#include "lib/check/check_report.h"

/// Texts that the verdicts for people and for programs share.
namespace bp {

/// The name of a finding, and of its examples' numbers.
struct FindingText {
  Finding CheckReport::*finding;
  const char* key;
  const char* text;   ///< "[edge has|edges have] one triangle only"
  const char* index;  ///< nullptr: none
  const char* other;
};

[[nodiscard]] std::span<const FindingText> finding_texts();

/// Returns "1 edge has one triangle only", "2 edges have one triangle only".
[[nodiscard]] std::string counted(const Finding& f, const FindingText& t);
/// Returns whether the finding belongs to a question that was not asked: no report mentions it.
[[nodiscard]] bool is_unasked(const CheckReport& r, const FindingText& t);

inline constexpr const char* kNoOutside = "only a closed, oriented surface has an outside";
/// Returns why the question about the scene is not decided.
[[nodiscard]] std::string scene_doubt(const CheckReport& r);
[[nodiscard]] std::string hidden_doubt(const CheckReport& r);
[[nodiscard]] std::string margin_doubt(const CheckReport& r);
/// Returns why some question is not decided, though nothing is refuted.
[[nodiscard]] std::string doubt_of(const CheckReport& r);

/// Returns the proxy's volume over the scene's; none if either is not known.
[[nodiscard]] std::optional<double> volume_ratio(const CheckReport& r);

}  // namespace bp
