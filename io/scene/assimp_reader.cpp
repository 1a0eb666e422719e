#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <new>
#include <utility>

#include "io/files/kept_files.h"
#include "io/scene/detail/assimp_answer.h"
#include "io/scene/detail/assimp_bones.h"
#include "io/scene/detail/assimp_files.h"
#include "io/scene/detail/child_process.h"
#include "io/scene/detail/exact/exact_scene.h"
#include "io/scene/detail/foreign_format.h"
#include "io/scene/instanced_scene.h"
#include "lib/core/error.h"

// Reads every format without a reader of its own, through Assimp. Its importers are not made for broken files (they
// crash, loop, or take all memory), so they run in a child process. The child writes each mesh once to a scratch file,
// as packed positions and triangles, and sends back the places of the meshes. Its memory ends with it; from there on
// the scene is streamed as glTF is. No postprocessing is used: polygons become triangles as in all readers, points and
// lines are dropped, and node transforms are composed in double.

namespace bp {

namespace {

constexpr std::uint64_t kMaxFileBytes = std::uint64_t(400) << 20;
constexpr std::uint64_t kMaxMemoryBytes = std::uint64_t(16) << 30;

std::string remedy_for(const std::string& name) {
  const std::string way = foreign_way(name);
  return way.empty() ? "convert it to GLB, PLY or OBJ" : way;
}

constexpr std::uint64_t kAnswerCopies = 4;  // the answer is copied: as bytes, and as the description that is made of it

/// Returns the limits of the child. Assimp takes some 20 times the size of a file; this allows twice as much. The
/// answer gets a quarter of the document's memory once the child is gone.
ChildLimits limits_for(std::uint64_t file_bytes, const MemoryShare& budget) {
  ChildLimits limits;
  limits.memory_bytes = std::min(kMaxMemoryBytes, (std::uint64_t(1) << 30) + 40 * file_bytes);
  limits.cpu_seconds = 5 + file_bytes / 50000;
  limits.wall_seconds = 600 + 4 * limits.cpu_seconds;  // a busy machine needs more time
  if (budget.bytes == 0) return limits;
  limits.memory_bytes = std::min(limits.memory_bytes, budget.bytes);
  limits.answer_bytes = budget.bytes / kAnswerCopies;
  return limits;
}

bool is_ac3d(const std::string& extension) {
  return extension == "ac" || extension == "acc" || extension == "ac3d";
}

/// Returns about how many bytes an importer takes for each byte of a file: the limit that a refusal names must suffice.
/// Measured with files of loose triangles, 8 to 31 MB: 7 for AC3D, 11 for COLLADA, 8 for DXF. For others see
/// limits_for().
std::uint64_t bytes_per_byte(const std::string& extension) {
  if (extension == "dae") return 16;
  return is_ac3d(extension) ? 8 : 20;
}

std::string importer_of(const std::string& extension) {
  return "the importer of ." + extension + " files";
}

[[noreturn]] void fail_memory(const std::string& name, const std::string& extension, std::uint64_t file_bytes,
                              const ChildLimits& limits, const MemoryShare& budget) {
  const std::string what = importer_of(extension);
  if (budget.bytes == 0 || limits.memory_bytes < budget.bytes) {
    fail(ErrorCode::bad_input, "{}: {} wants more than {} MiB, too much for a file of this size; repair it, or {}",
         name, what, limits.memory_bytes >> 20, remedy_for(name));
  }
  const std::uint64_t wanted = std::max(2 * limits.memory_bytes, bytes_per_byte(extension) * file_bytes);
  throw Error(ErrorCode::out_of_resource,
              fmt::format("{}: {} takes more than the {} MiB that the limit on memory leaves for it; {}", name, what,
                          limits.memory_bytes >> 20, remedy_for(name)),
              {Remedy::more_memory}, budget.limit_with(wanted - budget.bytes));
}

// --- In the child
// --------------------------------------------------------------------------------------------------------

class SceneUnloader {
 public:
  /// `exact`: lists that are known better than Assimp knows them.
  SceneUnloader(ScratchFile& scratch, const SceneOptions& options, const ExactScene& exact)
      : scratch_(scratch),
        exact_(exact),
        colors_(options.colors),
        walls_only_(options.walls_only),
        wants_textures_(options.textures != nullptr),
        textures_(scratch),
        cut_(options.fans) {}
  Summary unload(const aiScene& scene) {
    summary_.unfollowed = exact_.unfollowed;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
      const ExactMesh* const exact = exact_mesh(exact_, *scene.mMeshes[i], i);
      add_mesh(*scene.mMeshes[i], exact, walls_only_ && see_through(*scene.mMeshes[i], scene));
      add_positions(*scene.mMeshes[i], exact);
      if (exact_.is_known && exact == nullptr && summary_.meshes.back().triangles > 0) ++summary_.unfollowed.vertices;
      if (colors_) add_colors(*scene.mMeshes[i], scene);
      if (wants_textures_) summary_.meshes.back().texture = textures_.unload(*scene.mMeshes[i], scene);
    }
    if (scene.mRootNode != nullptr) add_nodes(scene);
    summary_.animations = scene.mNumAnimations;
    summary_.textures = textures_.names();
    summary_.bytes = scratch_.size();
    return std::move(summary_);
  }

