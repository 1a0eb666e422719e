// Peer of the benchmark: CGAL's alpha_wrap_3 on a triangle soup (never part of the suite). usage: alpha_wrap
// IN.off|.ply|.obj A B OUT.off alpha = diagonal / A, offset = diagonal / B. Prints seconds of reading and wrapping, and
// faces.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

int main(int argc, char** argv) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  if (argc != 5) return 2;
  const auto start = std::chrono::steady_clock::now();
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
  if (!CGAL::IO::read_polygon_soup(argv[1], points, faces)) return 3;
  CGAL::Bbox_3 box;
  for (const Point& p : points) box += p.bbox();
  const double diagonal = std::sqrt(
      CGAL::squared_distance(Point(box.xmin(), box.ymin(), box.zmin()), Point(box.xmax(), box.ymax(), box.zmax())));
  CGAL::Surface_mesh<Point> wrap;
  CGAL::alpha_wrap_3(points, faces, diagonal / std::atof(argv[2]), diagonal / std::atof(argv[3]), wrap);
  CGAL::IO::write_polygon_mesh(argv[4], wrap);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("{\"peer\": \"alpha_wrap_3\", \"seconds\": %.3f, \"faces\": %zu}\n", seconds,
              std::size_t(wrap.number_of_faces()));
}
