#include "io/scene/detail/foreign_format.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/files/lower.h"
#include "lib/core/error.h"

namespace bp {

namespace {

struct Foreign {
  std::vector<std::string_view> endings, first_bytes;
  const char* what;
  const char* way;
};

constexpr const char* kSurface =
    "reconstruct a surface with MeshLab, CloudCompare or PDAL (filters.poisson), and save it as PLY";
constexpr const char* kArchive = "is an archive";
constexpr const char* kSolid = "mesh it with FreeCAD or gmsh, and save it as STL or OBJ";

const std::vector<Foreign>& table() {
  static const std::vector<Foreign> formats{
      {{".las", ".laz", ".copc"}, {"LASF"}, "is a point cloud (LAS)", kSurface},
      {{".e57", ".pcd", ".pts", ".ptx", ".pnts", ".xyz"}, {"ASTM-E57", "pnts", "# .PCD"}, "is a point cloud", kSurface},
      {{".usd", ".usda", ".usdc", ".usdz"},
       {"PXR-USDC", "#usda"},
       "is a USD scene",
       "import it in Blender, and export it as GLB"},
      {{".abc"}, {"Ogawa"}, "is an Alembic cache", "import it in Blender, and export it as GLB"},
      {{".city.json", ".cityjson", ".city.jsonl", ".jsonl"},
       {"{\"type\":\"CityJSON", "{\"type\": \"CityJSON"},
       "is a city model (CityJSON)",
       "convert it: cjio IN export obj OUT.obj"},
      {{".gml", ".citygml", ".cgml"},
       {},
       "is a city model (CityGML)",
       "convert it: citygml-tools to-cityjson IN, then cjio IN export obj OUT.obj"},
      {{".ifc", ".ifczip", ".ifcxml"},
       {},
       "is a building model (IFC)",
       "convert it: IfcConvert IN OUT.glb (IfcOpenShell)"},
      {{".dwg"},
       {"AC10"},
       "is an AutoCAD drawing (DWG)",
       "convert it to DXF with ODA File Converter or LibreDWG, then to OBJ with FreeCAD or Blender"},
      {{".step", ".stp", ".iges", ".igs", ".brep"}, {"ISO-10303-21"}, "is a CAD model of exact solids", kSolid},
      {{".b3dm", ".i3dm", ".cmpt"},
       {"b3dm", "i3dm", "cmpt"},
       "is a tile of 3D Tiles 1.0",
       "convert it: 3d-tiles-tools b3dmToGlb -i IN -o OUT.glb"},
      {{".zip", ".7z", ".rar"}, {"PK\x03\x04", "7z\xBC\xAF", "Rar!"}, kArchive, "unpack it, and name the scene in it"},
      {{".skp", ".max", ".c4d", ".ma", ".mb", ".3dm", ".sldprt", ".ztl"},
       {},
       "is a file of a modelling program",
       "export it from there, as GLB or OBJ"}};
  return formats;
}

const Foreign* find(const std::string& path, const std::string& first_bytes) {
  const std::string name = lower(path);
  for (const Foreign& f : table()) {
    const bool named = std::any_of(f.endings.begin(), f.endings.end(), [&](auto e) { return name.ends_with(e); });
    const bool begins =
        std::any_of(f.first_bytes.begin(), f.first_bytes.end(), [&](auto b) { return first_bytes.starts_with(b); });
    if (named || begins) return &f;
  }
  return nullptr;
}

}  // namespace

std::string foreign_format(const std::string& path, const std::string& first_bytes) {
  const Foreign* const f = find(path, first_bytes);
  return f == nullptr ? "" : fmt::format("{}, which is not read; {}", f->what, f->way);
}

std::string foreign_way(const std::string& path) {
  const Foreign* const f = find(path, "");
  return f == nullptr ? "" : f->way;
}

bool is_archive(const std::string& path) {
  const Foreign* const f = find(path, "");
  return f != nullptr && f->what == kArchive;
}

void refuse_foreign(const std::string& path, const std::string& first_bytes) {
  const std::string what = foreign_format(path, first_bytes);
  if (!what.empty()) fail(ErrorCode::bad_input, "{}: {}", path, what);
}

void refuse_ifc_schema(const std::string& name, const std::string& first_bytes) {
  constexpr std::string_view kRead = "IFC2X3";
  const std::size_t line = first_bytes.find("FILE_SCHEMA");
  const std::size_t begin = line == std::string::npos ? line : first_bytes.find('\'', line);
  const std::size_t end = begin == std::string::npos ? begin : first_bytes.find('\'', begin + 1);
  if (end == std::string::npos) return;
  const std::string schema = first_bytes.substr(begin + 1, end - begin - 1);
  if (!schema.starts_with(kRead))
    fail(ErrorCode::bad_input, "{}: its schema is {}, and of IFC only {} is read; save it as that, or {}", name, schema,
         kRead, foreign_way(".ifc"));
}

void refuse_points(const std::string& name, std::uint64_t points, std::uint64_t lines) {
  if (lines > 0)
    fail(ErrorCode::bad_input,
         "{}: no triangles: {} line{}; lines need a thickness first: in Blender, Convert to Mesh with a bevel gives "
         "them "
         "one",
         name, lines, lines == 1 ? "" : "s");
  fail(ErrorCode::bad_input, "{}: no triangles: {} point{}; a point cloud needs a surface first; {}", name, points,
       points == 1 ? "" : "s", kSurface);
}

}  // namespace bp
