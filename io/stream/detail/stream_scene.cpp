#include "io/stream/detail/stream_scene.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/stream/stream_layout.h"
#include "lib/core/error.h"

namespace bp::detail {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kHashDigits = 32;
constexpr std::uint64_t kMostSceneTriangles = std::uint64_t(1) << 40;  // a larger claim is damage

bool is_hash(const std::string& text) {
  return text.size() == kHashDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// Returns whether the stream can record a file's name. An empty name and "-" (stdin) name no file that can be read
/// again, and control characters would reach the terminal with a message.
bool is_file_name(const std::string& name) {
  constexpr unsigned char kFirstPrintable = 0x20, kDelete = 0x7f;
  return !name.empty() && name != "-" &&
         std::none_of(name.begin(), name.end(), [](unsigned char c) { return c < kFirstPrintable || c == kDelete; });
}

bool can_be_told(const SceneFiles& scene) {
  const auto has_name = [](const SceneFiles::File& file) { return is_file_name(file.name); };
  return !scene.files.empty() && is_hash(scene.hash) && std::all_of(scene.files.begin(), scene.files.end(), has_name);
}

/// Parses a text. Throws nlohmann's exceptions, and Error by `damaged`.
template <class Damaged>
SceneFiles parsed(const Json& json, const Damaged& damaged) {
  if (!json.is_object() || json.size() != 4 || !json.at("files").is_array() || json.at("files").empty()) damaged();
  SceneFiles scene;
  for (const Json& file : json.at("files")) {
    if (!file.is_object() || file.size() != 2 || !file.at("bytes").is_number_unsigned()) damaged();
    scene.files.push_back({file.at("name").get<std::string>(), file.at("bytes").get<std::uint64_t>()});
    if (!is_file_name(scene.files.back().name)) damaged();
  }
  if (!json.at("triangles").is_number_unsigned()) damaged();
  scene.format = json.at("format").get<std::string>();
  scene.triangles = json.at("triangles").get<std::uint64_t>();
  if (scene.triangles > kMostSceneTriangles) damaged();
  scene.hash = json.at("hash").get<std::string>();
  if (!is_hash(scene.hash)) damaged();
  return scene;
}

}  // namespace

std::string scene_text(const SceneFiles& scene) {
  if (!can_be_told(scene)) return "";
  Json files = Json::array();
  for (const SceneFiles::File& file : scene.files) files.push_back({{"name", file.name}, {"bytes", file.bytes}});
  const Json json{{"files", files}, {"format", scene.format}, {"triangles", scene.triangles}, {"hash", scene.hash}};
  try {
    const std::string text = json.dump();
    return text.size() <= kMaxSceneBytes ? text : "";
  } catch (const Json::exception&) {  // not UTF-8
    return "";
  }
}

SceneFiles scene_of(const std::string& text, const std::string& name) {
  const auto damaged = [&]() {
    fail(ErrorCode::bad_input, "{}: header: the scene files are not what they should be", name);
  };
  const Json::parser_callback_t shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > 3) damaged();
    return true;
  };
  try {
    return parsed(Json::parse(text, shallow), damaged);
  } catch (const Json::exception&) {
    fail(ErrorCode::bad_input, "{}: header: the scene files are not what they should be", name);
  }
}

}  // namespace bp::detail