 private:
  struct Pending {
    const aiNode* node;
    const ExactNode* exact;  // null: not known
    Affine parent;
  };
  static bool see_through(const aiMesh& mesh, const aiScene& scene);
  void add_mesh(const aiMesh& mesh, const ExactMesh* exact, bool passed_over);
  void add_positions(const aiMesh& mesh, const ExactMesh* exact);
  void add_colors(const aiMesh& mesh, const aiScene& scene);
  void add_face(const aiFace& face, const aiMesh& mesh, const ExactMesh* exact, std::vector<std::uint32_t>& indices);
  void add_nodes(const aiScene& scene);
  void follow_bones(const aiScene& scene, const BonePlaces& places);

  ScratchFile& scratch_;
  const ExactScene& exact_;
  const bool colors_, walls_only_, wants_textures_;
  TextureUnloader textures_;
  FaceTriangles cut_;
  Summary summary_;
};

bool SceneUnloader::see_through(const aiMesh& mesh, const aiScene& scene) {
  float opacity = 1;
  return mesh.mMaterialIndex < scene.mNumMaterials &&
         scene.mMaterials[mesh.mMaterialIndex]->Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS && opacity < 1;
}

// Adds a mesh. A mesh that is left out keeps its number, and has no triangles.
void SceneUnloader::add_mesh(const aiMesh& mesh, const ExactMesh* exact, bool passed_over) {
  MeshRecord record;
  record.vertices = mesh.mNumVertices;
  std::vector<std::uint32_t> indices;
  for (unsigned i = 0; i < mesh.mNumFaces && !passed_over; ++i) add_face(mesh.mFaces[i], mesh, exact, indices);
  record.indices = scratch_.append(std::as_bytes(std::span(indices)));
  record.triangles = indices.size() / 3;
  summary_.meshes.push_back(record);
}

// Writes the positions of the mesh that was added last.
void SceneUnloader::add_positions(const aiMesh& mesh, const ExactMesh* exact) {
  static_assert(sizeof(aiVector3D) == 3 * sizeof(float), "positions are written as they lie");
  MeshRecord& record = summary_.meshes.back();
  record.is_exact = exact != nullptr;
  record.off = record.is_exact ? exact->off : 0;
  record.positions = scratch_.append(record.is_exact ? std::as_bytes(std::span(exact->positions))
                                                     : std::as_bytes(std::span(mesh.mVertices, mesh.mNumVertices)));
}

// Writes the colours of the mesh that was added last. For formats without materials, Assimp invents a grey one.
void SceneUnloader::add_colors(const aiMesh& mesh, const aiScene& scene) {
  static_assert(sizeof(aiColor4D) == 4 * sizeof(float), "colours are written as they lie");
  MeshRecord& record = summary_.meshes.back();
  if (mesh.HasVertexColors(0))
    record.colors = scratch_.append(std::as_bytes(std::span(mesh.mColors[0], mesh.mNumVertices)));
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return;
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiColor3D c(1, 1, 1);
  if (std::strcmp(material.GetName().C_Str(), AI_DEFAULT_MATERIAL_NAME) == 0) return;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, c) == aiReturn_SUCCESS) record.base_color = {c.r, c.g, c.b};
}

