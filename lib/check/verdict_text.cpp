#include "lib/check/verdict_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/check/counted.h"
#include "lib/geometry/signed_volume.h"

namespace bp {

namespace {

using Json = nlohmann::ordered_json;

/// How a finding is named, and what its examples' numbers are.
struct FindingText {
  Finding CheckReport::*finding;
  const char* key;
  const char* text;   ///< "[edge has|edges have] one triangle only"
  const char* index;  ///< nullptr: none
  const char* other;
};

constexpr FindingText kFindings[] = {
    {&CheckReport::bad_faces, "bad_faces", "[triangle names|triangles name] a vertex that does not exist", "triangle",
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
    {&CheckReport::undecidable_scene, "undecidable_scene",
     "[scene triangle has|scene triangles have] coordinates beyond 1e90 or below 1e-90, where nothing can be proven",
     "scene_triangle", nullptr},
};

/// The scene may face inwards: its sign does not matter.
std::optional<double> volume_ratio(const CheckReport& r) {
  if (!r.volume || !r.scene_volume) return {};
  return *r.volume / std::abs(*r.scene_volume);
}

/// What is around the scene has less volume only where the scene winds around a place twice, or where it has a hollow.
std::string why_small(const CheckReport& r, double ratio) {
  if (ratio >= 1 || !r.encloses()) return "";
  return r.components > 1 ? ": the scene's parts overlap and count twice, or the proxy is hollow"
                          : ": the scene's parts overlap and count twice";
}

std::string point_text(const Vec3d& p) {
  return fmt::format("({:.9g}, {:.9g}, {:.9g})", p[0], p[1], p[2]);
}

std::string spaced(std::string s) {
  for (char& c : s)
    if (c == '_') c = ' ';
  return s;
}

/// "1 edge has one triangle only", "2 edges have one triangle only".
std::string counted(const Finding& f, const FindingText& t) {
  const std::string text = t.text;
  const std::size_t open = text.find('['), bar = text.find('|'), close = text.find(']');
  const std::string noun = f.count == 1 ? text.substr(open + 1, bar - open - 1) : text.substr(bar + 1, close - bar - 1);
  return fmt::format("{} {}{}", f.count, noun, text.substr(close + 1));
}

std::string finding_lines(const Finding& f, const FindingText& t) {
  if (f.count == 0) return "";
  std::string text = "    " + counted(f, t) + "\n";
  for (const Example& e : f.examples) {
    text += fmt::format("      {} {}", spaced(t.index), e.index);
    if (t.other != nullptr) text += fmt::format(", {} {}", spaced(t.other), e.other);
    text += fmt::format(" at {}\n", point_text(e.position));
  }
  if (f.count > f.examples.size() && !f.examples.empty()) text += "      ...\n";
  return text;
}

std::string row(const char* question, bool yes) {
  return fmt::format("  {:<28}{}\n", question, yes ? "yes" : "NO");
}

constexpr const char* kNoOutside = "only a closed, oriented surface has an outside";

std::string row(const char* question, Answer answer, const std::string& why) {
  if (answer != Answer::undecided) return row(question, answer == Answer::proven);
  return fmt::format("  {:<28}not decided: {}\n", question, why);
}

/// Why the question about the scene is not decided.
std::string scene_doubt(const CheckReport& r) {
  if (!r.sides_decided) return kNoOutside;
  if (r.undecidable_scene.count > 0) return "the scene has coordinates that are too large or too small";
  return r.scene_closed ? "the scene is of parts that overlap or touch" : "the scene is open, so it has no inside";
}

/// Why the margin is not decided.
std::string margin_doubt(const CheckReport& r) {
  return r.undecidable_scene.count > 0 ? scene_doubt(r) : "the least distance is the margin, to the last digits";
}

/// Why not all that was asked is decided, though nothing is refuted.
std::string doubt_of(const CheckReport& r) {
  if (r.soundness() == Answer::undecided) return "the proxy has coordinates that are too large or too small";
  if (r.margin > 0 && r.enclosure() == Answer::proven) return margin_doubt(r);
  return r.asks_hidden ? r.hidden_unknown : scene_doubt(r);
}

/// Inner walls may lie in what is hidden: then it is no failure.
std::string inside_rows(const CheckReport& r) {
  std::string text;
  const bool other = r.asks_hidden && r.hiddenness() == Answer::proven;  // then these decide nothing
  const auto add = [&](const char* question, Answer answer) {
    if (!other || answer == Answer::proven) text += row(question, answer, scene_doubt(r));
  };
  const bool is_free = r.touching.count + r.swallowed.count == 0;
  if (r.sides_decided) add("free of the scene", is_free ? Answer::proven : Answer::refuted);
  add("strictly inside the scene", r.insideness());
  if (!r.asks_hidden) return text;
  if (r.hiddenness() != Answer::proven) return text + row("hidden from outside", r.hiddenness(), r.hidden_unknown);
  return text + fmt::format("  {:<28}yes{}\n", "hidden from outside",
                            r.openings > 0 ? fmt::format(", with openings below {:.4g} closed", r.openings) : "");
}

/// Of questions that were not asked, which no report mentions.
bool is_unasked(const CheckReport& r, const FindingText& t) {
  return r.margin == 0 && (t.finding == &CheckReport::too_near || t.finding == &CheckReport::perhaps_near);
}

/// Findings that are no failures: what the proxy is asked instead is decided, or what cannot be judged may hide it.
bool is_aside(const CheckReport& r, const FindingText& t) {
  if (t.finding == &CheckReport::outside_parts && r.undecidable_scene.count > 0) return true;
  if (!r.asks_hidden || r.hiddenness() == Answer::undecided) return false;
  return t.finding == &CheckReport::touching || t.finding == &CheckReport::swallowed ||
         t.finding == &CheckReport::outside_parts || t.finding == &CheckReport::unsettled_parts;
}

std::string enclosure_row(const CheckReport& r) {
  if (!r.has_scene) return "";
  if (r.wants_inside) return inside_rows(r);
  std::string text = row("strictly encloses the scene", r.enclosure(), scene_doubt(r));
  return r.margin > 0 ? text + row("keeps the margin", r.keeps_margin(), margin_doubt(r)) : text;
}

std::string scene_lines(const CheckReport& r) {
  if (!r.has_scene) return "";
  const SceneCounts& c = r.scene_counts;
  std::string text = fmt::format("scene {}: {}\n", r.scene_name, bp::counted(r.scene_triangles, "triangle"));
  if (c.non_finite + c.degenerate + c.bad_faces != 0)
    text += fmt::format("  left out: {} without area{}, {} not finite, {} faces without corners\n", c.degenerate,
                        r.wants_inside ? " (but for whether the scene is closed)" : "", c.non_finite, c.bad_faces);
  if (c.animations > 0)
    text += "  " + bp::counted(c.animations, "animation") + " not followed: this is the scene before it moves\n";
  return text;
}

/// `what`: of the points that are measured from.
std::string distance_line(const char* name, const std::optional<SampledDistance>& d, const char* what) {
  if (!d) return "";
  const std::string bound = d->at_most ? fmt::format(" (at most {:.6g}), {:.6g} mean of", *d->at_most, d->mean)
                                       : fmt::format(", {:.6g} mean, of", d->mean);
  return fmt::format("  {:<28}{:.6g} largest{} {} sampled points{}\n", name, d->max, bound, d->samples, what);
}

std::string measure_lines(const CheckReport& r) {
  std::string text = fmt::format("  {:<28}{}\n", "volume", volume_text(r.volume));
  const std::optional<double> ratio = volume_ratio(r);
  if (r.has_scene && !r.wants_inside && !r.wants_convex)
    text += fmt::format("  {:<28}{}{}\n", "volume of the scene", volume_text(r.scene_volume),
                        ratio ? fmt::format(" (ratio {:.6g}{})", *ratio, why_small(r, *ratio)) : "");
  text +=
      fmt::format("  {:<28}{:.6g} to {:.6g}, {:.6g} on average\n", "edge lengths", r.edge_min, r.edge_max, r.edge_mean);
  text += fmt::format("  {:<28}{:.4g} degrees\n", "least angle", r.angle_min_degrees);
  if (r.least_gap) text += fmt::format("  {:<28}{:.6g}\n", "least distance to the scene", *r.least_gap);
  text += distance_line("distance scene to proxy", r.scene_to_proxy, "; inner parts of the scene count");
  text += distance_line("distance proxy to scene", r.proxy_to_scene, "");
  if (!r.distance_note.empty()) text += fmt::format("  {}\n", r.distance_note);
  return text;
}

Json json_of(const Finding& f, const FindingText& t) {
  Json examples = Json::array();
  for (const Example& e : f.examples) {
    Json one = {{t.index, e.index}};
    if (t.other != nullptr) one[t.other] = e.other;
    one["position"] = e.position;
    examples.push_back(std::move(one));
  }
  return {{"count", f.count}, {"examples", std::move(examples)}};
}

Json json_of(const std::optional<SampledDistance>& d) {
  if (!d) return nullptr;
  Json j{{"sampled", !d->at_most}, {"samples", d->samples}, {"max", d->max}, {"mean", d->mean}, {"where", d->where}};
  j["at_most"] = d->at_most ? Json(*d->at_most) : Json(nullptr);
  return j;
}

Json scene_json(const CheckReport& r) {
  if (!r.has_scene) return nullptr;
  const SceneCounts& c = r.scene_counts;
  return {{"name", r.scene_name},
          {"triangles", r.scene_triangles},
          {"skipped", {{"degenerate", c.degenerate}, {"non_finite", c.non_finite}, {"bad_faces", c.bad_faces}}},
          {"instances", c.instances},
          {"animations", c.animations}};
}

Json verdict_of(const CheckReport& r) {
  Json v = {{"readable", r.readable()},
            {"sound", r.sound()},
            {"closed", r.closed()},
            {"oriented", r.oriented()},
            {"manifold", r.manifold()},
            {"embedded", r.embedded()},
            {"outward", r.sides_decided && r.outward()}};
  if (r.wants_convex) v["convex"] = r.convex();
  v["encloses"] = r.has_scene && !r.wants_inside ? Json(r.encloses()) : Json(nullptr);
  if (r.wants_inside) v["inside"] = r.inside();
  if (r.margin > 0) v["keeps_margin"] = r.keeps_margin() == Answer::proven;
  return v;
}

Json answers_of(const CheckReport& r) {
  const auto outward = !r.sides_decided ? Answer::undecided : r.outward() ? Answer::proven : Answer::refuted;
  Json a = {{"mesh", to_string(r.soundness())}, {"outward", to_string(outward)}};
  if (r.has_scene)
    a[r.wants_inside ? "inside" : "encloses"] = to_string(r.wants_inside ? r.insideness() : r.enclosure());
  if (r.wants_inside && r.sides_decided)
    a["free_of_scene"] = to_string(r.touching.count + r.swallowed.count == 0 ? Answer::proven : Answer::refuted);
  if (r.margin > 0) a["margin"] = to_string(r.keeps_margin());
  if (r.asks_hidden) a["hidden"] = to_string(r.hiddenness());
  return a;
}

Json json_of(const CheckReport& r, const std::string& proxy_name) {
  Json findings = Json::object();
  for (const FindingText& t : kFindings)
    if (!is_unasked(r, t)) findings[t.key] = json_of(r.*t.finding, t);
  const Json faces = {{"triangles", r.faces.triangles}, {"quads", r.faces.quads}, {"polygons", r.faces.polygons}};
  Json proxy = {{"name", proxy_name},
                {"triangles", r.triangles},
                {"faces", faces},
                {"vertices", r.vertices},
                {"merged_vertices", r.merged_vertices},
                {"components", r.components},
                {"euler", r.euler}};
  proxy["genus"] = r.genus ? Json(*r.genus) : Json(nullptr);
  const auto json_or_null = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
  Json measures = {{"volume", json_or_null(r.volume)}};
  measures["scene_volume"] = json_or_null(r.scene_volume);
  measures["volume_ratio"] = json_or_null(volume_ratio(r));
  measures["edge_length"] = {{"min", r.edge_min}, {"mean", r.edge_mean}, {"max", r.edge_max}};
  measures["angle_min_degrees"] = r.angle_min_degrees;
  measures["scene_to_proxy"] = json_of(r.scene_to_proxy);
  measures["proxy_to_scene"] = json_of(r.proxy_to_scene);
  if (r.margin > 0) measures["margin"] = r.margin, measures["least_distance"] = json_or_null(r.least_gap);
  measures["note"] = r.distance_note;
  Json all = {{"holds", r.holds()}, {"answer", to_string(r.answer())}};
  all["why"] = r.answer() == Answer::undecided ? Json(doubt_of(r)) : Json(nullptr);
  all["verdict"] = verdict_of(r);
  all["answers"] = answers_of(r);
  all["proxy"] = std::move(proxy);
  all["scene"] = scene_json(r);
  all["findings"] = std::move(findings);
  all["measures"] = std::move(measures);
  return all;
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::optional<Vec3d> first_place(const CheckReport& r) {
  for (const FindingText& t : kFindings) {
    if (is_aside(r, t)) continue;
    for (const Example& e : (r.*t.finding).examples)
      if (std::isfinite(e.position[0]) && std::isfinite(e.position[1]) && std::isfinite(e.position[2]))
        return e.position;
  }
  return {};
}

std::string failures(const CheckReport& r) {
  std::string text = r.empty() ? "the proxy is empty" : "";
  for (const FindingText& t : kFindings) {
    if ((r.*t.finding).count == 0 || is_aside(r, t)) continue;
    if (!text.empty()) text += "; ";
    text += counted(r.*t.finding, t);
  }
  return text;
}

std::string verdict_text(const CheckReport& r, const std::string& proxy_name) {
  std::string text = fmt::format("proxy {}: {}, {} vertices, {} component{}", proxy_name, r.faces.text(), r.vertices,
                                 r.components, r.components == 1 ? "" : "s");
  if (r.genus) text += fmt::format(", genus {}", *r.genus);
  text.append("\n").append(scene_lines(r));
  text += row("closed", r.closed()) + row("oriented", r.oriented()) + row("2-manifold", r.manifold());
  text += row("free of self-intersections", r.embedded());
  text += row("facing outwards",
              !r.sides_decided ? Answer::undecided
              : r.outward()    ? Answer::proven
                               : Answer::refuted,
              kNoOutside);
  text += row("no degenerate triangles", r.readable() && r.sound());
  if (r.wants_convex) text += row("each part convex", r.convex());
  text += enclosure_row(r);
  for (const FindingText& t : kFindings)
    if (!is_aside(r, t)) text += finding_lines(r.*t.finding, t);
  text += measure_lines(r);
  if (r.answer() == Answer::undecided) return text + fmt::format("not decided: {}\n", doubt_of(r));
  return text + (r.holds() ? "holds\n" : fmt::format("does not hold: {}\n", failures(r)));
}

std::string verdict_json(const CheckReport& r, const std::string& proxy_name) {
  return text_of(json_of(r, proxy_name));
}

Answer answer_of(const std::vector<CheckReport>& levels) {
  Answer all = Answer::proven;
  for (const CheckReport& r : levels) all = all_of(all, r.answer());
  return all;
}

std::string verdict_text(const std::vector<CheckReport>& levels, const std::string& proxy_name) {
  if (levels.size() == 1) return verdict_text(levels[0], proxy_name);
  std::string text, failed, open;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    text += verdict_text(levels[i], fmt::format("{} level {}", proxy_name, i));
    const Answer answer = levels[i].answer();
    if (answer == Answer::refuted) failed += fmt::format("{} {}", failed.empty() ? "" : ",", i);
    if (answer == Answer::undecided) open += fmt::format("{} {}", open.empty() ? "" : ",", i);
  }
  if (!open.empty())
    text += fmt::format("{}: of {} levels these are not decided:{}\n", proxy_name, levels.size(), open);
  if (failed.empty() && !open.empty()) return text;
  if (failed.empty()) return text + fmt::format("{}: all {} levels hold\n", proxy_name, levels.size());
  return text + fmt::format("{}: of {} levels these do not hold:{}\n", proxy_name, levels.size(), failed);
}

std::string verdict_json(const std::vector<CheckReport>& levels, const std::string& proxy_name) {
  if (levels.size() == 1) return verdict_json(levels[0], proxy_name);
  const Answer answer = answer_of(levels);
  Json all = {{"holds", answer == Answer::proven}, {"answer", to_string(answer)}, {"levels", Json::array()}};
  for (const CheckReport& r : levels) all["levels"].push_back(json_of(r, proxy_name));
  return text_of(all);
}

}  // namespace bp
