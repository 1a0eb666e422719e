#pragma once
#include <optional>
#include <span>
#include <string>

#include "lib/check/check_report.h"

/// What the verdicts for people and for programs have in common.
namespace bp {

/// How a finding is named, and what its examples' numbers are.
struct FindingText {
  Finding CheckReport::*finding;
  const char* key;
  const char* text;   ///< "[edge has|edges have] one triangle only"
  const char* index;  ///< nullptr: none
  const char* other;
};

[[nodiscard]] std::span<const FindingText> finding_texts();

/// "1 edge has one triangle only", "2 edges have one triangle only".
[[nodiscard]] std::string counted(const Finding& f, const FindingText& t);
/// Whether the finding answers a question that was not asked, which no report mentions.
[[nodiscard]] bool is_unasked(const CheckReport& r, const FindingText& t);

inline constexpr const char* kNoOutside = "only a closed, oriented surface has an outside";
/// Why the question about the scene is not decided.
[[nodiscard]] std::string scene_doubt(const CheckReport& r);
[[nodiscard]] std::string hidden_doubt(const CheckReport& r);
[[nodiscard]] std::string margin_doubt(const CheckReport& r);
/// Why not all that was asked is decided, though nothing is refuted.
[[nodiscard]] std::string doubt_of(const CheckReport& r);

/// The proxy's volume over the scene's; none if either is not known.
[[nodiscard]] std::optional<double> volume_ratio(const CheckReport& r);

}  // namespace bp
