#pragma once
#include <string>

#include "lib/check/check_report.h"

namespace bp {

/// What a check of a tileset found: a line.
struct TileFinding {
  std::string text;
  Answer answer = Answer::refuted;
};

}  // namespace bp
