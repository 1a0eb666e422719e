#include "lib/check/verdict_words.h"

#include <fmt/format.h>

#include <cmath>

#include "lib/check/counted.h"
#include "lib/check/scene_words.h"

namespace bp {

namespace {

constexpr FindingText kFindings[] = {
    {&CheckReport::bad_faces, "bad_faces", "[face does not name|faces do not name] three vertices that exist", "face",
     nullptr},
    {&CheckReport::non_finite_vertices, "non_finite_vertices", "[vertex is|vertices are] not finite", "vertex",
     nullptr},
    {&CheckReport::undecidable_vertices, "undecidable_vertices",
     "[vertex has|vertices have] coordinates beyond 1e90 or below 1e-90, where nothing can be proven", "vertex",
     nullptr},
    {&CheckReport::degenerate_triangles, "degenerate_triangles", "[triangle has|triangles have] no area", "triangle",
     nullptr},
    {&CheckReport::duplicate_triangles, "duplicate_triangles", "[triangle repeats|triangles repeat] another one",
     "triangle", "earlier_triangle"},
    {&CheckReport::boundary_edges, "boundary_edges", "[edge has|edges have] one triangle only: holes", "vertex",
     "other_vertex"},
    {&CheckReport::misoriented_edges, "misoriented_edges", "[edge joins|edges join] triangles of opposite orientation",
     "vertex", "other_vertex"},
    {&CheckReport::nonmanifold_edges, "nonmanifold_edges", "[edge has|edges have] more than two triangles", "vertex",
     "other_vertex"},
    {&CheckReport::nonmanifold_vertices, "nonmanifold_vertices",
     "[vertex joins|vertices join] separate fans of triangles", "vertex", nullptr},
    {&CheckReport::self_intersections, "self_intersections",
     "[pair of triangles intersects|pairs of triangles intersect]", "triangle", "other_triangle"},
    {&CheckReport::inverted_components, "inverted_components", "[outer component faces|outer components face] inwards",
     "triangle", nullptr},
    {&CheckReport::touching, "touching", "[scene triangle touches or crosses|scene triangles touch or cross] the proxy",
     "scene_triangle", "triangle"},
    {&CheckReport::outside, "outside", "[scene triangle lies|scene triangles lie] outside the proxy", "scene_triangle",
     nullptr},
    {&CheckReport::too_near, "too_near", "[scene triangle is|scene triangles are] nearer to the proxy than the margin",
     "scene_triangle", "triangle"},
    {&CheckReport::perhaps_near, "perhaps_near",
     "[scene triangle is|scene triangles are] as near as the margin, to the last digits", "scene_triangle", "triangle"},
    {&CheckReport::within_rounding, "within_rounding",
     "[scene triangle is|scene triangles are] as near to the proxy as coordinates may be off", "scene_triangle",
     "triangle"},
    {&CheckReport::swallowed, "swallowed", "[scene triangle lies|scene triangles lie] inside the proxy",
     "scene_triangle", nullptr},
    {&CheckReport::outside_parts, "outside_parts",
     "[part of the proxy is|parts of the proxy are] seen from outside the scene", "triangle", nullptr},
    {&CheckReport::unsettled_parts, "unsettled_parts",
     "[part of the proxy has no closed shell of the scene around it|parts of the proxy have no closed shell of the "
     "scene around them]",
     "triangle", nullptr},
    {&CheckReport::exposed, "exposed",
     "[triangle of the proxy lies|triangles of the proxy lie] where the outside comes", "triangle", nullptr},
    {&CheckReport::nonconvex_parts, "nonconvex_parts",
     "[part is not convex, or faces|parts are not convex, or face] inwards", "triangle", "vertex"},
    {&CheckReport::not_held, "not_held", "[scene triangle is|scene triangles are] not covered by the parts",
     "scene_triangle", nullptr},
    {&CheckReport::perhaps_not_held, "perhaps_not_held",
     "[scene triangle lies|scene triangles lie] where parts overlap too little to be proven", "scene_triangle",
     nullptr},
    {&CheckReport::undecidable_scene, "undecidable_scene",
     "[scene triangle has|scene triangles have] coordinates beyond 1e90 or below 1e-90, where nothing can be proven",
     "scene_triangle", nullptr},
};

}  // namespace

std::span<const FindingText> finding_texts() {
  return kFindings;
}

/// The sign of the scene's volume is ignored, since the scene may face inwards.
std::optional<double> volume_ratio(const CheckReport& r) {
  if (!r.volume || !r.scene_volume) return {};
  return *r.volume / std::abs(*r.scene_volume);
}

/// Returns "1 edge has one triangle only", "2 edges have one triangle only", "at least 200 pairs of triangles
/// intersect".
std::string counted(const Finding& f, const FindingText& t) {
  const std::string text = t.text;
  const std::size_t open = text.find('['), bar = text.find('|'), close = text.find(']');
  const std::string noun = f.count == 1 ? text.substr(open + 1, bar - open - 1) : text.substr(bar + 1, close - bar - 1);
  return fmt::format("{}{} {}{}", f.at_least ? "at least " : "", f.count, noun, text.substr(close + 1));
}

/// Returns whether a finding belongs to a question that was not asked: no report mentions it.
bool is_unasked(const CheckReport& r, const FindingText& t) {
  if (t.finding == &CheckReport::within_rounding) return !r.scene_counts.rounding.any() && r.proxy_off == 0;
  return r.margin == 0 && (t.finding == &CheckReport::too_near || t.finding == &CheckReport::perhaps_near);
}

namespace {

double most_off(const CheckReport& r) {
  return r.scene_counts.rounding.most + r.proxy_off;
}

}  // namespace

/// Returns why the question about the scene is not decided.
std::string scene_doubt(const CheckReport& r) {
  if (!r.place_unknown.empty()) return r.place_unknown;
  if (!r.sides_decided) return kNoOutside;
  if (r.undecidable_scene.count > 0) return "the scene has coordinates that are too large or too small";
  if (r.scene_counts.is_partial()) return partial_scene(r.scene_counts);
  if (r.unfollowed.any()) return drawn_elsewhere("proxy", r.unfollowed);
  const std::uint64_t wrong = r.touching.count + r.outside.count + r.not_held.count + r.swallowed.count +
                              r.outside_parts.count + r.too_near.count;
  if (most_off(r) > 0 && wrong > 0)
    return fmt::format("coordinates are read to within {:.2g}, and only as read is anything on the wrong side",
                       most_off(r));
  if (r.within_rounding.count > 0)
    return fmt::format("coordinates are read to within {:.2g}, and the proxy is as near to {} as that", most_off(r),
                       bp::counted(r.within_rounding.count, "triangle"));
  if (r.perhaps_not_held.count > 0) return "parts overlap too little where the scene passes from one to another";
  return r.scene_closed ? "the scene is of parts that overlap or touch" : "the scene is open, so it has no inside";
}

std::string hidden_doubt(const CheckReport& r) {
  return r.hidden_unknown.empty() || !r.place_unknown.empty() ? scene_doubt(r) : r.hidden_unknown;
}

/// Returns why the margin is not decided.
std::string margin_doubt(const CheckReport& r) {
  if (r.undecidable_scene.count > 0 || r.is_partial() || !r.place_unknown.empty()) return scene_doubt(r);
  return most_off(r) > 0
             ? fmt::format("coordinates are read to within {:.2g}, and the least distance is the margin to within that",
                           most_off(r))
             : "the least distance is the margin, to the last digits";
}

/// Returns why some question is not decided, though nothing is refuted.
std::string doubt_of(const CheckReport& r) {
  if (r.undecidable_vertices.count > 0) return "the proxy has coordinates that are too large or too small";
  if (r.differing > 0) return "the proxy's file holds " + held_twice(r.differing);
  if (r.soundness() == Answer::undecided && r.unfollowed.any()) return drawn_elsewhere("proxy", r.unfollowed);
  if (r.pairs_open()) return "too many triangles of the proxy lie side by side to be tested for intersections";
  if (r.bent_faces_open)
    return fmt::format("{} of the proxy {} not flat, and not proven over other diagonals",
                       bp::counted(r.bent_faces, "face"), r.bent_faces == 1 ? "is" : "are");
  if (r.margin > 0 && r.enclosure() == Answer::proven) return margin_doubt(r);
  return r.asks_hidden ? hidden_doubt(r) : scene_doubt(r);
}

}  // namespace bp
