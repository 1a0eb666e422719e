#include "tests/fuzz/hostile_stream.h"

#include <algorithm>
#include <cmath>

#include "io/stream/stream_format.h"

namespace fuzz {

namespace {

using bp::Brick;
using bp::BrickFill;
using bp::kBrickEdge;

constexpr std::uint32_t kMostBricks = 10;

/// About as large as `voxel`, or hostile.
double length(Choices& c, double voxel) {
  return c.once_in(12) ? extreme_number(c) : voxel * (c.below(12) / 2.0);
}

std::string json_of(double value) {
  return std::isfinite(value) ? text_of(value) : "1e999";
}

std::string point(Choices& c, double voxel) {
  std::string text = "[";
  for (int i = 0; i < 3; ++i)
    text += (i > 0 ? "," : "") + json_of(c.once_in(12) ? extreme_number(c) : voxel * (int(c.below(256)) - 64));
  return text + "]";
}

void set_box(Brick& b, const int (&min)[3], const int (&max)[3]) {
  for (int z = min[2]; z < std::min(max[2], kBrickEdge); ++z) {
    for (int y = min[1]; y < std::min(max[1], kBrickEdge); ++y) {
      for (int x = min[0]; x < std::min(max[0], kBrickEdge); ++x)
        b.bits[std::size_t(z * kBrickEdge + y)] |= std::uint64_t(1) << x;
    }
  }
}

/// Boxes, single voxels, a plate or a beam through the brick, noise in a corner, all of it.
void fill_brick(Choices& c, Brick& b) {
  const std::uint32_t kind = c.below(16), parts = 1 + c.below(3);
  if (kind == 15) b.bits.fill(~std::uint64_t(0));
  for (std::uint32_t part = 0; part < parts; ++part) {
    int min[3], max[3];
    for (int i = 0; i < 3; ++i) {
      min[i] = int(c.below(kBrickEdge));
      max[i] = min[i] + 1 + (kind < 10 ? int(c.below(6)) : 0);
    }
    const std::uint32_t axis = c.below(3);
    if (kind == 12) min[axis] = 0, max[axis] = kBrickEdge;  // a beam
    if (kind == 13) {                                       // a plate
      for (std::uint32_t i = 0; i < 3; ++i) min[i] = i == axis ? min[i] : 0, max[i] = i == axis ? max[i] : kBrickEdge;
    }
    set_box(b, min, max);
  }
  if (kind == 14) {
    for (std::size_t z = 0; z < 4; ++z) {
      for (std::size_t y = 0; y < 4; ++y) b.bits[z * kBrickEdge + y] ^= c.byte();
    }
  }
  b.fill = bp::classify(b.bits);
}

/// Near the corner of the box, at the opposite corner, or anywhere between.
std::int32_t coordinate(Choices& c, std::int32_t min, std::int32_t max) {
  const std::int64_t size = std::int64_t(max) - min;
  if (size <= 0) return min;
  switch (c.below(8)) {
    case 6:
      return max - 1;
    case 7:
      return std::int32_t(min + std::int64_t(c.raw<std::uint32_t>()) % size);
    default:
      return std::int32_t(min + std::int64_t(c.below(3)) % size);
  }
}

std::vector<Brick> some_bricks(Choices& c, const RawStream& s) {
  std::vector<Brick> bricks;
  const std::uint32_t count = c.once_in(24) ? 0 : 1 + c.below(c.once_in(4) ? kMostBricks : 2);
  const bool nested = !c.once_in(4);
  for (std::uint32_t n = 0; n < count; ++n) {
    Brick b;
    for (int i = 0; i < 3; ++i) b.coord[i] = coordinate(c, s.box[std::size_t(i)], s.box[std::size_t(i) + 3]);
    fill_brick(c, b);
    if (b.fill == BrickFill::empty) continue;
    if ((s.flags & 1) == 0 || nested || c.once_in(2)) bricks.push_back(b);
    b.layer = bp::Layer::closing;
    if ((s.flags & 1) == 0) continue;
    if (!nested) {
      b.bits = {};
      fill_brick(c, b);
    } else if (c.once_in(2)) {  // larger
      for (std::size_t i = kBrickEdge; i < b.bits.size(); ++i) b.bits[i - kBrickEdge] |= b.bits[i] | b.bits[i] >> 1;
      b.fill = bp::classify(b.bits);
    }
    if (b.fill != BrickFill::empty) bricks.push_back(b);
  }
  return bricks;
}

void sort(const RawStream& s, std::vector<Brick>& bricks) {
  const auto less = [axis = s.slab_axis % 3](const Brick& a, const Brick& b) {
    return bp::detail::before(axis, {a.coord, a.layer, a.fill}, {b.coord, b.layer, b.fill});
  };
  std::stable_sort(bricks.begin(), bricks.end(), less);
  const auto same = [&](const Brick& a, const Brick& b) { return !less(a, b); };
  bricks.erase(std::unique(bricks.begin(), bricks.end(), same), bricks.end());
}

/// The scene fills the box.
void set_bounds(RawStream& s) {
  for (std::size_t i = 0; i < 3; ++i) {
    s.bounds[i] = s.voxel * (double(s.origin[i]) + double(s.box[i]) * kBrickEdge);
    s.bounds[i + 3] = s.voxel * (double(s.origin[i]) + double(s.box[i + 3]) * kBrickEdge);
  }
}

void spoil_frame(Choices& c, RawStream& s) {
  if (c.once_in(8)) s.voxel = std::fabs(extreme_number(c));
  if (c.once_in(8)) s.origin[c.below(3)] = extreme_integer(c);
  if (c.once_in(8)) s.box[c.below(6)] = std::int32_t(extreme_integer(c));
  if (c.once_in(8)) {
    const std::uint32_t axis = c.below(3);
    const std::int32_t min = c.of({0, -(1 << 25), (1 << 25) - 3, -1, 1 << 20, -(1 << 24)});
    s.box[axis] = min, s.box[axis + 3] = min + std::int32_t(c.below(3));
  }
}

}  // namespace

std::string hostile_field(Choices& c, double voxel) {
  static const std::vector<std::string> kModes{"increase", "decrease", "erase", "increas"};
  std::string text = "{\"base\":" + json_of(length(c, voxel)), strokes, boxes;
  for (std::uint32_t i = c.below(4) % 3; i > 0; --i) {
    strokes += (strokes.empty() ? "" : ",") + ("{\"mode\":\"" + kModes[c.below(16) % 7 % 4]) +
               "\",\"position\":" + point(c, voxel) + ",\"support\":" + json_of(length(c, 8 * voxel)) +
               ",\"target\":" + json_of(length(c, voxel)) + "}";
  }
  for (std::uint32_t i = c.below(4) % 3; i > 0; --i) {
    boxes += (boxes.empty() ? "" : ",") + ("{\"min\":" + point(c, voxel)) + ",\"max\":" + point(c, voxel) +
             ",\"scale\":" + json_of(length(c, voxel)) + "}";
  }
  if (!strokes.empty()) text += ",\"strokes\":[" + strokes + "]";
  if (!boxes.empty()) text += ",\"boxes\":[" + boxes + "]";
  if (c.once_in(40)) text += ",\"more\":" + extreme_text(c);
  return text + "}";
}

std::string hostile_orientation(Choices& c) {
  std::string out;
  const auto put = [&](auto sound) {
    if (c.once_in(24)) sound = decltype(sound)(extreme_integer(c));
    out.append(reinterpret_cast<const char*>(&sound), sizeof(sound));
  };
  put(std::uint32_t(8 << c.below(5)));
  for (int i = 0; i < 3; ++i) put(std::int32_t(c.below(5)) - 2);
  std::uint32_t cells = 1;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t n = 1 + c.below(3);
    cells *= n;
    put(n);
  }
  const std::uint32_t rotations = 1 + c.below(4);
  put(rotations);
  for (std::uint32_t i = 0; i < rotations; ++i) {
    const auto q = c.of<std::array<std::int16_t, 4>>(
        {{16384, 0, 0, 0}, {15137, 0, 0, 6270}, {14189, 0, 8192, 0}, {8192, 8192, 8192, 8192}, {0, 0, 0, 0}});
    for (const std::int16_t x : q) put(x);
  }
  for (std::uint32_t i = 0; i < cells; ++i) put(std::uint16_t(c.below(rotations)));
  if (c.once_in(24)) out.resize(c.below(std::uint32_t(out.size()) + 8));
  return out;
}

