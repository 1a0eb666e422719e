#include "lib/core/triangle_source.h"

namespace bp {

namespace {

class ReadTriangles final : public FetchedTriangles {
 public:
  bool read(TriangleSource& source) { return source.read(triangles_); }
  void make(std::vector<TriangleD>& out) override { out = std::move(triangles_); }

 private:
  std::vector<TriangleD> triangles_;
};

}  // namespace

std::unique_ptr<FetchedTriangles> TriangleSource::next() {
  auto read = std::make_unique<ReadTriangles>();
  if (!read->read(*this)) return nullptr;
  return read;
}

}  // namespace bp