// Adds a face. Points and lines do not count as bad faces: drawings are full of them.
void SceneUnloader::add_face(const aiFace& face, const aiMesh& mesh, const ExactMesh* exact,
                             std::vector<std::uint32_t>& indices) {
  if (face.mNumIndices < 3) return;
  if (std::any_of(face.mIndices, face.mIndices + face.mNumIndices,
                  [&](unsigned v) { return v >= mesh.mNumVertices; })) {
    ++summary_.bad_faces;
    return;
  }
  cut_.cut(face.mNumIndices, [&](std::size_t k) {
    const unsigned v = face.mIndices[k];
    return exact != nullptr ? exact->positions[v]
                            : Vec3d{mesh.mVertices[v].x, mesh.mVertices[v].y, mesh.mVertices[v].z};
  });
  for (std::size_t i = 0; i < cut_.triangles(); ++i) {
    for (const std::uint32_t k : cut_[i]) indices.push_back(face.mIndices[k]);
  }
}

void SceneUnloader::add_nodes(const aiScene& scene) {
  const bool has_bones =
      std::any_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes, [](const aiMesh* m) { return m->HasBones(); });
  BonePlaces places;
  const ExactNode* const root = exact_.root ? &*exact_.root : nullptr;
  if (root == nullptr && exact_.is_known) ++summary_.unfollowed.transforms;
  std::vector<Pending> stack{{scene.mRootNode, root, Affine()}};
  while (!stack.empty()) {
    Pending next = stack.back();
    stack.pop_back();
    if (next.exact != nullptr && !is_rounded(*next.exact, *next.node)) {
      next.exact = nullptr;
      if (exact_.is_known) ++summary_.unfollowed.transforms;  // counted once for all nodes below
    }
    const Affine transform = next.parent * (next.exact != nullptr ? next.exact->transform : rounded_affine(*next.node));
    if (has_bones) places.add(*next.node, transform);
    for (unsigned k = 0; k < next.node->mNumMeshes; ++k)
      summary_.nodes.emplace_back(transform, std::uint64_t(next.node->mMeshes[k]));
    for (unsigned k = next.node->mNumChildren; k-- > 0;)
      stack.push_back({next.node->mChildren[k], next.exact == nullptr ? nullptr : &next.exact->children[k], transform});
  }
  follow_bones(scene, places);
}

/// Assimp knows too little of COLLADA's morph targets; read_collada_nodes() has counted them.
void SceneUnloader::follow_bones(const aiScene& scene, const BonePlaces& places) {
  for (NodeRecord& node : summary_.nodes) {
    const aiMesh& mesh = *scene.mMeshes[node.mesh];
    if (!exact_.is_known && is_morphed(mesh)) ++summary_.unfollowed.morphs;
    if (!mesh.HasBones()) continue;
    Affine place = node.transform();
    if (places.hold(mesh, place))
      node = NodeRecord(place, node.mesh);
    else
      ++summary_.unfollowed.skins;
  }
}

/// Reads a format that is looked into here, beside Assimp. Throws bad_alloc without room for it: memory must not decide
/// what is read. Nothing is known of files in other formats: Assimp leaves out parts of them, or multiplies and
/// subtracts places in single precision, where numbers cancel.
ExactScene read_exactly(const SceneFile& file, const std::string& extension) {
  const bool collada = extension == "dae", ac3d = is_ac3d(extension);
  if (!collada && !ac3d && extension != "dxf") {
    ExactScene unknown;
    unknown.unfollowed.foreign = 1;
    return unknown;
  }
  std::string text(file.size(), '\0');
  file.read_at(0, std::as_writable_bytes(std::span(text)));
  if (collada) return exact_collada(std::move(text));
  return ac3d ? exact_ac3d(text) : exact_dxf(text);
}

std::string import(const SceneFilePtr& file, const std::string& extension, ScratchFile& scratch,
                   const SceneOptions& options) {
  const std::string path = file->path().empty() ? "scene" : file->path();
  const std::string suffix = "." + extension;
  const bool named = path.size() > suffix.size() &&
                     std::equal(suffix.rbegin(), suffix.rend(), path.rbegin(),
                                [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? char(b + 32) : b); });
  const std::string name = named ? path : path + suffix;
  std::string parts;  // must outlive the importer
  ExactScene exact = read_exactly(*file, extension);
  if (exact.unread != nullptr)
    fail(ErrorCode::bad_input, "{}: {}; export it as glTF (GLB)", file->name(), exact.unread);
  Assimp::Importer importer;
  importer.SetIOHandler(new SceneFileSystem(file, name, parts, is_ac3d(extension)));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // bones alone are no surface
  const aiScene* const scene = importer.ReadFile(name, 0);
  if (scene == nullptr) {
    const std::string_view why = importer.GetErrorString();
    // If Assimp calls a known XML malformed, its parser had no memory.
    const bool known_xml = extension == "dae" && exact.is_known;
    if (why.find("bad_alloc") != why.npos || (known_xml && why.find("malformed XML") != why.npos))
      throw std::bad_alloc();  // Assimp has caught it
    fail(ErrorCode::bad_input, "{}: cannot be read: {}; repair it, or {}", file->name(), importer.GetErrorString(),
         remedy_for(file->name()));
  }
  Summary summary = SceneUnloader(scratch, options, exact).unload(*scene);
  summary.parts = std::move(parts);
  return packed(summary);
}

