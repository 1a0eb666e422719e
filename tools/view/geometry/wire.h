#pragma once
#include <string>

#include "lib/live/live_surface.h"

/// The closing as bytes for the page (page/src/wire.ts reads them). Numbers are little-endian and aligned to four
/// bytes.
namespace bp {

/// The pieces of a surface, sent in parts: they are made while the parts before are on their way, and are never in
/// memory all at once.
///   generation (u32), 1 if pieces from before are gone (u32), number of pieces (u32), 0 (u32); edge of a voxel, and
///   the place of voxel (0,0,0), scene units (f64); for each piece its brick (3 i32), vertices (u32), faces (u32),
///   vertices of 12 bytes, corners of the faces (4 u16 a face; u32 if the piece has more than 65535 vertices)
class SurfaceParts {
 public:
  explicit SurfaceParts(LiveSurface::Change change) : change_(std::move(change)) {}
  [[nodiscard]] std::string next();  ///< empty: all was sent

 private:
  const LiveSurface::Change change_;
  bool begun_ = false;
  std::size_t sent_ = 0;  ///< bricks
};

}  // namespace bp
