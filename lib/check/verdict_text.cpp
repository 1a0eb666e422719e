#include "lib/check/verdict_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lib/check/counted.h"
#include "lib/check/scene_words.h"
#include "lib/check/verdict_words.h"
#include "lib/geometry/signed_volume.h"
#include "lib/volume/entered.h"

namespace bp {

namespace {

/// Returns an explanation if the proxy has less volume than the scene that it encloses: the scene winds around a place
/// twice, or has a hollow.
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

std::string row(const char* question, Answer answer, const std::string& why) {
  if (answer != Answer::undecided) return row(question, answer == Answer::proven);
  return fmt::format("  {:<28}not decided: {}\n", question, one_line(why));
}

/// Returns the recipe that the proxy's file names, on which the answer depends.
std::string recipe_text(const CheckReport& r) {
  const HidingRecipe& recipe = r.recipe;
  std::string text = fmt::format("its file names voxels of {:.4g}", recipe.frame.voxel);
  if (recipe.scale_world > 0) text += fmt::format(" and a closing scale of {:.4g}", recipe.scale_world);
  if (recipe.ground)
    text += fmt::format("; the scene is taken to stand on the ground, {} up", name_of(recipe.frame.up));
  // A triangle lies within hidden_off of where it was read, and G within as much of that: on both sides of a body.
  const double doubt = 4 * r.hidden_off;
  if (recipe.body_world > 0)
    text +=
        fmt::format("; rooms count as outside if a body {:.4g} high, {} up, and {:.4g} wide along the axes can enter",
                    recipe.body_world + doubt, name_of(recipe.frame.up), recipe.body_world * kBodyWidth + doubt);
  if (!recipe.opaque_only) text += "; transparent triangles are walls";
  return text;
}

/// Returns the rows on parts outside. Inner walls may lie in the hidden space: then it is no failure.
std::string inside_rows(const CheckReport& r) {
  std::string text;
  const bool other = r.asks_hidden && r.hiddenness() == Answer::proven;  // then these findings decide nothing
  const auto add = [&](const char* question, Answer answer) {
    if (!other || answer == Answer::proven) text += row(question, answer, scene_doubt(r));
  };
  if (r.sides_decided) add("free of the scene", r.free_of_scene());
  add("strictly inside the scene", r.insideness());
  if (!r.asks_hidden) return text;
  if (r.hiddenness() != Answer::proven) return text + row("hidden from outside", r.hiddenness(), hidden_doubt(r));
  return text + fmt::format("  {:<28}yes, if gaps narrower than {:.4g} count as closed: {}\n", "hidden from outside",
                            r.recipe.closed_gap(r.hidden_off), recipe_text(r));
}

/// Returns whether a finding is no failure: because the question asked instead is decided, or because triangles that
/// cannot be judged may hide the part.
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
  std::string text = fmt::format("scene {}: {}\n", one_line(r.scene_name), bp::counted(r.scene_triangles, "triangle"));
  text += left_out_lines(c, "  ");
  if (c.rounding.most > 0) text += fmt::format("  coordinates are read to within {:.2g}\n", c.rounding.most);
  if (c.kept_degenerate > 0)
    text +=
        fmt::format("  {} without area: checked as segments or points\n", bp::counted(c.kept_degenerate, "triangle"));
  if (r.bent > 0)
    text += fmt::format(
        "  {} not flat, and proven as the triangles that were read; {} of them {} proven over other diagonals, too\n",
        r.bent == 1 ? "1 polygon is" : fmt::format("{} polygons are", r.bent), r.bent - r.bent_open,
        r.bent - r.bent_open == 1 ? "is" : "are");
  if (c.animations > 0)
    text += "  " + bp::counted(c.animations, "animation") + " not followed: this is the scene before it moves\n";
  return text;
}

/// Returns the line of a distance. `what`: the points from which it is measured.
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

}  // namespace

std::optional<Vec3d> first_place(const CheckReport& r) {
  for (const FindingText& t : finding_texts()) {
    if (is_aside(r, t)) continue;
    for (const Example& e : (r.*t.finding).examples)
      if (std::isfinite(e.position[0]) && std::isfinite(e.position[1]) && std::isfinite(e.position[2]))
        return e.position;
  }
  return {};
}

std::string failures(const CheckReport& r) {
  std::string text = r.empty() ? "the proxy is empty" : "";
  for (const FindingText& t : finding_texts()) {
    if ((r.*t.finding).count == 0 || is_aside(r, t)) continue;
    if (!text.empty()) text += "; ";
    text += counted(r.*t.finding, t);
  }
  return text;
}

std::string verdict_text(const CheckReport& r, const std::string& proxy_name) {
  std::string text = fmt::format("proxy {}: {}, {} vertices, {} component{}", one_line(proxy_name), r.faces.text(),
                                 r.vertices, r.components, r.components == 1 ? "" : "s");
  if (r.genus) text += fmt::format(", genus {}", *r.genus);
  text += "\n";
  if (r.unfollowed.any()) text += "  not followed: " + not_followed(r.unfollowed) + "\n";
  if (r.bent_faces > 0 && r.holds())
    text += fmt::format("  {} not flat, and proven over either diagonal\n",
                        r.bent_faces == 1 ? "1 quad is" : fmt::format("{} quads are", r.bent_faces));
  text += scene_lines(r);
  for (const auto& [question, fine] :
       {std::pair{"closed", r.closed()}, {"oriented", r.oriented()}, {"2-manifold", r.manifold()}})
    text += row(question, r.on_edges(fine), "the proxy has coordinates that are too large or too small");
  text += row("free of self-intersections",
              r.pairs_open() ? Answer::undecided
              : r.embedded() ? Answer::proven
                             : Answer::refuted,
              "too many triangles lie side by side");
  text += row("facing outwards",
              !r.sides_decided ? Answer::undecided
              : r.outward()    ? Answer::proven
                               : Answer::refuted,
              kNoOutside);
  text += row("no degenerate triangles",
              r.sound() && r.bad_faces.count + r.non_finite_vertices.count == 0 && !r.empty() ? r.on_edges(r.readable())
                                                                                              : Answer::refuted,
              "the proxy has coordinates that are too large or too small");
  if (r.wants_convex) text += row("each part convex", r.convex());
  text += enclosure_row(r);
  for (const FindingText& t : finding_texts())
    if (!is_aside(r, t)) text += finding_lines(r.*t.finding, t);
  text += measure_lines(r);
  if (r.answer() == Answer::undecided) return text + fmt::format("not decided: {}\n", one_line(doubt_of(r)));
  return text + (r.holds() ? "holds\n" : fmt::format("does not hold: {}\n", failures(r)));
}

Answer answer_of(const std::vector<CheckReport>& levels) {
  Answer all = Answer::proven;
  for (const CheckReport& r : levels) all = all_of(all, r.answer());
  return all;
}

std::string verdict_text(const std::vector<CheckReport>& levels, const std::string& name) {
  const std::string proxy_name = one_line(name);
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

}  // namespace bp
