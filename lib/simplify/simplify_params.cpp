#include "lib/simplify/simplify_params.h"

#include <algorithm>

namespace bp {

std::string to_string(StopReason reason) {
  switch (reason) {
    case StopReason::faces:
      return "faces";
    case StopReason::error:
      return "error";
    case StopReason::limits:
      return "limits";
    case StopReason::edge_length:
      return "edge-length";
    case StopReason::least_volume:
      return "least-volume";
    case StopReason::nothing_left:
      return "no collapse left that keeps the guarantee";
  }
  return "";
}

void SimplifyCounts::add(const SimplifyCounts& next) {
  const SimplifyCounts before = *this;
  *this = next;
  faces_in = before.faces_in;
  faces_flat = before.faces_flat;
  collapses += before.collapses;
  solved += before.solved;
}

void SimplifyCounts::add_beside(const SimplifyCounts& part) {
  collapses += part.collapses;
  solved += part.solved;
  refused += part.refused;
}

StopReason SimplifyCounts::reason_left() const {
  return refused[Refusal::error] > 0    ? StopReason::error
         : refused[Refusal::limits] > 0 ? StopReason::limits
         : refused[Refusal::length] > 0 ? StopReason::edge_length
                                        : StopReason::nothing_left;
}

}  // namespace bp
