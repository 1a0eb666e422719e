#include "tools/notes/scale_notes.h"

#include <fmt/format.h>

namespace bp {

namespace {

/// Returns false if the rule changes no scale within `margin` of the scene.
bool matters(const ScaleRule& rule, const ScaleField& field, double largest, const Bounds3d& scene, double margin) {
  if (rule.shape == ScaleShape::view) return true;
  Bounds3d place;
  for (const Vec3d& p : rule.points) place.add(p);
  const bool ramp = rule.support == ScaleRule::kNoSupport;
  if (ramp && !(field.slope > 0)) return true;
  margin += rule.radius + (ramp ? largest / field.slope : rule.support);
  for (std::size_t i = 0; i < 3; ++i) {
    if (place.max[i] < scene.min[i] - margin || place.min[i] > scene.max[i] + margin) return false;
  }
  return true;
}

}  // namespace

std::string rule_text(const ScaleRule& rule) {
  const std::string name = rule.name.empty() ? "" : rule.name + ": ";
  const Vec3d& p = rule.points[0];
  const std::string first = fmt::format("{:.6g},{:.6g},{:.6g}", p[0], p[1], p[2]);
  if (rule.shape == ScaleShape::box)
    return fmt::format("{}box {} to {:.6g},{:.6g},{:.6g}", name, first, rule.points[1][0], rule.points[1][1],
                       rule.points[1][2]);
  const std::string more = rule.points.size() > 1 ? fmt::format(" and {} more", rule.points.size() - 1) : "";
  return fmt::format("{}{} {}{}", name, rule.shape == ScaleShape::view ? "view" : "at", first, more);
}

std::vector<std::string> scale_notes(const ScalePlan& plan, const StreamHeader& header) {
  const ScaleField& field = plan.field;
  const double voxel = header.frame.voxel;
  std::vector<std::string> notes = short_length_notes(plan, voxel);
  for (const RuleEntry& entry : plan.entries) {
    if (entry.shape && entry.rules == 0 && entry.shape->length >= voxel)
      notes.push_back(entry.shape->name + ": this rule changes no scale in this scene");
  }
  const double largest = double(field.upper_bound(header.frame)) / kScaleOne;  // voxels
  if (largest < 1) {
    const bool opens = header.fill == FillMode::inside;
    notes.push_back(fmt::format(
        "a scale of {:.3g} voxels {}; use a larger scale or smaller voxels", largest,
        opens ? "takes nothing away: the opening is the input" : "closes nothing: the closing is the input"));
  }
  if (header.bounds.empty()) return notes;
  for (const ScaleRule& rule : field.rules) {
    // The closing at a place depends on scales within one scale of it.
    if (matters(rule, field, largest * voxel, header.bounds, (largest + 1) * voxel)) continue;
    notes.push_back(rule_text(rule) + " is nowhere near the scene; this rule of the field changes nothing");
  }
  return notes;
}

std::vector<std::string> short_length_notes(const ScalePlan& plan, double voxel) {
  std::vector<std::string> notes;
  for (const RuleEntry& entry : plan.entries) {
    if (!entry.shape || entry.shape->length >= voxel) continue;
    notes.push_back(
        fmt::format("{}: {:.3g} is less than a voxel ({:.3g}), the least that can be measured; use smaller "
                    "voxels or a larger length",
                    entry.shape->name, entry.shape->length, voxel));
  }
  return notes;
}

}  // namespace bp