std::string hostile_rules(Choices& c, double voxel) {
  const auto length_text = [&](double unit) {
    if (!c.once_in(4)) return json_of(length(c, unit));
    const double value = c.below(6);  // a share of a long box is honest work for minutes
    const std::string small = text_of(c.once_in(8) ? extreme_number(c) : value);
    return "\"" + c.of<std::string>({small + "vx", small, small + "px", text_of(value / 10) + "%"}) + "\"";
  };
  const auto points = [&](std::uint32_t count) {
    std::string text = "[";
    for (std::uint32_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + point(c, voxel);
    return text + "]";
  };
  std::string text = "{\"base\":" + length_text(voxel);
  if (c.once_in(4)) text += ",\"slope\":" + json_of(c.once_in(4) ? extreme_number(c) : c.below(8) / 8.0);
  text += ",\"rules\":[";
  for (std::uint32_t i = 0, count = c.below(5); i < count; ++i) {
    const std::string place = c.of<std::string>({"at", "box", "view", "node", "on"});
    text += (i > 0 ? ",{\"" : "{\"") + place + "\":";
    text += place == "node" ? "\"*\"" : points(place == "box" && !c.once_in(12) ? 2 : 1 + c.below(4));
    text += ",\"scale\":" + length_text(voxel);
    if (c.once_in(2)) text += ",\"mode\":\"" + c.of<std::string>({"set", "increase", "decrease", "erase", ""}) + "\"";
    if (place == "view") text += ",\"per_distance\":" + json_of(c.once_in(8) ? extreme_number(c) : c.below(8) / 16.0);
    if (c.once_in(3)) text += ",\"radius\":" + length_text(4 * voxel);
    if (c.once_in(4)) text += ",\"support\":" + length_text(8 * voxel);
    text += "}";
  }
  return text + "]}";
}

RawStream hostile_stream(Choices& c) {
  RawStream s;
  s.flags = c.once_in(3) ? 1 : 0;
  s.fill = std::uint8_t(c.once_in(3) ? c.below(4) : 0);
  s.element = std::uint8_t(s.flags & c.below(2));
  s.slab_axis = std::uint8_t(2 - c.below(3));
  s.up = std::uint8_t(c.below(2));
  const bool spoiled = c.once_in(2);
  if (spoiled) spoil_frame(c, s);
  set_bounds(s);
  if (spoiled && c.once_in(4)) s.bounds[c.below(6)] = extreme_number(c);
  if (spoiled && c.once_in(16)) s.bounds = {INFINITY, INFINITY, INFINITY, -INFINITY, -INFINITY, -INFINITY};
  if (spoiled && c.once_in(16)) s.flags = c.raw<std::uint16_t>(), s.fill = c.byte(), s.element = c.byte();
  if (spoiled && c.once_in(32)) s.slab_axis = c.byte(), s.up = c.byte();
  if ((s.flags & 1) != 0) s.scale = hostile_field(c, s.voxel);
  if (c.once_in(16)) s.provenance = R"([{"tool":"t","version":"\u0000","options":"--x ","input_hash":"0"}])";
  if (c.once_in(64)) s.provenance = extreme_text(c);
  s.bricks = some_bricks(c, s);
  if (!c.once_in(48)) sort(s, s.bricks);
  return s;
}

}  // namespace fuzz
