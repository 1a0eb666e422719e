#include "tools/run/hiding_recipe.h"

#include <fmt/format.h>

#include "lib/core/error.h"
#include "tools/cli/length.h"
#include "tools/cli/names.h"
#include "tools/run/grounded_source.h"

namespace bp {

namespace {

/// Returns the value of "key=value" among words; throws bad_argument if there is none.
std::string value_of(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(" " + key + "=");
  if (at == std::string::npos) fail(ErrorCode::bad_argument, "no {}", key);
  const std::size_t begin = at + key.size() + 2;
  return line.substr(begin, line.find(' ', begin) - begin);
}

/// Returns the number of "key=value" among words; 0 if there is none.
double number_or_0(const std::string& line, const std::string& key) {
  return line.find(" " + key + "=") == std::string::npos ? 0 : parse_number(value_of(line, key));
}

HidingRecipe parsed(const std::string& line) {
  constexpr std::int64_t kMost = std::int64_t(1) << 50;
  HidingRecipe recipe;
  recipe.frame.voxel = parse_number(value_of(line, "voxel"));
  recipe.scale_world = parse_number(value_of(line, "openings"));
  recipe.element = value_of(line, "element") == "ball" ? StructuringElement::ball : StructuringElement::cube;
  recipe.body_world = number_or_0(line, "body");
  std::size_t i = 0;
  for_each_item(value_of(line, "grid"), [&](std::string_view number) {
    if (i == 3) fail(ErrorCode::bad_argument, "a grid of more than three numbers");
    recipe.frame.origin[i++] = parse_integer(number, -kMost, kMost);
  });
  if (i != 3) fail(ErrorCode::bad_argument, "a grid of fewer than three numbers");
  recipe.opaque_only = value_of(line, "walls") == "opaque";
  recipe.ground = value_of(line, "ground") == "yes";
  const std::optional<UpAxis> up = up_axis_named(value_of(line, "up"));
  if (!up) fail(ErrorCode::bad_argument, "no axis that points up");
  recipe.frame.up = *up;
  return recipe;
}

/// Returns whether the axis of a recipe has a meaning, and is not the one by which the file was turned.
bool is_turned(const HidingRecipe& recipe, const MeshExtras& extras) {
  const bool has_up = recipe.ground || recipe.body_world > 0;
  return has_up && extras.up.value_or(name_of(UpAxis::y)) != name_of(recipe.frame.up);
}

}  // namespace

void add_recipe(const HidingRecipe& recipe, OptionText& text) {
  const GridFrame& frame = recipe.frame;
  text.add("openings", recipe.scale_world).add("element", name_of(recipe.element));
  if (recipe.body_world > 0) text.add("body", recipe.body_world);
  text.add("walls", recipe.opaque_only ? "opaque" : "all").add("ground", recipe.ground).add("up", name_of(frame.up));
  text.add("voxel", frame.voxel);
  text.add("grid", fmt::format("{},{},{}", frame.origin[0], frame.origin[1], frame.origin[2]));
}

std::optional<HidingRecipe> hiding_recipe(const MeshExtras& extras) {
  if (mode_of(extras) != "inside") return {};
  try {
    const HidingRecipe recipe = parsed(extras.provenance.back());
    return is_turned(recipe, extras) ? std::nullopt : std::optional(recipe);
  } catch (const Error&) {
    return {};
  }
}

Walls walls_of(const MeshExtras& extras, const std::function<std::unique_ptr<TriangleSource>(bool opaque_only)>& open) {
  const std::optional<HidingRecipe> recipe = hiding_recipe(extras);
  if (!recipe) return {};
  Walls walls{open(recipe->opaque_only), {}};
  if (recipe->ground) walls.source = std::make_unique<GroundedSource>(std::move(walls.source), recipe->frame.up);
  walls.question = HidingQuestion{*recipe, walls.source.get()};
  return walls;
}

}  // namespace bp
