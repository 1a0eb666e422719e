#pragma once
#include <vector>

#include "lib/check/check_report.h"

/// Writes the report for people and for programs. The same report gives the same bytes.
namespace bp {

/// Returns lines for a terminal; the last one is the verdict: "holds" or "does not hold: ...".
[[nodiscard]] std::string verdict_text(const CheckReport& report, const std::string& proxy_name);

/// Returns one JSON object, indented; numbers that are not finite become null. Keys and their order are part of the
/// interface.
[[nodiscard]] std::string verdict_json(const CheckReport& report, const std::string& proxy_name);

/// Return the verdicts on all levels of a file, finest first. For one level: as above. For several, the text has one
/// after the other and a last line for all; the JSON is {"holds", "levels": [one object each]}.
[[nodiscard]] std::string verdict_text(const std::vector<CheckReport>& levels, const std::string& proxy_name);
[[nodiscard]] std::string verdict_json(const std::vector<CheckReport>& levels, const std::string& proxy_name);
[[nodiscard]] Answer answer_of(const std::vector<CheckReport>& levels);

/// Returns the first finite place that verdict_text() prints; empty if it prints none.
[[nodiscard]] std::optional<Vec3d> first_place(const CheckReport& report);

/// Returns the failures in a few words: "not closed, 3 scene triangles outside"; empty if all holds.
[[nodiscard]] std::string failures(const CheckReport& report);

}  // namespace bp
