#include "lib/deform/pose.h"

#include <array>
#include <cmath>
#include <optional>

#include "lib/core/error.h"
#include "lib/core/vec3.h"

namespace bp {

namespace {

constexpr std::size_t kProbes = 3;  // places that are evaluated for each direction
constexpr double kStep = 1e-6;      // of the diagonal: long compared with rounding, short compared with the cage

/// Two directions along the surface. The first is that of the tangent, if there is one.
struct Frame {
  Vec3d first{}, second{};
};

Frame frame_of(const Vec3d& normal, const Vec3d* tangent) {
  std::size_t least = 0;
  for (std::size_t i = 1; i < 3; ++i) {
    if (std::abs(normal[i]) < std::abs(normal[least])) least = i;
  }
  Vec3d axis{};
  axis[least] = 1;
  Frame frame;
  frame.first = tangent != nullptr && length(*tangent) > 0 ? *tangent : cross(normal, axis);
  frame.first = (1 / std::max(length(frame.first), 1e-300)) * frame.first;
  frame.second = cross(normal, frame.first);
  return frame;
}

std::vector<Vec3d> moves_at(const CoordinateRows& rows, std::span<const Vec3d> moves) {
  std::vector<Vec3d> out(rows.points());
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t v = 0; v < moves.size(); ++v) out[i] = out[i] + rows.row(i)[v] * moves[v];
  }
  return out;
}

void turn_some(const CageCoordinates& coordinates, std::span<const Vec3d> moves, std::span<const Vec3d> positions,
               std::span<Vec3d> normals, std::span<Vec3d> tangents, CoordinateRows& rows) {
  const double step = kStep * coordinates.cage().diagonal;
  std::vector<Frame> frames;
  std::vector<Vec3d> places;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    frames.push_back(frame_of(normals[i], tangents.empty() ? nullptr : &tangents[i]));
    places.push_back(positions[i]);
    places.push_back(positions[i] + step * frames[i].first);
    places.push_back(positions[i] + step * frames[i].second);
  }
  coordinates.evaluate(places, rows);
  const std::vector<Vec3d> moved = moves_at(rows, moves);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3d& here = moved[kProbes * i];
    if (moved[kProbes * i + 1] == here && moved[kProbes * i + 2] == here) continue;
    const Vec3d first = frames[i].first + (1 / step) * (moved[kProbes * i + 1] - here);
    const Vec3d second = frames[i].second + (1 / step) * (moved[kProbes * i + 2] - here);
    const Vec3d normal = cross(first, second);
    if (length(normal) > 0) normals[i] = (1 / length(normal)) * normal;
    if (!tangents.empty()) tangents[i] = first;
  }
}

}  // namespace

std::vector<Vec3d> moves_of_cage(const IndexedMesh& cage, const std::vector<TriangleD>& posed,
                                 const std::string& name) {
  if (posed.size() != cage.triangles.size())
    fail(ErrorCode::bad_input, "{}: has {} triangles, and the cage {}: the same faces are needed, in the same order",
         name, posed.size(), cage.triangles.size());
  std::vector<std::optional<Vec3d>> places(cage.vertices.size());
  for (std::size_t t = 0; t < posed.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d& p = posed[t][i];
      std::optional<Vec3d>& place = places[cage.triangles[t][i]];
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        fail(ErrorCode::bad_input, "{}: triangle {} has a corner that is not finite", name, t);
      if (place && *place != p)
        fail(
            ErrorCode::bad_input,
            "{}: triangle {} does not meet its neighbours as in the cage: the same faces are needed, in the same order",
            name, t);
      place = p;
    }
  }
  std::vector<Vec3d> moves(places.size());
  for (std::size_t v = 0; v < moves.size(); ++v) {
    if (places[v]) moves[v] = *places[v] - cage.vertices[v];
  }
  return moves;
}

void turn_directions(const CageCoordinates& coordinates, std::span<const Vec3d> moves, std::span<const Vec3d> positions,
                     std::span<Vec3d> normals, std::span<Vec3d> tangents) {
  const std::size_t step = std::max<std::size_t>(coordinates.points_at_once() / kProbes, 1);
  CoordinateRows rows;
  for (std::size_t first = 0; first < normals.size(); first += step) {
    const std::size_t n = std::min(step, normals.size() - first);
    turn_some(coordinates, moves, positions.subspan(first, n), normals.subspan(first, n),
              tangents.empty() ? tangents : tangents.subspan(first, n), rows);
  }
}

}  // namespace bp
