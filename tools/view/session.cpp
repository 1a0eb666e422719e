#include "tools/view/session.h"

#include <algorithm>
#include <filesystem>

#include "io/files/file.h"
#include "io/files/json_shape.h"
#include "io/scene/scene_reader.h"
#include "io/stream/brick_shelf.h"
#include "io/stream/brick_stream.h"
#include "lib/core/error.h"
#include "tools/cli/names.h"
#include "tools/run/memory_shares.h"
#include "tools/run/part_boxes.h"
#include "tools/run/read_again.h"

namespace bp {

namespace {

constexpr std::uint64_t kMostShown = 2'000'000;  ///< triangles: a page that draws more is slow
constexpr std::uint64_t kBytesOfTriangle = 320;  ///< while its mesh and its message are made
constexpr std::uint64_t kMostFaces = 10'000'000;
constexpr std::uint64_t kMostFiles = 1'000'000;
constexpr const char* kFirstRules = R"({"base": "2%"})";

Json parse_request(const std::string& text) {
  const bool is_deep = json_shape(text).is_too_deep();
  Json json = is_deep ? Json() : Json::parse(text, nullptr, false);
  if (!json.is_object()) fail(ErrorCode::bad_input, "the request is no JSON object");
  return json;
}

const Json& member(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end()) fail(ErrorCode::bad_input, "the request has no '{}'", key);
  return *found;
}

std::string word(const Json& json, const char* key) {
  const Json& value = member(json, key);
  if (!value.is_string()) fail(ErrorCode::bad_input, "the request's '{}' is no text", key);
  return value.get<std::string>();
}

std::uint64_t number(const Json& json, const char* key, std::uint64_t least, std::uint64_t most) {
  const Json& value = member(json, key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() < least || value.get<std::uint64_t>() > most)
    fail(ErrorCode::bad_input, "the request's '{}' is no whole number from {} to {}", key, least, most);
  return value.get<std::uint64_t>();
}

bool flag(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_boolean() && found->get<bool>();
}

Vec3d minus(const Vec3d& p) {
  return {-p[0], -p[1], -p[2]};
}

const char* step_name(ProxyJob::Step step) {
  constexpr const char* kNames[] = {"none", "meshing", "checking", "ready", "failed", "stopped"};
  return kNames[std::size_t(step)];
}

/// Returns how many triangles a page shows: as many as half of --memory suffices for.
std::uint64_t most_shown(const ViewOptions& o) {
  return std::min(kMostShown, o.common.memory_bytes / 2 / kBytesOfTriangle);
}

}  // namespace

Session::Session(const ViewOptions& options, Backends& backends)
    : options_(options), most_shown_(most_shown(options)), faces_(options.faces) {
  open_stream();
  scene_ = std::make_unique<ShownScene>(options_, header_, middle_, most_shown_, events_);
  const auto open = [this] { return open_scenes(options_.voxels.scenes, scene_options(options_)); };
  distances_ = std::make_unique<SceneDistances>(open, middle_, options_.common.memory_bytes / 4);
  begin_design();
  made_.emplace(options_.common.memory_bytes / 32);
  layers_ = std::make_unique<Layers>(options_, [this] { changed(); });
  job_ = std::make_unique<ProxyJob>(options_, stream_, [this] { changed(); });
  LiveScene scene;
  scene.header = header_;
  scene.solid = std::move(solid_);
  scene.params.element = options_.closing.element;
  scene.triangles = [this](const auto& take) {
    read_again(header_.scene, header_.bounds, scene_options(options_), take);
  };
  const MemoryLimit limit{options_.common.memory_bytes, kVoxelProgram};
  scene.context.memory = {limit.rest_bytes() / 4, 0.25, limit};
  scene.context.make_shelf = make_shelf_factory(limit.rest_bytes() / 4, options_.common.temp);
  closing_ = std::make_unique<LiveClosing>(std::move(scene), backends, [this] { changed(); });
  closing_->request(design_->plan(), design_->revision());
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  events_.end();
  closing_.reset();
  job_.reset();
  layers_.reset();
}

