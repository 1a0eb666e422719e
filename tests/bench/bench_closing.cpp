// bench_closing [STREAM | SIDE] [SCALE_VOX] [RUNS]: milliseconds of the closing's parts on one thread, as JSON lines.
// Processor time of this thread, the least of RUNS: the machine may be busy. Without a stream: a generated body of
// balls, bars and a sheet in a grid of SIDE voxels.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <random>

#include "io/stream/brick_stream.h"
#include "lib/closing/closing.h"
#include "lib/closing/detail/closing_parts.h"
#include "lib/core/error.h"

namespace {

using namespace bp;

double thread_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

struct Input {
  std::string name;
  BitBox solid;
};

void add_ball(BitBox& bits, const Vec3d& c, double r) {
  const VoxelBox& box = bits.box();
  for (int z = std::max(box.min.z, int(c[2] - r)); z < std::min(box.max.z, int(c[2] + r) + 1); ++z) {
    for (int y = std::max(box.min.y, int(c[1] - r)); y < std::min(box.max.y, int(c[1] + r) + 1); ++y) {
      const double h2 = r * r - (z - c[2]) * (z - c[2]) - (y - c[1]) * (y - c[1]);
      if (h2 < 0) continue;
      const double h = std::sqrt(h2);
      for (int x = std::max(box.min.x, int(c[0] - h)); x < std::min(box.max.x, int(c[0] + h) + 1); ++x)
        bits.set({x, y, z});
    }
  }
}

Input generated(int side) {
  Input in{fmt::format("generated {0}x{0}x{0}", side), BitBox(VoxelBox{{0, 0, 0}, {side, side, side}})};
  std::mt19937 random(1);
  const auto uniform = [&](double a, double b) { return a + (b - a) * double(random()) / 4294967296.0; };
  const auto place = [&] { return uniform(0.2, 0.8) * side; };
  for (int i = 0; i < 8; ++i) {
    const double x = place(), y = place(), z = place();
    add_ball(in.solid, {x, y, z}, uniform(0.06, 0.16) * side);
  }
  for (int i = 0; i < 10; ++i) {  // bars
    const double angle = uniform(0, 6.28), dz = uniform(-1, 1), dxy = std::sqrt(1 - dz * dz);
    Vec3d c{place(), place(), place()};
    for (int step = 0; step < side * 2 / 5; ++step) {
      add_ball(in.solid, c, 0.01 * side);
      c = {c[0] + dxy * std::cos(angle), c[1] + dxy * std::sin(angle), c[2] + dz};
    }
  }
  for (int y = side / 5; y < side * 4 / 5; ++y) {  // a slanted sheet, one voxel thin
    for (int z = side / 5; z < side * 2 / 5; ++z) in.solid.set({side / 2 + y / 4, y, z});
  }
  return in;
}

Input read(const std::string& path) {
  BrickReader source(path);
  Input in{path.substr(path.rfind('/') + 1), BitBox(voxels_of(source.header().bricks))};
  for (Brick brick; source.read(brick);) {
    if (brick.layer != Layer::solid) continue;
    const VoxelCoord first = first_voxel(brick.coord);
    for (std::int32_t z = 0; z < kBrickEdge; ++z) {
      for (std::int32_t y = 0; y < kBrickEdge; ++y) {
        in.solid.row(first.y + y, first.z + z)[(first.x - in.solid.box().min.x) / 64] =
            brick.bits[std::size_t(z * kBrickEdge + y)];
      }
    }
  }
  return in;
}

/// Base `scale_vox`, or 60 % of it with a stroke that raises it to all of it around the middle.
ScaleField field_of(const BitBox& solid, double scale_vox, bool varying) {
  ScaleField field;
  field.base = varying ? 0.6 * scale_vox : scale_vox;
  if (varying) {
    const VoxelBox& box = solid.box();
    const double side = double(std::max({box.size().x, box.size().y, box.size().z}));
    field.rules.push_back(
        stroke_rule(ScaleMode::increase,
                    {0.5 * (box.min.x + box.max.x), 0.5 * (box.min.y + box.max.y), 0.5 * (box.min.z + box.max.z)},
                    0.6 * side, scale_vox, field.base));
  }
  return field;
}

void run(const Input& in, double scale_vox, int runs) {
  const GridFrame frame;
  ClosingScratch scratch;
  BitBox closed;
  for (const bool varying : {false, true}) {
    const ScaleField field = field_of(in.solid, scale_vox, varying);
    const auto line = [&](const char* what, const char* element, const std::function<void()>& body,
                          const std::function<std::string()>& more) {
      double best = std::numeric_limits<double>::infinity();
      for (int i = 0; i < runs; ++i) {
        const double begin = thread_ms();
        body();
        best = std::min(best, thread_ms() - begin);
      }
      fmt::print(
          "{{\"bench\": \"{}\", \"grid\": \"{}\", \"scale_vox\": {}, \"field\": \"{}\", \"element\": \"{}\", "
          "\"ms\": {:.2f}{}}}\n",
          what, in.name, scale_vox, varying ? "varying" : "constant", element, best, more());
    };
    const auto nothing = [] { return std::string(); };
    Halo halo;
    ScaleLattice lattice;
    line(
        "halo_of", "", [&] { halo = halo_of(in.solid.box(), field, frame); }, nothing);
    line(
        "sample", "", [&] { lattice = field.sample(frame, in.solid.box().grown(halo.total_vox())); }, nothing);
    for (const StructuringElement element : {StructuringElement::cube, StructuringElement::ball}) {
      line(
          "close_tile", element == StructuringElement::cube ? "cube" : "ball",
          [&] { close_tile(in.solid, lattice, halo, {element}, in.solid.box(), closed, scratch); },
          [&] {
            return fmt::format(", \"solid\": {}, \"dilation\": {}, \"closing\": {}", in.solid.count(),
                               scratch.parts().dilation.count(), closed.count());
          });
    }
    BitBox dilation(in.solid.box().grown(halo.erosion_vox));
    line(
        "dilation", "cube",
        [&] {
          if (varying) {
            scratch.parts().varying.run(in.solid, lattice, dilation.box(), dilation);
          } else {
            scratch.parts().cube.run(in.solid, cube_radius(lattice.max), dilation);
          }
        },
        nothing);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string what = argc > 1 ? argv[1] : "512";
  const double scale_vox = argc > 2 ? std::atof(argv[2]) : 20;
  const int runs = argc > 3 ? std::atoi(argv[3]) : 3;
  const bool side = what.find_first_not_of("0123456789") == std::string::npos;
  run(side ? generated(std::atoi(what.c_str())) : read(what), scale_vox, runs);
  return 0;
} catch (const bp::Error& e) {
  fmt::print(stderr, "bench_closing: {}\n", e.what());
  return bp::exit_code(e.code());
}
