#pragma once
#include <vector>

#include "lib/check/check_report.h"

/// The report for people and for programs. The same report gives the same bytes.
namespace bp {

/// Lines for a terminal, the last one the verdict: "holds" or "does not hold: ...".
[[nodiscard]] std::string verdict_text(const CheckReport& report, const std::string& proxy_name);

/// One JSON object, indented; numbers that are not finite become null. Keys and their order are part of the interface.
[[nodiscard]] std::string verdict_json(const CheckReport& report, const std::string& proxy_name);

/// The same of all levels of a file, finest first. Of one level, as above; of several the text has one after the other
/// and a last line for all, the JSON is {"holds", "levels": [one object each]}.
[[nodiscard]] std::string verdict_text(const std::vector<CheckReport>& levels, const std::string& proxy_name);
[[nodiscard]] std::string verdict_json(const std::vector<CheckReport>& levels, const std::string& proxy_name);
[[nodiscard]] Answer answer_of(const std::vector<CheckReport>& levels);

/// The first finite place that verdict_text() prints; empty: it prints none.
[[nodiscard]] std::optional<Vec3d> first_place(const CheckReport& report);

/// What does not hold, in a few words: "not closed, 3 scene triangles outside"; empty if all holds.
[[nodiscard]] std::string failures(const CheckReport& report);

}  // namespace bp
