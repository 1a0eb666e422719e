#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lib/check/verdict_text.h"
#include "lib/check/verdict_words.h"

namespace bp {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Finding& f, const FindingText& t) {
  Json examples = Json::array();
  for (const Example& e : f.examples) {
    Json one = {{t.index, e.index}};
    if (t.other != nullptr) one[t.other] = e.other;
    one["position"] = e.position;
    examples.push_back(std::move(one));
  }
  Json finding = {{"count", f.count}};
  if (f.at_least) finding["at_least"] = true;  // the count ended early
  finding["examples"] = std::move(examples);
  return finding;
}

Json json_of(const std::optional<SampledDistance>& d) {
  if (!d) return nullptr;
  Json j{{"sampled", !d->at_most}, {"samples", d->samples}, {"max", d->max}, {"mean", d->mean}, {"where", d->where}};
  j["at_most"] = d->at_most ? Json(*d->at_most) : Json(nullptr);
  return j;
}

Json json_of(const Unfollowed& u) {
  return {{"skins", u.skins},     {"morphs", u.morphs}, {"transforms", u.transforms}, {"vertices", u.vertices},
          {"missing", u.missing}, {"lines", u.lines},   {"placed", u.placed},         {"foreign", u.foreign},
          {"culled", u.culled},   {"hidden", u.hidden}, {"variants", u.variants}};
}

Json scene_json(const CheckReport& r) {
  if (!r.has_scene) return nullptr;
  const SceneCounts& c = r.scene_counts;
  Json scene = {
      {"name", r.scene_name},
      {"triangles", r.scene_triangles},
      {"without_area", c.kept_degenerate},
      {"skipped",
       {{"degenerate", c.degenerate - c.kept_degenerate}, {"non_finite", c.non_finite}, {"bad_faces", c.bad_faces}}},
      {"differing", c.differing},
      {"not_flat", {{"polygons", r.bent}, {"not_proven_over_other_diagonals", r.bent_open}}},
      {"instances", c.instances},
      {"animations", c.animations}};
  if (c.unfollowed.any()) scene["not_followed"] = json_of(c.unfollowed);
  if (c.rounding.any()) scene["rounding"] = c.rounding.most;
  return scene;
}

Json verdict_of(const CheckReport& r) {
  // "Sound" as in docs/contracts.md, whereas r.sound() is about single triangles.
  const bool sound = r.sound() && r.closed() && r.oriented() && r.manifold() && r.embedded();
  Json v = {{"readable", r.readable()},
            {"sound", sound},
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
  if (r.wants_inside && r.sides_decided) a["free_of_scene"] = to_string(r.free_of_scene());
  if (r.margin > 0) a["margin"] = to_string(r.keeps_margin());
  if (r.asks_hidden) a["hidden"] = to_string(r.hiddenness());
  return a;
}

Json recipe_json(const CheckReport& r) {
  Json json = {{"voxel", r.recipe.frame.voxel},
               {"scale", r.recipe.scale_world},
               {"closed_gap", r.recipe.closed_gap(r.hidden_off)},
               {"element", r.recipe.element == StructuringElement::ball ? "ball" : "cube"},
               {"walls", r.recipe.opaque_only ? "opaque" : "all"},
               {"ground", r.recipe.ground},
               {"up", name_of(r.recipe.frame.up)}};
  if (r.recipe.body_world > 0) json["body"] = r.recipe.body_world;
  return json;
}

Json json_of(const CheckReport& r, const std::string& proxy_name) {
  Json findings = Json::object();
  for (const FindingText& t : finding_texts())
    if (!is_unasked(r, t)) findings[t.key] = json_of(r.*t.finding, t);
  const Json faces = {{"triangles", r.faces.triangles}, {"quads", r.faces.quads}, {"polygons", r.faces.polygons}};
  Json proxy = {
      {"name", proxy_name},
      {"triangles", r.triangles},
      {"faces", faces},
      {"vertices", r.vertices},
      {"not_flat", {{"faces", r.bent_faces}, {"not_proven_over_other_diagonals", r.holds() ? 0 : r.bent_faces}}},
      {"merged_vertices", r.merged_vertices},
      {"components", r.components},
      {"euler", r.euler}};
  proxy["genus"] = r.genus ? Json(*r.genus) : Json(nullptr);
  if (r.unfollowed.any()) proxy["not_followed"] = json_of(r.unfollowed);
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
  if (r.asks_hidden) all["hidden"] = recipe_json(r);
  all["findings"] = std::move(findings);
  all["measures"] = std::move(measures);
  return all;
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string verdict_json(const CheckReport& r, const std::string& proxy_name) {
  return text_of(json_of(r, proxy_name));
}

std::string verdict_json(const std::vector<CheckReport>& levels, const std::string& proxy_name) {
  if (levels.size() == 1) return verdict_json(levels[0], proxy_name);
  const Answer answer = answer_of(levels);
  Json all = {{"holds", answer == Answer::proven}, {"answer", to_string(answer)}, {"levels", Json::array()}};
  for (const CheckReport& r : levels) all["levels"].push_back(json_of(r, proxy_name));
  return text_of(all);
}

}  // namespace bp