// --- In the parent
// -------------------------------------------------------------------------------------------------------

Primitive primitive_of(const MeshRecord& mesh) {
  Primitive p;
  p.positions.components = 3;
  p.positions.count = mesh.vertices;
  p.positions.address = mesh.positions;
  p.positions.type = mesh.is_exact ? ComponentType::f64 : ComponentType::f32;
  p.positions.stride = 3 * bytes_of(p.positions.type);
  p.positions.share = mesh.is_exact ? 0 : kImporterShare;
  p.positions.off = mesh.off;
  p.indices = Accessor();
  p.indices->type = ComponentType::u32;
  p.indices->count = 3 * mesh.triangles;
  p.indices->address = mesh.indices;
  p.indices->stride = sizeof(std::uint32_t);
  p.base_color = mesh.base_color;
  p.srgb = true;
  if (mesh.colors != Accessor::kZeros) {
    p.colors = Accessor();
    p.colors->components = 4;
    p.colors->count = mesh.vertices;
    p.colors->address = mesh.colors;
    p.colors->stride = 4 * sizeof(float);
  }
  return p;
}

InstancedScene scene_of(const Summary& summary, SceneFilePtr bytes, const std::string& path, TextureTable* textures) {
  InstancedScene scene;
  scene.bytes = std::move(bytes);
  scene.bad_faces = summary.bad_faces;
  scene.animations = summary.animations;
  scene.unfollowed = summary.unfollowed;
  for (const MeshRecord& mesh : summary.meshes) {
    scene.primitives.push_back(primitive_of(mesh));
    if (textures != nullptr)
      lay_texture(mesh.texture, summary.textures, scene.bytes, path, *textures, scene.primitives.back());
  }
  for (const NodeRecord& node : summary.nodes) {
    if (node.mesh < summary.meshes.size() && summary.meshes[node.mesh].triangles > 0)
      scene.nodes.push_back({node.transform(), std::uint32_t(node.mesh), std::uint32_t(node.mesh + 1), {}});
  }
  return scene;
}

}  // namespace

bool assimp_reads(const std::string& extension) {
  return !extension.empty() && Assimp::Importer().IsExtensionSupported("." + extension);
}

RawSourcePtr open_with_assimp(SceneFilePtr file, const std::string& extension, const SceneOptions& options) {
  if (file->size() > kMaxFileBytes) {
    fail(ErrorCode::bad_input, "{}: has {} MiB, and .{} files are read only up to {} MiB; {}", file->name(),
         file->size() >> 20, extension, kMaxFileBytes >> 20, remedy_for(file->name()));
  }
  if (extension == "ifc") {
    std::string start(4096, '\0');
    start.resize(file->read_at(0, std::as_writable_bytes(std::span(start))));
    refuse_ifc_schema(file->name(), start);
  }
  const auto scratch = std::make_shared<ScratchFile>(temp_dir_of(options));
  const ChildLimits limits = limits_for(file->size(), options.document);
  std::string answer;
  try {
    answer = run_in_child(file->name(), importer_of(extension), "repair it, or " + remedy_for(file->name()), limits,
                          [&] { return import(file, extension, *scratch, options); });
  } catch (const ChildOutOfMemory&) {
    fail_memory(file->name(), extension, file->size(), limits, options.document);
  }
  const Summary summary = unpacked(std::exchange(answer, {}), file->name());
  for (std::size_t at = 0; at < summary.parts.size(); at = summary.parts.find('\0', at) + 1)
    keep_file(summary.parts.c_str() + at);
  SceneFilePtr bytes = view_of(scratch, file->name(), summary.bytes);
  return stream_instances(scene_of(summary, std::move(bytes), file->path(), options.textures.get()), options);
}

}  // namespace bp