/// Runs bpvox itself to make the stream, since the proxy is made from the same stream.
void Session::open_stream() {
  const ToolResult result = ToolPipe().run({voxelize_command(options_)}, {}, stream_, true);
  if (result.status != 0)
    fail(result.status == 2   ? ErrorCode::bad_argument
         : result.status == 3 ? ErrorCode::bad_input
                              : ErrorCode::failed,
         "bpvox could not read the scene");
  BrickReader reader(stream_.path());
  header_ = reader.header();
  solid_ = make_shelf(options_.common.memory_bytes / 8, options_.common.temp);
  for_bricks(reader, [&](const Brick& brick) {
    if (brick.layer == Layer::solid) solid_->put(brick.coord, brick.fill, brick.bits);
  });
  for (std::size_t i = 0; i < 3; ++i) middle_[i] = header_.bounds.min[i] / 2 + header_.bounds.max[i] / 2;
}

void Session::begin_design() {
  RuleContext context;
  context.diagonal = header_.bounds.diagonal();
  context.voxel = header_.frame.voxel;
  context.may_orient = true;
  context.parts = [this](const std::string& pattern) {
    return part_boxes(header_.scene, header_.bounds, pattern, scene_options(options_));
  };
  const bool there = options_.rules_given && std::filesystem::exists(options_.rules);
  design_.emplace(there ? read_text(options_.rules) : kFirstRules, options_.rules, context, header_.frame);
  saved_revision_ = there ? design_->revision() : 0;
}

void Session::changed() {
  {
    const std::lock_guard lock(mutex_);
    if (!ends_) made_->add(job_->status());
    if (live_ && !ends_) {
      const LiveClosing::Status s = closing_->status();
      const bool done = s.shown == design_->revision() && s.error.empty();
      if (done && (meshed_ != design_->revision() || meshed_faces_ != faces_)) request_proxy();
    }
  }
  events_.tell();
}

void Session::request_proxy() {
  meshed_ = design_->revision();
  meshed_faces_ = faces_;
  job_->request(design_->json(), meshed_, meshed_faces_);
}

bool Session::is_current(const ProxyJob::Status& proxy) const {
  return proxy.revision == design_->revision() && proxy.faces == faces_;
}

std::uint64_t Session::edit(const std::string& json) {
  const Json request = parse_request(json);
  const std::string op = word(request, "op");
  std::uint64_t revision = 0;
  {
    const std::lock_guard lock(mutex_);
    const std::uint64_t before = design_->revision();
    if (op == "rule") {
      design_->add(member(request, "rule").dump(), flag(request, "again"));
    } else if (op == "base") {
      design_->set_base(member(request, "base").dump(), flag(request, "again"));
    } else if (op == "orientation") {
      design_->set_orientation(member(request, "orientation").dump(), flag(request, "again"));
    } else if (op == "remove") {
      design_->remove(number(request, "rule", 0, Design::kMostRules));
    } else if (op == "undo") {
      design_->undo();
    } else if (op == "redo") {
      design_->redo();
    } else if (op == "faces") {
      faces_ = number(request, "faces", 4, kMostFaces);
      if (live_) request_proxy();
    } else if (op == "live") {
      live_ = flag(request, "live");
      if (live_ && (meshed_ != design_->revision() || meshed_faces_ != faces_)) request_proxy();
    } else {
      fail(ErrorCode::bad_input, "the request's 'op' is not known");
    }
    revision = design_->revision();
    if (revision != before) {
      job_->stop();
      closing_->request(design_->plan(), revision);
    }
  }
  events_.tell();
  return revision;
}

void Session::mesh() {
  const std::lock_guard lock(mutex_);
  const ProxyJob::Status proxy = job_->status();
  if (proxy.step == ProxyJob::Step::ready && is_current(proxy)) return;  // it would have the same bytes
  request_proxy();
}

void Session::stop() {
  job_->stop();
}

void Session::save(const std::string& json) {
  const std::string what = word(parse_request(json), "what");
  {
    const std::lock_guard lock(mutex_);
    const auto write = [&](const std::string& path, const std::string& bytes, bool overwrite) {
      OutputFile file(path, overwrite);
      file.write(bytes);
      file.commit();
    };
    if (what == "rules") {
      write(options_.rules, design_->json(), options_.common.overwrite || options_.rules_given || rules_saved_);
      rules_saved_ = true;
      saved_revision_ = design_->revision();
    } else if (what == "proxy") {
      const ProxyJob::Status proxy = job_->status();
      if (proxy.step != ProxyJob::Step::ready || !is_current(proxy))
        fail(ErrorCode::bad_input, "there is no proxy of the design as it is now");
      write(options_.out, *proxy.file, options_.common.overwrite || proxy_saved_);
      proxy_saved_ = true;
      saved_proxy_ = proxy.number;
    } else {
      fail(ErrorCode::bad_input, "the request's 'what' is neither rules nor proxy");
    }
  }
  events_.tell();
}

