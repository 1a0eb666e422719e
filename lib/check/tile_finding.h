#pragma once
#include <string>

#include "lib/check/check_report.h"

namespace bp {

/// A line that a check of a tileset found.
struct TileFinding {
  std::string text;
  Answer answer = Answer::refuted;
};

}  // namespace bp