std::string Session::rules() const {
  const std::lock_guard lock(mutex_);
  return design_->json();
}

/// Positions in between are as far apart as half a voxel at least: the closing knows nothing finer.
std::string Session::bytes_of(ShownMesh mesh, bool distances) const {
  if (distances) distances_->add_to(mesh, header_.frame.voxel / 2);
  return mesh.bytes();
}

std::shared_ptr<const std::string> Session::proxy_file(std::uint64_t number) const {
  if (number == 0) return job_->status().file;
  const std::lock_guard lock(mutex_);
  return made_->file(number);
}

std::string Session::proxy(std::uint64_t number, bool distances) const {
  const auto file = proxy_file(number);
  if (file == nullptr) return "";
  const MemoryFile glb(*file);
  const IndexedMesh mesh = read_mesh(glb.path(), scene_options(options_));
  if (mesh.triangles.size() > most_shown_)
    fail(ErrorCode::out_of_resource, "the proxy has more than {} triangles, and is not shown", most_shown_);
  return bytes_of(shown_mesh(mesh, minus(middle_)), distances);
}

std::string Session::layer(std::uint64_t file, std::uint64_t level, bool distances) const {
  return bytes_of(read_level(layers_->file(file), level, middle_, most_shown_, scene_options(options_)), distances);
}

void Session::check(const std::string& json) {
  layers_->check(number(parse_request(json), "file", 0, kMostFiles));
}

Json Session::design_json() const {
  Json rules = Json::array();
  for (std::size_t i = 0; i < design_->rules(); ++i) {
    Json rule = Json::parse(design_->rule(i));
    if (const auto at = rule.find("at"); at != rule.end() && at->is_array() && at->size() > 4)
      // Only the first and the last point: the page lists rules and does not draw them.
      *at = Json::array({at->front(), at->back()});
    rules.push_back(std::move(rule));
  }
  return {{"revision", design_->revision()},
          {"base", Json::parse(design_->base())},
          {"base_world", design_->plan().field.base},
          {"rules", std::move(rules)},
          {"orientation", design_->orientation().empty() ? Json() : Json::parse(design_->orientation())},
          {"can_undo", design_->can_undo()},
          {"can_redo", design_->can_redo()},
          {"saved", saved_revision_ == design_->revision()}};
}

Json Session::proxy_json() const {
  const ProxyJob::Status p = job_->status();
  return {{"step", step_name(p.step)},
          {"current", is_current(p)},
          {"revision", p.revision},
          {"faces", p.faces},
          {"number", p.number},
          {"saved", p.number != 0 && p.number == saved_proxy_},
          {"bytes", p.file ? p.file->size() : 0},
          {"mesh_seconds", p.mesh_seconds},
          {"check_seconds", p.check_seconds},
          {"notes", p.notes},
          {"verdict", p.verdict}};
}

std::string Session::state() const {
  const std::lock_guard lock(mutex_);
  const LiveClosing::Status c = closing_->status();
  const Bounds3d& b = header_.bounds;
  Json files = Json::array();
  for (const std::string& scene : options_.voxels.scenes)
    files.push_back(std::filesystem::path(scene).filename().string());
  const Json state{{"scene",
                    {{"files", files},
                     {"triangles", header_.scene.triangles},
                     {"shown", !scene_->bytes().empty()},
                     {"most_shown", most_shown_},
                     {"min", b.min},
                     {"max", b.max},
                     {"diagonal", b.diagonal()},
                     {"middle", middle_},
                     {"voxel", header_.frame.voxel},
                     {"origin", header_.frame.world_origin()},
                     {"up", name_of(header_.frame.up)}}},
                   {"design", design_json()},
                   {"closing",
                    {{"asked", c.asked},
                     {"shown", c.shown},
                     {"generation", c.generation},
                     {"drawn_voxel", c.drawn_voxel},
                     {"voxels", c.voxels},
                     {"seconds", c.seconds},
                     {"error", c.error}}},
                   {"proxy", proxy_json()},
                   {"element", name_of(options_.closing.element)},
                   {"layers", layers_->json()},
                   {"made", made_->json()},
                   {"faces", faces_},
                   {"live", live_},
                   {"rules_file", options_.rules},
                   {"out_file", options_.out},
                   {"command", command_line(options_, faces_)}};
  return state.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace bp
